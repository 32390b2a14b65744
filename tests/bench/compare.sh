#!/usr/bin/env bash
# The step of every method at another commit and in the working tree, in one run: before each merge of a kernel.
#   tests/bench/compare.sh COMMIT [DEVICE]      DEVICE: cpu:serial
# Builds the program of COMMIT (once; build/compare/HASH keeps it) and that of the working tree (build/release),
# then prints the table of two_builds.sh: ms before, after, and their ratio. Wants a quiet machine.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,5p' "$0" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
# shellcheck source-path=SCRIPTDIR source=../../examples/packages.sh
source "$root/examples/packages.sh"

hash=$(git -C "$root" rev-parse --verify --quiet "$1^{commit}") || {
    echo "compare.sh: \"$1\" is no commit of this repository" >&2
    exit 2
}
old=$root/build/compare/$hash
if [ ! -x "$old/taut" ]; then
    source_of_old=$(mktemp -d)
    trap 'git -C "$root" worktree remove --force "$source_of_old"' EXIT
    git -C "$root" worktree add --quiet --detach "$source_of_old" "$hash"
    configure "$source_of_old" "$old" -DTAUT_BUILD_TESTS=OFF -DTAUT_BUILD_EXAMPLES=OFF >&2
    cmake --build "$old" --target taut-cli --parallel "$(job_count)" >&2
fi
cmake --build "$root/build/release" --target taut-cli --parallel "$(job_count)" >&2
"$root/tests/bench/two_builds.sh" "$old/taut" "$root/build/release/taut" "${2:-cpu:serial}"
