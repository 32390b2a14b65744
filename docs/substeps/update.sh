#!/bin/sh
# Makes the tables of docs/methods.md about substeps anew, but that of the test of cloth that pins draw: no number between
# their marks is typed by hand. TABLE is held, stretch, grain, asked, drawn, chains, swing, named, pressed, balls, lying, falling, few or hanging; on one core
# lying, falling and few take four, two and three minutes, the others some seconds to a minute.
#
#   docs/substeps/update.sh build/release/taut [TABLE...]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [TABLE...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
page=docs/methods.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wanted=" $* "
. docs/put.sh
. docs/substeps/measure.sh

# sag SCENE [--set SETTING]: a row of "held".
sag()
{
    name=$*
    file=examples/scenes/$1
    shift
    [ $# -eq 0 ] || shift # --set
    taken=$(substeps "$file" "$@")
    runs "$file" "$@"
    own="$(digits "$(sunk)")$(said)"
    runs "$file" "$@" method.substeps=10
    ten="$(digits "$(sunk)")$(said)"
    runs "$file" "$@" method.type=vbd method.substeps=10 method.iterations=20
    row "\`$(echo "$name" | sed "s/\(bodies[^ ]*\[12,12\]\)/'\1'/")\`" "$taken" "$own" "$ten" "$(digits "$(sunk)")$(said)"
}
held()
{
    row 'command: `taut run ... --device cpu`, of `examples/scenes`' substeps "sag, m" "with 10 substeps" right
    sag hammock.json
    sag hammock.json --set "bodies[0].grid.cells=[12,12]"
    sag solids/cantilever.json --set "bodies[0].material.youngs_modulus=1e6"
    sag solids/cantilever.json
    sag solids/cantilever.json --set "bodies[0].material.youngs_modulus=1e9"
}
table held "|---|---:|---:|---:|---:|" held

# stretched NAME FEWER: a row of "stretch", of $scratch/scene.json.
stretched()
{
    set -- "$1" "$2" "$(substeps "$scratch/scene.json")"
    for settings in "" method.substeps=$2 method.substeps=300; do
        runs "$scratch/scene.json" $settings
        most=$(report max_stretch)
        case $(report status).$most in
            diverged.* | *.null) set -- "$@" "\`$(report status)\`" ;;
            *) set -- "$@" "$(digits "$(echo "$most" | awk '{ print 100 * $1 }')" 3 %)$(said)" ;;
        esac
    done
    row "$1" "$3" "$4" "$2" "$5" "$6"
}
stretch()
{
    row scene substeps stretch fewer "stretch with these" "stretch with 300"
    for preset in penava_cotton penava_wool clyde_silk_charmeuse wang_trousers; do
        scene '"duration": 2, "damping": 2, "bodies": [{"grid": {"cells": [10, 10], "size": [0.5, 0.5]}, "material":
            {"fabric": {"preset": "'$preset'"}}, "pins": [{"corners": ["top_left", "top_right"]}]}]'
        stretched "\`$preset\`" 14
    done
    for pressure in 20 100 300 700 1000; do
        scene '"duration": 2, "damping": 5, "gravity": [0, 0, 0], "bodies": [{"mesh": "examples/scenes/shapes/sphere.obj",
            "material": {"density": 0.2, "stretch_stiffness": 1000, "pressure": '$pressure'}}]'
        stretched "p = $(echo $pressure | sed 's/\(.\)000$/\1,000/') Pa" 10
    done
}
table stretch "|---|---:|---:|---:|---:|---:|" stretch

grain()
{
    row fabric substeps "longer with these, mm" "with 38" right
    for preset in penava_cotton clyde_cotton clyde_silk_charmeuse wang_tablecloth; do
        scene '"duration": 2, "damping": 6, "bodies": [{"grid": {"cells": [14, 14], "size": [0.6, 0.6]}, "material":
            {"fabric": {"preset": "'$preset'", "grain_degrees": 45}}, "pins": [{"edge": "top"}]}]'
        set -- "$(substeps "$scratch/scene.json")"
        for settings in "" method.substeps=38 method.substeps=1000; do
            runs "$scratch/scene.json" $settings
            set -- "$@" "$(digits "$(lowest | awk '{ print 1000 * (-0.3 - $1) }')" 3)$(said)"
        done
        row "\`$preset\`" "$@"
    done
}
table grain "|---|---:|---:|---:|---:|" grain

. docs/substeps/loads.sh
. docs/substeps/swing.sh

hang() # SETTING...
{
    runs examples/scenes/hanging.json damping=2 duration=6 "$@"
    edge="$(lowest | awk '{ printf "%.2f m\n", $1 }')"
    words=$(echo "$*" | sed 's/\([^ ][^ ]*\)/--set \1/g')
    case "$*" in
        "") words="nothing else (xpbd)" ;;
        *vbd) words="\`$words\` (takes $(substeps examples/scenes/hanging.json damping=2 duration=6 "$@"))" ;;
        *) words="\`$words\`" ;;
    esac
    ends="\`$(report status)\`"
    [ -z "$(report soft)" ] || ends="$ends, warning \`soft\`"
    row "$words" "$edge" "$ends"
}
hanging()
{
    row 'command: `taut run examples/scenes/hanging.json --device cpu --set damping=2 --set duration=6` and' "lower edge" "ends as"
    hang method.type=vbd method.substeps=10
    hang method.type=vbd
    hang method.type=implicit_euler
    hang
}
. docs/substeps/solids.sh
table hanging "|---|---:|---|" hanging
