#!/bin/sh
# The pages say what the tables say: their text is compared with what the CSV files give now. 0 when it agrees.
set -eu
cd "$(dirname "$0")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compare() # PAGE TABLES
{
    sed -n '/^<!-- from the tables/,/^<!-- end/p' "$1" | sed '1d; $d' > "$scratch/said"
    sh ./facts.sh "$2" > "$scratch/tables"
    [ -s "$scratch/said" ] || { echo "$1 has no text from the tables" >&2; exit 1; }
    diff "$scratch/tables" "$scratch/said" >&2 ||
        { echo "$1 and the tables differ: run update.sh" >&2; exit 1; }
}
compare README.md cloth
compare solids.md solids
