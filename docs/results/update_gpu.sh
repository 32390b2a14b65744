#!/bin/sh
# Writes the tables of docs/results/gpu.md anew from tests/hardware/radv.csv, plans and published figures: no
# number between its marks is typed by hand. No GPU is needed.
#
#   docs/results/update_gpu.sh build/release/tests/test_hardware
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built test_hardware)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
page=docs/results/gpu.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh

TAUT_PAGE_PARTS=$scratch "$program" "Writes the parts of the page" > "$scratch/log" || { cat "$scratch/log" >&2; exit 1; }
for part in gpus cloth passes dispatches gradients; do
    put "$page" "$part" "$scratch/$part"
done
