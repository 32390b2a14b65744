#!/usr/bin/env bash
# The suites that take longer than a build should: run before a release, one line of summary a part.
#   tests/matrix.sh [PART...]      all by default
# release: tests/run.sh, and the benches are built. headers: each file, and each installed header, alone and without precompiled
# headers, so that it includes what it uses. asan (address and undefined), tsan: the presets. clang: the release build by clang, where it is
# installed. odr: types that two files define differently (tests/odr.sh, of which ctest runs the same). stable, testing:
# tests/run.sh in a chroot of that Debian (tests/chroot.sh). executors: conformance, physics, golden scenes and
# linear systems on every executor, of which ctest runs some. hard: the hard cases and the whole map in full on every
# executor (hours). mutants: every 10th mutant that tests/mutants.csv does not answer, for half an hour. A part
# that cannot run here is "skipped", with the reason. Logs: build/matrix/PART.log. Exit status 1 if any failed.
# shellcheck disable=SC2317 # parts are called by name
set -uo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
logs=$root/build/matrix
jobs=${TAUT_JOBS:-$(nproc)}
mkdir -p "$logs"

# preset NAME: configured, built, tested; the short form of the hard cases.
preset() {
    cd "$root" && cmake --preset "$1" && cmake --build --preset "$1" --parallel "$jobs" &&
        ctest --preset "$1" --parallel "$jobs"
}

part_release()
{
    "$root/tests/run.sh" && cmake --build "$root/build/release" --target benches --parallel "$jobs"
}

part_headers() {
    cd "$root" && cmake -S . -B build/headers -DCMAKE_BUILD_TYPE=Debug -DTAUT_BUILD_TESTS=ON \
        -DTAUT_BUILD_EXAMPLES=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DTAUT_UNITY=OFF &&
        cmake --build build/headers --parallel "$jobs" &&
        TAUT_HEADERS_ALONE=1 ctest --test-dir build/headers --output-on-failure -R install_prefix
}

part_asan() { preset asan; }
part_tsan() { preset tsan; }

part_clang() {
    command -v clang++ > /dev/null || { echo "clang++ is not installed"; return 77; }
    cd "$root" &&
        cmake -S . -B build/clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
            -DTAUT_BUILD_TESTS=ON &&
        cmake --build build/clang --target all benches --parallel "$jobs" &&
        TAUT_REQUIRE_DEVICE=${TAUT_REQUIRE_DEVICE:-1} ctest --test-dir build/clang --output-on-failure \
            --no-tests=error --parallel "$jobs"
}

part_hard() {
    local program=$root/build/release/tests/test_hard
    [ -x "$program" ] || { echo "$program is not built"; return 1; }
    local run=(env -u TAUT_HARD_SHORT TAUT_REQUIRE_DEVICE="${TAUT_REQUIRE_DEVICE:-1}")
    # The threads of software Vulkan and OpenGL wait for each other at every dispatch; two cells of the map run at
    # once instead, a thread each. All else runs with all threads.
    "${run[@]}" "$program" "~F8: the cells end*" &&
        "${run[@]}" LP_NUM_THREADS="${LP_NUM_THREADS:-1}" "$program" "F8: the cells end*"
}

part_odr() { "$root/tests/odr.sh" "$root/build/release" "$root/build/odr"; }

# What ctest runs on cpu:serial and cpu alone (TAUT_TEST_SHORT), or in part on software drivers.
part_executors() {
    local program status worst=0
    for program in conformance physics golden linear linear_hard; do # 77: some of it was left out, and nothing failed
        status=0
        TAUT_REQUIRE_DEVICE=${TAUT_REQUIRE_DEVICE:-1} "$root/build/release/tests/test_$program" || status=$?
        [ $status -eq 0 ] || [ $worst -eq 1 ] || worst=$([ $status -eq 77 ] && echo 77 || echo 1)
    done
    return "$worst"
}

part_stable() { "$root/tests/chroot.sh" stable; }
part_testing() { "$root/tests/chroot.sh" testing; }

part_mutants() { "$root/tests/mutants.sh" --sample 10 --budget 1800; }

[ $# -gt 0 ] || set -- release headers asan tsan clang odr stable testing executors hard mutants
failed=0
for part in "$@"; do
    if ! declare -F "part_$part" > /dev/null; then
        echo "no part is called $part" >&2
        exit 2
    fi
    begin=$SECONDS status=0
    ("part_$part") > "$logs/$part.log" 2>&1 || status=$?
    case $status in
    0) word=passed ;;
    77) word="skipped: $(tail -1 "$logs/$part.log")" ;;
    *) word="FAILED, see $logs/$part.log" failed=1 ;;
    esac
    printf '%-9s %6d s  %s\n' "$part" $((SECONDS - begin)) "$word"
done
exit $failed
