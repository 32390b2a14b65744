#!/bin/sh
# Writes the tables of docs/results/inventory.md anew: each part is what the command above it prints. A test
# (tests/cli/inventory_test.cpp) fails where they differ.
#
#   docs/results/update_inventory.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
page=docs/results/inventory.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh

sed -n 's/^    taut plan //p' "$page" > "$scratch/commands"
sed -n 's/^<!-- \([a-z_]*\) -->$/\1/p' "$page" | grep -vx end > "$scratch/parts"
paste -d ' ' "$scratch/parts" "$scratch/commands" | while read -r part arguments; do
    # shellcheck disable=SC2086 # words of a command
    "$program" plan $arguments > "$scratch/table"
    put "$page" "$part" "$scratch/table"
done
