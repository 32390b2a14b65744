#!/bin/sh
# The error of the mesh beside that of the solver, of some examples at rest: docs/continuum/meshes.csv and its table in
# docs/cost.md. About two minutes; no times are in it.
#
#   docs/continuum/update.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh
table=docs/continuum/meshes.csv

# row SCENE METHOD SUBSTEPS...: a line for each count of substeps, with one iteration in double.
row()
{
    scene=$1 method=$2 substeps=$3
    "$program" cost "examples/$scene.json" --continuum --static --device cpu:serial --methods "$method" --substeps "$substeps" \
        --iterations 1 --precision double --timing-seconds 0 --repeats 1 --json > "$scratch/study.json"
    awk -v scene="$scene" -f docs/continuum/row.awk "$scratch/study.json"
}
{
    echo "example,vertices,order,own error %,mesh %,method,substeps,solver %,continuum %"
    row scenes/fabric/overhang xpbd 200,400
    row scenes/fabric/sheet vbd 1,4
    row scenes/strip_static vbd 1,4
    row scenes/solids/vbd_hanging_box vbd 1,4
    row accuracy/beam xpbd 16,64
} > "$scratch/meshes.csv"
mv "$scratch/meshes.csv" "$table"
awk -f docs/table.awk -f docs/claims.awk "$table" > "$scratch/meshes.md"
{ sed -n 1p "$scratch/meshes.md"; echo "|---|---:|---:|---:|---:|---|---:|---:|---:|"; sed 1d "$scratch/meshes.md"; } > "$scratch/page"
put docs/cost.md meshes "$scratch/page"
