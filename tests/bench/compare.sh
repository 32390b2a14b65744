#!/usr/bin/env bash
# The step of every method at another commit and in the working tree, in one run; for use before a kernel is merged.
#   tests/bench/compare.sh COMMIT [DEVICE]      DEVICE, default cpu:serial
# Builds the program of COMMIT (once; build/compare/HASH keeps it) and that of the working tree (build/compare/tree)
# with the same settings, then prints the table of two_builds.sh: ms before, after, and their ratio. Wants a
# quiet machine.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,6p' "$0" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
# shellcheck source-path=SCRIPTDIR source=../../examples/packages.sh
source "$root/examples/packages.sh"

build_program() { # SOURCE BUILD
    configure "$1" "$2" -DTAUT_BUILD_TESTS=OFF -DTAUT_BUILD_EXAMPLES=OFF >&2
    cmake --build "$2" --target taut-cli --parallel "$(job_count)" >&2
}

hash=$(git -C "$root" rev-parse --verify --quiet "$1^{commit}") || {
    echo "compare.sh: \"$1\" is no commit of this repository" >&2
    exit 2
}
old=$root/build/compare/$hash
if [ ! -x "$old/taut" ]; then
    work=$(mktemp -d)
    trap 'rm -rf "$work"; git -C "$root" worktree prune' EXIT
    git -C "$root" worktree add --quiet --detach "$work/tree" "$hash"
    build_program "$work/tree" "$old"
fi
build_program "$root" "$root/build/compare/tree"
"$root/tests/bench/two_builds.sh" "$old/taut" "$root/build/compare/tree/taut" "${2:-cpu:serial}"
