#!/bin/sh
# Writes the tables of docs/fabric.md anew: how far the middle of one sheet sags on four meshes, and the angle at
# which strips hang that the cantilever test saw at 41.5 degrees.
#
#   docs/fabric/update.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
page=docs/fabric.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh

# sag CELLS ARGUMENTS...: mm, by how much the middle vertex of the last mesh lies below y = 0.
sag()
{
    middle=$(($1 / 2 * ($1 + 2) + 1))
    shift
    "$program" run "$@" --device cpu --no-picture --every 240 --out "$scratch/run" > /dev/null 2>&1 || [ $? -eq 1 ]
    awk -v middle=$middle '$1 == "v" && ++k == middle { print -1000 * $3 }' "$(ls "$scratch"/run/*.obj | tail -1)"
    rm -r "$scratch/run"
}

# rows NAME SCENE SETTING...: a line of the CSV for each method, with the sag on each mesh.
rows()
{
    name=$1
    scene=$2
    shift 2
    for method in implicit_euler mass_spring vbd xpbd; do
        case $method in
            implicit_euler) own="method.substeps=4 method.iterations=1 method.linear_iterations=300" ;;
            mass_spring) own="method.substeps=20 method.stability=substep" ;;
            vbd) own="method.substeps=20 method.iterations=10" ;;
            xpbd) own="method.substeps=400" ;;
        esac
        line="$name,$method"
        for cells in 8 16 32 64; do
            mm=
            [ $method.$cells = vbd.64 ] || # too long
                mm=$(sag $cells "$scene" --set method.type=$method $own "bodies[0].grid.cells=[$cells,$cells]" "$@")
            line=$line,$mm
        done
        echo "$line"
    done
}

{
    echo sheet,method,8,16,32,64
    rows "fabric along the warp" examples/scenes/fabric/sheet.json
    rows "fabric along the bias" examples/scenes/fabric/sheet.json \
        "bodies[0].material.fabric.grain=[1,1,0]"
    rows "springs" examples/scenes/fabric/springs.json
} > docs/fabric/sag.csv
awk -F, '
    NR == 1 { next }
    $2 == "implicit_euler" { # the limit by Richardson, from the order that the last three meshes show
        ratio = ($4 - $3) / ($5 - $4); last = ($5 - $4) / ($6 - $5); order = log(last) / log(2)
        limit = $6 + ($6 - $5) / (last - 1)
    }
    { printf "| %s | %s |", $1, $2
      for (k = 3; k <= 6; ++k)
          if ($k == "") printf " |"
          else printf " %.2f (%+.2f %%) |", $k, 100 * ($k / limit - 1)
      if ($2 == "implicit_euler") printf " %.2f, order %.1f |\n", limit, order; else print " |" }
' docs/fabric/sag.csv > "$scratch/rows"
{
    echo "| sheet | method | 8² | 16² | 32² | 64² | limit |"
    echo "|---|---|---:|---:|---:|---:|---:|"
    cat "$scratch/rows"
} > "$scratch/sag.md"
put "$page" sag "$scratch/sag.md"

# overhang MODEL DIAGONALS CELLS: degrees by which the tips of the three strips lie below their edges; CELLS to a
# centimetre, of which one is held.
overhang()
{
    model=$1
    shift
    case $model in
        hinge) own="method.type=implicit_euler method.substeps=4 method.iterations=1 method.linear_iterations=1000" ;;
        plate) own="method.type=xpbd method.substeps=1000" ;;
    esac
    "$program" run examples/scenes/fabric/overhang.json --device cpu --no-picture --every 180 --out "$scratch/run" \
        --set $own method.precision=double "bodies[0].material.bending_model=$model" \
        "bodies[1].material.bending_model=$model" "bodies[2].material.bending_model=$model" \
        "bodies[0].grid.cells=[$((5 * $2)),$2]" "bodies[1].grid.cells=[$((4 * $2)),$2]" \
        "bodies[2].grid.cells=[$((9 * $2 / 2)),$2]" "bodies[0].grid.diagonals=$1" "bodies[1].grid.diagonals=$1" \
        "bodies[2].grid.diagonals=$1" > /dev/null 2>&1 || [ $? -eq 1 ]
    awk -v n="$2" '
        $1 == "v" { x[k] = $2; y[k++] = $3 }
        function angle(columns,    row, fall, way) {
            for (row = 0; row <= n; ++row) {
                fall += y[first + row * (columns + 1) + n] - y[first + row * (columns + 1) + columns]
                way += x[first + row * (columns + 1) + columns] - x[first + row * (columns + 1) + n]
            }
            first += (n + 1) * (columns + 1)
            return atan2(fall, way) * 45 / atan2(1, 1)
        }
        END { printf "%.1f,%.1f,%.1f\n", angle(5 * n), angle(4 * n), angle(4.5 * n) }
    ' "$(ls "$scratch"/run/*.obj | tail -1)"
    rm -r "$scratch/run"
}

{
    echo model,diagonals,cells,warp,weft,bias
    for model in hinge plate; do
        for diagonals in alternating uniform; do
            for cells in 2 4; do
                echo "$model,$diagonals,$cells,$(overhang $model $diagonals $cells)"
            done
        done
    done
} > docs/fabric/overhang.csv
{
    echo "| model | diagonals | cells a centimetre | warp, 4 cm | weft, 3 cm | bias, 3.5 cm |"
    echo "|---|---|---:|---:|---:|---:|"
    awk -F, 'NR > 1 { printf "| %s | %s | %d | %s° | %s° | %s° |\n", $1, $2, $3, $4, $5, $6 }' docs/fabric/overhang.csv
} > "$scratch/overhang.md"
put "$page" overhang "$scratch/overhang.md"
