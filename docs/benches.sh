#!/bin/sh
# Measures the tables between the marks of docs/methods/acad.md, docs/hybrid.md, docs/sleep.md and docs/bench.md anew, and
# keeps them in tests/bench/results. Run it on a machine that does nothing else: half an hour.
#
#   docs/benches.sh build/release/tests/bench [acad] [hybrid] [split] [sleep] [medians] [second_core] [second_core_busy] [start] [host]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 FOLDER [PART...] (where the taut_*_bench were built)" >&2; exit 2; }
programs=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- acad hybrid split sleep medians second_core second_core_busy start host
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh
results=tests/bench/results

# own PART PAGE: a bench that writes its table as CSV and prints it in Markdown.
own()
{
    "$programs/taut_${1}_bench" "$results/$1.csv" > "$scratch/$1.md"
    put "$2" "$1" "$scratch/$1.md"
}

# printed PART COMMAND...: one that prints CSV.
printed()
{
    part=$1
    shift
    "$@" > "$scratch/$part.csv"
    mv "$scratch/$part.csv" "$results/$part.csv"
    put_table docs/bench.md "$part" "$results/$part.csv"
}

for part in "$@"; do
    echo "$part" >&2
    case $part in
        acad) own acad docs/methods/acad.md ;;
        hybrid | split) own "$part" docs/hybrid.md ;;
        sleep) own sleep docs/sleep.md ;;
        medians) printed medians tests/bench/medians.sh "$programs/taut_bench" 20 distance recording cloth opencloth ;;
        second_core) printed second_core tests/bench/second_core.sh "$programs/taut_cores_bench" 20 20 ;;
        second_core_busy)
            BUSY=1 printed second_core_busy tests/bench/second_core.sh "$programs/taut_cores_bench" 20 20 ;;
        start | host) printed "$part" "$programs/taut_${part}_bench" ;;
        *) echo "$0: no part is called $part" >&2 && exit 2 ;;
    esac
done
