#!/bin/sh
# The pages say what the tables say: their text is compared with what the CSV files give now, what people wrote stands
# in them as it is, and its numbers are held against the same files. 0 when it agrees.
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
contains() # PAGE PART
{
    case "$(cat "$1")" in *"$(cat "$2")"*) ;; *) echo "$1 does not have the text of $2: run update.sh" >&2; exit 1 ;; esac
}
contains README.md head.md
contains solids.md head_solids.md
contains solids.md words_solids.md
contains effects.md head_effects.md
awk -f ../table.awk -f ../claims.awk effects.csv > "$scratch/tables"
grep '^|' effects.md | sed 2d | diff "$scratch/tables" - >&2 ||
    { echo "effects.md: its table is not effects.csv" >&2; exit 1; }
cat head.md head_solids.md words_solids.md head_effects.md > "$scratch/hand-written.md"
awk -v whole=1 -f claims.awk -f ../claims.awk "$scratch/hand-written.md" *_cost.csv
