#!/usr/bin/env bash
# Builds everything and runs every test; installs what is missing first (Debian, Ubuntu).
#   tests/run.sh [CTEST OPTION...]     for example: tests/run.sh -R scene
# Environment: TAUT_REQUIRE_DEVICE=0 lets tests skip devices that are not there (by default a missing
# one is a failure where the drivers could be installed); TAUT_JOBS limits parallel work.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
# shellcheck source-path=SCRIPTDIR source=../examples/packages.sh
source "$root/examples/packages.sh"
build=$root/build/release

if ensure_packages "${taut_packages_build[@]}" "${taut_packages_run[@]}" "${taut_packages_test[@]}"; then
    export TAUT_REQUIRE_DEVICE=${TAUT_REQUIRE_DEVICE:-1}
else
    say "Going on with what is there."
fi
check_cmake
configure "$root" "$build" -DTAUT_BUILD_TESTS=ON -DTAUT_BUILD_EXAMPLES=ON
cmake --build "$build" --parallel "$(job_count)"
# Two suites at once leave software drivers a core each: more threads of theirs wait for each other.
export LP_NUM_THREADS=${LP_NUM_THREADS:-1}
exec ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(job_count)" "$@"
