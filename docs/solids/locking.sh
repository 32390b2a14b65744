#!/bin/sh
# Writes the table "locking" of docs/solids.md anew: how far the tip of a bar sinks that is held at one end, against
# Timoshenko's beam (Cowper's coefficient of shear for a rectangle).
#
#   docs/solids/locking.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh

# tip CELLS NU SETTING...: percent of the beam's, of the mean of the free end's vertices once the bar is at rest.
tip()
{
    cells=$1 nu=$2
    shift 2
    "$program" run examples/scenes/solids/cantilever.json --device cpu:serial --no-picture --every 100000 --out "$scratch/run" \
        --set timestep=0.1 method.substeps=1 duration=2 method.type=implicit_euler method.precision=double method.linear_iterations=2000 \
        "bodies[0].box.cells=[$((5 * cells)),$cells,$cells]" "bodies[0].material.poissons_ratio=$nu" "$@" > "$scratch/said" 2>&1 ||
        { cat "$scratch/said" >&2; exit 1; }
    awk -v nu="$nu" -v row=$((5 * cells + 1)) '
        $1 == "v" && ++n % row == 0 { sum += $3; ++ends }
        END {
            length_ = 0.5; high = 0.1; modulus = 1e7; weight = 1000 * 9.81
            bent = 12 * weight * length_ ^ 4 / (8 * modulus * high ^ 2)
            sheared = weight * length_ ^ 2 * (1 + nu) / modulus * (12 + 11 * nu) / (10 * (1 + nu))
            printf "%.1f", 100 * (-sum / ends) / (bent + sheared)
        }' "$scratch/run/mesh_00001.obj"
    rm -r "$scratch/run"
}

{
    echo "material and cells across,ν 0,ν 0.3,ν 0.45,ν 0.49"
    for model in neo_hookean springs; do
        for split in five six; do
            for cells in 1 2 4 8; do
                line="$model $cells of $split"
                for nu in 0 0.3 0.45 0.49; do
                    line=$line,$(tip $cells $nu "bodies[0].material.model=$model" "bodies[0].box.split=$split")
                done
                echo "$line"
            done
        done
    done
} > docs/solids/locking.csv
{
    echo "| material and cells across | ν 0 | ν 0.3 | ν 0.45 | ν 0.49 |"
    echo "|---|---:|---:|---:|---:|"
    sed '1d; s/,/ | /g; s/^/| /; s/$/ |/' docs/solids/locking.csv
} > "$scratch/locking.md"
put docs/solids.md locking "$scratch/locking.md"
