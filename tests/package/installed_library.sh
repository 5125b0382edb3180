#!/usr/bin/env bash
# Other programs built with the installed libraries: those of assets/library run and say the program's own numbers, every
# public header stands by itself, and who asks for dynamics alone gets neither OpenGL nor FFmpeg.
#   tests/package/installed_library.sh BUILD_FOLDER [examples]   those of assets/library alone, in seconds
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
say() { printf 'installed_library: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }
quietly() { "$@" >"$folder/log" 2>&1 || die "$*: $(tail -20 "$folder/log")"; }

quietly cmake --install "$build" --prefix "$folder/first"
mv "$folder/first" "$folder/moved" # an installed tree may be moved
prefix=$folder/moved

# A folder of one's own with a project of these files.
project() {  # name, components, library, files...
  local name=$1 components=$2 library=$3 file
  mkdir -p "$folder/$name"
  shift 3
  { printf 'cmake_minimum_required(VERSION 3.25)\nproject(%s LANGUAGES CXX)\nset(CMAKE_CXX_EXTENSIONS OFF)\n' "$name"
    printf 'find_package(chainreel REQUIRED COMPONENTS %s)\nadd_executable(%s' "$components" "$name"
    for file in "$@"; do printf ' "%s"' "$file"; done
    printf ')\ntarget_link_libraries(%s PRIVATE chainreel::%s)\n' "$name" "$library"; } >"$folder/$name/CMakeLists.txt"
}
compile() {  # source folder, options...
  local from=$1
  shift
  quietly cmake -S "$from" -B "$from.build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release "$@"
  quietly cmake --build "$from.build"
}

cp -r "$source/assets/library" "$folder/library"
compile "$folder/library"
"$folder/library.build/energy" "$source/models/rr.urdf" >"$folder/energies"
[[ $(wc -l <"$folder/energies") == 11 ]] || die "energy says: $(cat "$folder/energies")"
# It falls from rest, so that the first energy is the potential one of the program's own words; the last is the same.
at_rest=$("$prefix/bin/chainreel" dynamics "$source/models/rr.urdf" --q 0,0 --json |
  sed -n 's/^  "potential": \(.*\),\?$/\1/p' | tr -d ,)
awk -v E="$at_rest" '{ gsub(/[+]/, "", $6); d = $6 - E; if (d < 0) d = -d; if (d > 2e-3) { print "E is " $6 ", not " E; exit 1 } }' \
  "$folder/energies" || die "energy is not kept: $(cat "$folder/energies")"
if ldd "$folder/library.build/energy" | grep -E 'GL|OSMesa|avcodec|avformat|cairo|harfbuzz|yaml'; then die "dynamics alone brings these"; fi

# The same second as the program's own, to the last digit that is told.
"$folder/library.build/swing" "$source/models/rr.urdf" >"$folder/swings"
[[ $(wc -l <"$folder/swings") == 11 ]] || die "swing says: $(cat "$folder/swings")"
awk '{ E = $NF == "J" ? $(NF - 1) : 1; if (E > 1e-8 || E < -1e-8) { print "E is " E; exit 1 } }' "$folder/swings" ||
  die "energy is not kept: $(cat "$folder/swings")"
"$prefix/bin/chainreel" simulate rr_free --set method=dop853 --set tolerance=1e-10 --set duration=1 --quiet -o "$folder/own.csv" 2>/dev/null
own=$(tail -1 "$folder/own.csv" | cut -d, -f2)
awk -v own="$own" 'END { d = $7 - own; if (d < 0) d = -d; if (d > 1e-6) { print $7 " is not " own; exit 1 } }' "$folder/swings" ||
  die "another motion than the program's"

"$folder/library.build/picture" "$prefix/share/chainreel/assets/scenes/rr_free.yaml" "$folder/mine.png" >"$folder/words" 2>&1
grep -q "^t = 0.00 s" "$folder/words" || die "picture says: $(cat "$folder/words")"
"$prefix/bin/chainreel" snapshot rr_free --at 5 -o "$folder/its.png" --quiet 2>/dev/null
"$prefix/bin/chainreel" compare "$folder/its.png" "$folder/mine.png" >/dev/null || die "another picture than the program's"

if [[ ${2-} == examples ]]; then
  say "good: the examples"
  exit 0
fi

# A caller's flags must not move members: with wider vectors Eigen would align them otherwise.
compile "$folder/library" -DCMAKE_CXX_FLAGS=-mavx
if grep -q " avx " /proc/cpuinfo; then
  "$folder/library.build/energy" "$source/models/rr.urdf" | diff - "$folder/energies" || die "-mavx changes what is read"
fi

# Each header by itself, and a program that calls simulate() in the middle of its own "core/error.hpp".
mkdir -p "$folder/headers/core"
echo '#error "another project has this name"' >"$folder/headers/core/error.hpp"
units=()
while read -r header; do
  unit=$folder/headers/${header//\//_}.cpp
  printf '#include <chainreel/%s>\n' "$header" >"$unit"
  units+=("$unit")
done < <(cd "$prefix/include/chainreel" && find . -name '*.hpp' -printf '%P\n')
((${#units[@]} > 50)) || die "only ${#units[@]} headers"
cat >"$folder/headers/main.cpp" <<'CPP'
#include <chainreel/sim.hpp>
int main() {
  chainreel::Simulation run;
  return run.duration == 10 ? 0 : 1;
}
CPP
project headers film film "${units[@]}" "$folder/headers/main.cpp"
printf 'target_include_directories(headers PRIVATE .)\nset_target_properties(headers PROPERTIES UNITY_BUILD OFF)\n' \
  >>"$folder/headers/CMakeLists.txt"
compile "$folder/headers"
"$folder/headers.build/headers" || die "headers: $?"

# The Python module, where it was built, finds what is installed beside it.
module=$prefix/lib/python3/dist-packages
if [[ -d $module ]]; then
  (cd "$folder" && PYTHONPATH=$module /usr/bin/python3 -B -c '
import chainreel as cr
assert cr.__file__.startswith("'"$module"'"), cr.__file__
assert cr.load("rr.urdf").nv == 2
assert cr.Scene("rr_free", duration=0.1).run().film("python.mp4") == ["python.mp4"]') || die "the Python module: $?"
else
  say "without the Python module, which was not built"
fi

# What is not there is said.
project other "dynamics other" dynamics "$folder/headers/main.cpp"
if cmake -S "$folder/other" -B "$folder/other.build" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/log" 2>&1; then die "there is no component 'other'"; fi
grep -q "no component 'other'" "$folder/log" || die "'other' is refused by: $(cat "$folder/log")"
sed -i 's/chainreel REQUIRED COMPONENTS dynamics other/chainreel 0.0 REQUIRED COMPONENTS dynamics/' "$folder/other/CMakeLists.txt"
if cmake -S "$folder/other" -B "$folder/other.build" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/log" 2>&1; then die "0.1 is no 0.0"; fi
if grep -rl "$source\|$build" "$prefix/lib" --include=*.cmake; then die "these name the folder they were built in"; fi
say "good"
