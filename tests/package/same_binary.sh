#!/usr/bin/env bash
# The program built in two folders, and its Debian package, are the same, byte by byte: its source copied to another place,
# without ccache.
#   tests/package/same_binary.sh build/chainreel
# Takes as long as a whole build.
set -euo pipefail
program=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
git clone -q . "$folder/elsewhere"
revision() { git -C "$1" describe --always --dirty --exclude='*'; }
[[ $(revision .) == "$(revision "$folder/elsewhere")" ]] ||
  { echo "same_binary: this tree has changes that are not committed, which its program tells" >&2; exit 1; }
cmake -S "$folder/elsewhere" -B "$folder/another build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
  -DCMAKE_CXX_COMPILER_LAUNCHER=env >"$folder/log"
nice cmake --build "$folder/another build" --target chainreel chainreel_opened >"$folder/log" 2>&1 || { tail -20 "$folder/log"; exit 1; }
cmp "$program" "$folder/another build/chainreel"
pack() {  # build, to
  (cd "$1" && SOURCE_DATE_EPOCH=1700000000 cpack -B "$2" >"$folder/log" 2>&1) || { tail -20 "$folder/log"; exit 1; }
}
pack "$(dirname "$program")" "$folder/one"
sleep 2 # times are told in whole seconds
pack "$folder/another build" "$folder/other"
cmp "$folder/one/chainreel.deb" "$folder/other/chainreel.deb"
echo "same_binary: good" >&2
