# For docs/substeps/update.sh: cloth that swings, where a method can lose energy that nothing takes.

# steps NAME: what `taut plan` says of the scene, "substeps" or "iterations".
steps() { "$program" plan "$scratch/scene.json" --set method.type=$2 --json | awk -v key="\"$1\":" '$1 == key { print $2 + 0 }'; }

# whole_off: mm, and how the run ended.
whole_off() { echo "$(off | awk '{ printf "%.0f", $1 }')$(said)"; }

# lost: per cent of what was set free.
lost() { report share | awk '{ printf "%.0f\n", 100 * $1 }'; }

# lets_go METHOD CELLS K PINS HELD: a row of "swing".
lets_go()
{
    scene '"duration": 0.6, "bodies": [{"grid": {"cells": ['$2', '$2'], "size": [1, 1]}, "material": {"density": 0.2,
        "stretch_stiffness": '$3'}, "pins": [{'"$4"'}], "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -80}}}]'
    runs "$scratch/scene.json" method.type=mass_spring method.stability=substep method.precision=double
    cp "$(ls "$scratch"/run/*.obj | tail -1)" "$scratch/there.obj"
    [ "$(report status)" = completed ] || { echo "$*: the reference is $(report status)" >&2; exit 1; }
    taken=$(steps substeps $1)
    case $1 in
        vbd) before="method.substeps=$((taken / 2))" own="$taken" fewer="$((taken / 2))" ;;
        *) before="method.iterations=1" own="$taken × $(steps iterations $1)" fewer="$taken × 1" ;;
    esac
    set -- "\`$1\`, $2² cells, $3 N/m, $5" $1
    runs "$scratch/scene.json" method.type=$2
    set -- "$1" $2 "$(whole_off)" "$(lost)"
    runs "$scratch/scene.json" method.type=$2 $before
    row "$1" "$own" "$3" "$4" "$fewer" "$(whole_off)" "$(lost)"
}
swing()
{
    row "method, cloth" taken "off, mm" "lost, %" fewer "then off, mm" "then lost, %"
    for method in implicit_euler vbd; do for stiffness in 1e3 1e5; do
        lets_go $method 8 $stiffness '"edges": ["top"]' "an edge"
        lets_go $method 16 $stiffness '"edges": ["top"]' "an edge"
        lets_go $method 16 $stiffness '"corner": "top_left"' "a corner"
    done; done
    lets_go implicit_euler 8 1e6 '"edges": ["top"]' "an edge"
}
table swing "|---|---:|---:|---:|---:|---:|---:|" swing
