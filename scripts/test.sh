#!/usr/bin/env bash
# Runs the tests of one build and ends with ctest's summary line (ctest itself may end with a list of skipped tests).
#
#   scripts/test.sh PRESET [ctest options...]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift
log=build/$preset/ctest.log
status=0
ctest --preset "$preset" -j2 "$@" 2>&1 | tee "$log" || status=$?
if grep -q "tests did not run" "$log"; then grep -E "^[0-9]+% tests passed" "$log"; fi
exit $status
