#!/bin/sh
# Measures the tables and pictures of docs/linear.md anew: no number between its marks is typed by hand. Run
# it on a machine that does nothing else; all parts together take some minutes.
#
#   docs/linear/update.sh build/release/tests/bench/taut_linear_bench [PART...]
#
# Parts: peers, thesis, residuals, precision, condition, crossover, inventory.
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [PART...] (the built taut_linear_bench)" >&2; exit 2; }
program=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- peers thesis residuals precision condition crossover inventory
cd "$(dirname "$0")/../.."
page=docs/linear.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

. docs/put.sh

for part in "$@"; do
    csv=tests/bench/results/linear_$part.csv
    case $part in
        crossover) "$program" "$part" --device cpu:serial --csv "$csv" > "$scratch/$part.md" ;;
        precision | condition) "$program" "$part" --csv "$csv" --pictures docs/linear > "$scratch/$part.md" ;;
        *) "$program" "$part" --csv "$csv" > "$scratch/$part.md" ;;
    esac
    put "$page" "$part" "$scratch/$part.md"
done
