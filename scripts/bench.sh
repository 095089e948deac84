#!/usr/bin/env bash
# Runs every benchmark program of a build.
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
