#!/usr/bin/env bash
# The shares of a film and of a sweep as jobs of GNU parallel on one host, as the guide tells.
# usage: parallel.sh CHAINREEL; ends with 77 where there is no GNU parallel.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
chainreel=$(realpath "$1")
parallel --version 2>/dev/null | grep -q 'GNU parallel' || { echo "skipped: there is no GNU parallel (packages.txt, section cluster)"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
film=("$source/assets/scenes/rr_ellipse.yaml" --set duration=3 --set video.width=160 --set video.height=90)
grid=("$source/assets/scenes/rr_free.yaml" --over start.q.1=0:1.5:40 --set duration=0.3)
"$chainreel" render "${film[@]}" -o whole/film.mp4 --quiet
"$chainreel" sweep "${grid[@]}" -o whole/grid.csv --quiet

parallel --will-cite "$chainreel" render "${film[@]}" -o parts/film.mp4 --quiet --jobs 1 --shard '{}/3' ::: 1 2 3
parallel --will-cite "$chainreel" sweep "${grid[@]}" -o parts/grid.csv --quiet --jobs 1 --shard '{}/3' ::: 1 2 3
"$chainreel" join parts/film.part-*.mp4 -o parts/film.mp4 --quiet
"$chainreel" join parts/grid.part-*.csv -o parts/grid.csv --quiet
for file in film.mp4 film.txt grid.csv; do cmp "whole/$file" "parts/$file"; done
echo "joined film and table are those of one process"
