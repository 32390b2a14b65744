#!/bin/sh
# Measures the tables between the marks of docs/methods/acad.md, docs/hybrid.md and docs/sleep.md anew. Run it
# on a machine that does nothing else.
#
#   docs/benches.sh build/release/tests/bench [acad] [hybrid] [split] [sleep]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 FOLDER [PART...] (where the taut_*_bench were built)" >&2; exit 2; }
programs=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- acad hybrid split sleep
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh

for part in "$@"; do
    case $part in
        acad) page=docs/methods/acad.md ;;
        split) page=docs/hybrid.md ;;
        *) page=docs/$part.md ;;
    esac
    "$programs/taut_${part}_bench" "tests/bench/results/$part.csv" > "$scratch/$part.md"
    put "$page" "$part" "$scratch/$part.md"
done
