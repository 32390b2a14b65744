#!/bin/sh
# Writes the table of what Mesa's compiler for AMD GPUs makes of the kernels anew (tests/hardware/radv.csv).
#   tests/hardware/update.sh
# TAUT_BUILD: the build folder, build/release by default. Say in the commit why rows changed.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd -P)
TAUT_RADV_UPDATE=1 TAUT_REQUIRE_DEVICE=1 "${TAUT_BUILD:-$root/build/release}/tests/test_hardware" "Every kernel compiles*"
