#!/bin/sh
# README.md says what the tables say: its text is compared with what the CSV files give now. 0 when it agrees.
set -eu
cd "$(dirname "$0")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
sed -n '/^<!-- from the tables/,/^<!-- end/p' README.md | sed '1d; $d' > "$scratch/said"
sh ./facts.sh > "$scratch/tables"
[ -s "$scratch/said" ] || { echo "README.md has no text from the tables" >&2; exit 1; }
diff "$scratch/tables" "$scratch/said" >&2 || { echo "README.md and the tables differ: run update.sh" >&2; exit 1; }
