#!/bin/sh
# What `taut tune` answers for every example, written into docs/tune/tune.csv and the table of docs/tune.md: about 25
# minutes on two cores with nothing beside it. Rows of scenes that are not named stay.
#
#   docs/tune/update.sh build/release/taut [SCENE...]      hanging, solids/drop, ...; all without
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [SCENE...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh
table=docs/tune/tune.csv
all=$(cd examples/scenes && find . -name '*.json' | sed 's|^\./||; s|\.json$||' | sort)
[ $# -gt 0 ] || set -- $all

# The table is written after every scene: an interrupted run keeps its rows.
for scene in "$@"; do
    begin=$(date +%s)
    status=0
    "$program" tune "examples/scenes/$scene.json" --device cpu --json > "$scratch/answer" 2> "$scratch/error" || status=$?
    if [ $status -gt 1 ] || [ ! -s "$scratch/answer" ]; then # no answer, but an error: of a scene that cannot be tuned
        row="$scene,refused,,,,,,,,$(($(date +%s) - begin))"
        sed 's/^/    /' "$scratch/error" >&2
    else
        row=$(awk -v scene="$scene" -v seconds=$(($(date +%s) - begin)) -f docs/tune/row.awk "$scratch/answer")
    fi
    echo "$row" >&2
    {
        echo "scene,method,substeps,iterations,precision,error %,within %,frames,starts,s"
        for known in $all; do
            if [ "$known" = "$scene" ]; then
                echo "$row"
            elif [ -f $table ]; then
                awk -F, -v known="$known" '$1 == known' $table
            fi
        done
    } > "$scratch/tune.csv"
    mv "$scratch/tune.csv" $table
done
put_table docs/tune.md tune $table
