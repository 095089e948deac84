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

for set in synthetic default; do "$program" author --$set -o "$work/$set" >/dev/null 2>&1; done
# Rows to $work/rows, misses to $work/misses. Exit code 1: some mark is missed.
walk() {
  "$program" walk "$work/$1" --all --markdown "${@:2}" >"$work/table" 2>/dev/null || [ $? -eq 1 ]
  sed '/^$/,$d' "$work/table" >"$work/rows"
  sed '1,/^How many/d;/^$/d' "$work/table" >"$work/misses"
}
{
  awk -v mark="$mark" '$0 == mark { exit } { print }' "$doc"
  echo "$mark"
  for set in synthetic default; do
    walk $set --ik surefoot
    printf '\n## `author --%s`: how many walks miss each mark\n\n' $set
    cat "$work/misses"
    cp "$work/rows" "$work/$set.rows"
  done
  walk synthetic --path straight --speed 1.4
  printf '\n## `author --synthetic`: straight ahead at 1.4 m/s, in three modes\n\n'
  cat "$work/rows"
  for set in synthetic default; do
    printf '\n## `author --%s`: every walk in mode surefoot\n\n' $set
    cat "$work/$set.rows"
  done
} >"$work/doc"
mv "$work/doc" "$doc"
