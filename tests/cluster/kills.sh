#!/usr/bin/env bash
# A short render is killed at MOMENTS of its life, each time as it stands: no final name is ever broken, and --resume gives
# the bytes of a render that nobody killed.
# usage: kills.sh CHAINREEL [MOMENTS, 50]
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
chainreel=$(realpath "$1")
moments=${2:-50}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
render=("$chainreel" render "$source/assets/scenes/rr_ellipse.yaml" --quiet --set duration=2 --set video.width=96 --set video.height=54
  --jobs 2)
begin=$(date +%s%N)
"${render[@]}" -o whole/film.mp4 -o whole/film.mov
life=$((($(date +%s%N) - begin) / 1000))  # microseconds

# Whatever bears a final name is whole.
check() {
  local file
  for file in film.mp4 film.mov film.txt; do
    [[ ! -e $1/$file ]] || cmp "whole/$file" "$1/$file" || { echo "a broken $file after a kill $2" >&2; exit 1; }
  done
}

killed=0
for ((k = 0; k < moments; ++k)); do
  after=$((life * (2 * k + 1) / (2 * moments)))
  rm -rf now
  "${render[@]}" -o now/film.mp4 -o now/film.mov --resume --force & pid=$!
  sleep "$(printf '%d.%06d' $((after / 1000000)) $((after % 1000000)))"
  kill -9 "$pid" 2>/dev/null && killed=$((killed + 1))
  wait "$pid" 2>/dev/null || true
  check now "$after us after its begin"
  "${render[@]}" -o now/film.mp4 -o now/film.mov --resume --force
  for file in film.mp4 film.mov film.txt; do cmp "whole/$file" "now/$file"; done
  [[ -z $(find now -name '.*' ! -name .) ]] || { echo "left behind: $(find now -name '.*')" >&2; exit 1; }
done
echo "killed $killed times of $moments: no final name was broken, and all went on to the same bytes"
