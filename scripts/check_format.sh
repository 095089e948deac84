#!/usr/bin/env bash
# Fails where a source is not as clang-format 14 (Debian 12's) would write it.
#
#   scripts/check_format.sh [ROOT]
set -euo pipefail
style=$(cd "$(dirname "$0")/.." && pwd)/.clang-format
cd "${1:-$(dirname "$0")/..}"
clang-format --version | grep -q 'version 14\.' || {
  echo "check_format: needs clang-format 14, found: $(clang-format --version)" >&2
  exit 2
}
folders=()
for folder in surefoot apps bindings bench tests examples; do [ -d "$folder" ] && folders+=("$folder"); done
mapfile -t files < <(find "${folders[@]}" -name node_modules -prune -o -path tests/gates/bad_trees -prune -o \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.inl' \) -print | LC_ALL=C sort)
[ ${#files[@]} -gt 0 ] || { echo "check_format: no sources in $PWD" >&2; exit 2; }
clang-format --style="file:$style" --dry-run -Werror "${files[@]}"
echo "check_format: ${#files[@]} files are as clang-format would write them"
