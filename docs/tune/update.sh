#!/bin/sh
# What `taut tune` answers for every example, written into the tables of docs/tune.md: tune.csv of examples/scenes, about
# 25 minutes on two cores with nothing beside it, and suites.csv of examples/accuracy and examples/contact, about as long
# again. Rows of scenes that are not named stay.
#
#   docs/tune/update.sh build/release/taut [SCENE...]      hanging, solids/drop, contact/05_stack, ...; all without
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [SCENE...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh
# names ROOT FOLDER...: the scenes in folders of a root, by their paths from there.
names() { (cd "$1" && shift && find "$@" -name '*.json' | sed 's|^\./||; s|\.json$||' | sort); }
scenes=$(names examples/scenes .)
suites=$(names examples accuracy contact)
[ $# -gt 0 ] || set -- $scenes $suites

# The table is written after every scene: an interrupted run keeps its rows.
for scene in "$@"; do
    root=examples/scenes
    table=tune
    all=$scenes
    if [ ! -f "$root/$scene.json" ]; then
        root=examples
        table=suites
        all=$suites
    fi
    begin=$(date +%s)
    status=0
    "$program" tune "$root/$scene.json" --device cpu --json > "$scratch/answer" 2> "$scratch/error" || status=$?
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
            elif [ -f docs/tune/$table.csv ]; then
                awk -F, -v known="$known" '$1 == known' docs/tune/$table.csv
            fi
        done
    } > "$scratch/rows.csv"
    mv "$scratch/rows.csv" docs/tune/$table.csv
    put_table docs/tune.md $table docs/tune/$table.csv
done
