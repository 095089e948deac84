#!/usr/bin/env bash
# The main job on the built-in character: a blend space out of its clips, its report, and a walk over hills with
# the feet on the ground. Needs no clips and no network.
#
#   scripts/demo.sh PROGRAM OUTPUT_FOLDER
set -euo pipefail
program=$1
out=$2

for job in author walk; do
  "$program" $job --help >/dev/null 2>&1 || {
    echo "demo: this build of $program has no '$job' command; it cannot show the whole line" >&2
    exit 1
  }
done

rm -rf "$out"
mkdir -p "$out"

echo "== author: clips in, a measured and triangulated blend space out"
"$program" author --default -o "$out/project"

echo
echo "== walk: hills, 1.4 m/s, the same steps without and with foot placement"
"$program" walk "$out/project" --course hills -o "$out/hills.glb" --metrics "$out/hills.json" \
  --filmstrip "$out/hills.svg"

# What the demo promises is there and not empty.
for file in project/project.json project/report.html hills.glb hills.json hills.svg; do
  [ -s "$out/$file" ] || { echo "demo: $out/$file was not written" >&2; exit 1; }
done

echo
echo "== results"
echo "  $out/project/report.html   the blend space, the clips and the findings (open it in a browser)"
echo "  $out/project/clips/        the clips as .glb"
echo "  $out/hills.svg             the walk, every few frames, without and with foot placement"
echo "  $out/hills.glb             the walk for any glTF viewer"
echo "  $out/hills.json            the figures"
