#!/usr/bin/env bash
# Runs every benchmark program of a build, then other libraries beside ours.
#
#   scripts/bench.sh BUILD_FOLDER
set -euo pipefail
shopt -s nullglob
programs=("$1"/bench/bench_*)
[ ${#programs[@]} -gt 0 ] || { echo "bench: no benchmark program in $1/bench" >&2; exit 1; }
for program in "${programs[@]}"; do
  [ -f "$program" ] && [ -x "$program" ] || continue
  echo "== ${program##*/}"
  "$program"
done
if command -v node >/dev/null; then
  echo "== other libraries at the same work"
  node "$(dirname "$0")/bench_peers.mjs" "$1" 3
else
  echo "== no Node here: other libraries are left out (they have a program of their own, $1/bench/peers/bench_peers)"
fi
