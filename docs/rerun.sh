#!/bin/sh
# Measures a few cheap rows of the studies again and holds them against the committed tables, but for times: exit status
# 0 when the program still gives what the pages show. In CI; half a minute.
#
#   docs/rerun.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bad=0

holds() # COMMITTED.csv NOW.csv
{
    awk -f docs/rerun.awk -f docs/claims.awk "$1" "$2" ||
        { echo "$1 is of another program than this: run the update.sh of its folder" >&2; bad=1; }
}

# cost TABLE SCENE [OPTION...]: rows of docs/accuracy.
cost()
{
    table=$1 scene=$2
    shift 2
    "$program" cost "examples/accuracy/$scene.json" "$@" --device cpu:serial --rank cpu --repeats 1 \
        --timing-seconds 0 --out "$scratch/$table" > "$scratch/log" 2>&1 || [ $? -eq 1 ] ||
        { cat "$scratch/log" >&2; exit 1; }
    holds "docs/accuracy/$table.csv" "$scratch/$table/cost.csv"
}
cost spring_cost spring --methods all
cost chain_1_cost chain_1 --methods all --substeps 64 --iterations 1
cost net_9_cost net_9 --methods xpbd,vbd,mass_spring --substeps 16 --iterations 1
cost cube_cost cube --methods xpbd,vbd,implicit_euler --substeps 16 --iterations 1
cost slide_cost slide --methods vbd,xpbd --substeps 16 --iterations 1

# figure PAGE NAME: a comparison of docs/PAGE.md, measured in a copy of the pages.
cp -r docs examples "$scratch"
figure()
{
    rm "$scratch/docs/$1/$2.csv"
    sh "$scratch/docs/$1/update.sh" "$program" "$2" > "$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
    holds "docs/$1/$2.csv" "$scratch/docs/$1/$2.csv"
}
# The scene of docs/results/gpu.md as it is shipped.
"$program" plan examples/scenes/drape.json | grep '^a step: 4321 dispatches' > "$scratch/log" ||
    { echo "docs/results/gpu.md: examples/scenes/drape.json has another number of dispatches" >&2; bad=1; }

figure cloth methods
figure solids methods
exit $bad
