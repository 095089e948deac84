#!/usr/bin/env bash
# Measures foot placement anew and writes the tables of docs/feet.md, below their mark. For developers.
#
#   scripts/feet_figures.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/release/surefoot}
doc=docs/feet.md
mark='<!-- below: scripts/feet_figures.sh -->'
grep -qF "$mark" "$doc" || { echo "$doc has no line '$mark'" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$program" author --synthetic -o "$work/biped" >/dev/null
walk() { "$program" walk "$work/biped" --all --markdown "$@" >"$work/table" || [ $? -eq 1 ]; }  # 1: some mark is missed
rows() { sed '/^$/,$d' "$work/table"; }
misses() { sed '1,/^How many/d' "$work/table" | sed '/^$/d'; }
{
  sed "/^$mark\$/,\$d" "$doc"
  echo "$mark"
  walk --ik surefoot
  rows >"$work/every"
  printf '\n## How many walks miss each mark, mode surefoot\n\n'
  misses
  walk --path straight --speed 1.4
  printf '\n## Straight ahead at 1.4 m/s, in three modes\n\n'
  rows
  printf '\n## Every walk in mode surefoot\n\n'
  cat "$work/every"
} >"$work/doc"
mv "$work/doc" "$doc"
