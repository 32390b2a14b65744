#!/bin/sh
# Writes docs/results/contact/*.csv and the tables of docs/results/contact.md anew: about half an hour on one core.
#
#   docs/results/contact/update.sh build/release/taut [NAME...]     stack, creep, laden, stages, led; all without
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM (the built taut) [stack] [creep] [laden] [stages] [led]" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh
page=docs/results/contact.md tables=docs/results/contact
[ $# -gt 0 ] || set -- stack creep laden stages led

# stack_scene LAYERS: sheets of 15 cm, 5 cells a side and 4.5 g each, that begin on each other on a plate.
stack_scene()
{
    awk -v layers="$1" 'BEGIN {
        print "{\"taut\": 1, \"duration\": 0.5, \"contact\": {\"friction\": 0.3}, \"bodies\": [{\"grid\": {\"cells\": [6, 6],"
        print "\"size\": [0.3, 0.3]}, \"material\": {\"thickness\": 0.002}, \"kinematic\": {}, \"transform\": {\"rotate\":"
        print "{\"axis\": [1, 0, 0], \"degrees\": -90}}}"
        for (k = 1; k <= layers; ++k) {
            print ", {\"grid\": {\"cells\": [5, 5], \"size\": [0.15, 0.15]}, \"material\": {\"density\": 0.2, \"thickness\": 0.002,"
            print "\"bending_stiffness\": 0.0001, \"stretch_stiffness\": 1000}, \"transform\": {\"rotate\": {\"axis\": [1, 0, 0],"
            printf "\"degrees\": -90}, \"translate\": [%g, %g, %g]}}\n", 0.003 * (k % 3), 0.004002 * k, 0.002 * (k % 2)
        }
        print "]}"
    }'
}

# run SCENE SETTING...: the report of a run as JSON.
run()
{
    scene=$1
    shift
    "$program" run "$scene" --device cpu:serial --no-picture --every 100000 --json --out "$scratch/run" --set "$@" \
        > "$scratch/report.json" || [ $? -eq 1 ]
    rm -rf "$scratch/run"
}

# pushed LAYERS: from the report, how far off the push on the lowest layer is and the worst one, %, and the median
# step, ms.
pushed()
{
    awk -v layers="$1" '
        function short(x, digits) { return x < 10 ^ digits - 0.5 ? sprintf("%." digits "g", x) : sprintf("%.0f", x) }
        function off(push, carried) { return 100 * (push > carried ? push - carried : carried - push) / carried }
        { value = $2; gsub(/[",]/, "", value) }
        $1 == "\"status\":" { status = value }
        $1 == "\"median\":" && step == "" { step = value }
        $1 == "\"b\":" { b = value }
        $1 == "\"push\":" { pushed[b] += value }
        END {
            # What has fallen through something carries nothing in particular.
            if (status == "unconverged") { printf "-,-,%s,%s\n", short(step, 3), status; exit }
            for (b = 1; b <= layers; ++b) {
                error = off(pushed[b], (layers - b + 1) * 0.2 * 0.15 ^ 2 * 9.81)
                if (b == 1) lowest = error
                if (error > worst) worst = error
            }
            printf "%s,%s,%s,%s\n", short(lowest, 2), short(worst, 2), short(step, 3), status
        }' "$scratch/report.json"
}

# table NAME: NAME.csv as a table of the page.
table()
{
    awk 'NR == 1 { n = gsub(/,/, " | "); print "| " $0 " |"; printf "|"; for (i = 0; i <= n; ++i) printf "---:|"; print "" }
        NR > 1 { gsub(/,/, " | "); print "| " $0 " |" }' "$tables/$1.csv" > "$scratch/$1.md"
    put "$page" "$1" "$scratch/$1.md"
}

stack()
{
    echo "layers,substeps,sweeps,lowest %,worst %,step ms,status"
    for layers in 1 4 16 50; do
        stack_scene $layers > "$scratch/stack.json"
        for setting in "20 1" "20 2" "20 4" "20 8" "20 16" "20 32" "5 2" "10 2" "40 2" "80 2"; do
            substeps=${setting% *} sweeps=${setting#* }
            run "$scratch/stack.json" "method.substeps=$substeps" "contact.sweeps=$sweeps"
            echo "$layers,$substeps,$sweeps,$(pushed $layers)"
        done
    done
}

# creep: how far any vertex of four layers at rest is after 30 s from where it was after 10 s.
creep()
{
    echo "sweeps,creep mm"
    stack_scene 4 | sed 's/"duration": 0.5/"duration": 30/' > "$scratch/creep.json"
    for sweeps in 2 4 8 16 24 32; do
        "$program" run "$scratch/creep.json" --device cpu:serial --no-picture --every 600 --out "$scratch/creep" \
            --set contact.sweeps=$sweeps > /dev/null
        awk -v sweeps=$sweeps '
            $1 == "v" && FNR == NR { x[FNR] = $2; y[FNR] = $3; z[FNR] = $4 }
            $1 == "v" && FNR != NR {
                far = sqrt(($2 - x[FNR]) ^ 2 + ($3 - y[FNR]) ^ 2 + ($4 - z[FNR]) ^ 2)
                if (far > most) most = far
            }
            END { printf "%d,%.2g\n", sweeps, 1000 * most }' "$scratch/creep/mesh_00001.obj" "$scratch/creep/mesh_00003.obj"
        rm -rf "$scratch/creep"
    done
}

# laden_scene FLOOR DENSITY HEIGHT: a box of 10 cm whose middle starts at that height, over cloth of 0.4 m and
# 0.2 kg/m^2 on a mesh that stands still or on a plane.
laden_scene()
{
    case $1 in
        mesh) under='{"grid": {"cells": [6, 6], "size": [2, 2]}, "material": {"thickness": 0.003}, "kinematic": {},
 "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -90}}},' collider= ;;
        plane) under='' collider='"colliders": [{"plane": {}, "friction": 0.4}], ' ;;
    esac
    cat << END
{"taut": 1, "duration": 0.8, "contact": {"friction": 0.4}, $collider"bodies": [$under
{"grid": {"cells": [12, 12], "size": [0.4, 0.4]}, "contact": {"self": true},
 "material": {"density": 0.2, "thickness": 0.003, "bending_stiffness": 0.0001},
 "transform": {"translate": [0.02, 0.01, 0.01], "rotate": {"axis": [1, 0, 0], "degrees": -90}}},
{"box": {"cells": [4, 4, 4], "size": [0.1, 0.1, 0.1]}, "transform": {"translate": [0, $3, 0]},
 "material": {"density": $2, "youngs_modulus": 200000, "poissons_ratio": 0.3, "thickness": 0.003}}]}
END
}

# laden: of three falls, each 4 mm higher than the last, how many runs with default settings are completed where solids
# fall onto cloth that lies on something; and with 8 sweeps.
laden()
{
    echo "floor,kg/m3,fall cm,xpbd,vbd,implicit_euler,xpbd 8,vbd 8,implicit_euler 8"
    for floor in mesh plane; do
        for density in 50 500 2000 8000; do
            for fall in 0.9 23; do
                row=$floor,$density,$fall
                for sweeps in automatic 8; do
                    for method in xpbd vbd implicit_euler; do
                        completed=0
                        for more in 0 0.4 0.8; do
                            laden_scene $floor $density "$(awk -v fall=$fall -v more=$more \
                                'BEGIN { print 0.066 + (fall + more) / 100 }')" > "$scratch/laden.json"
                            run "$scratch/laden.json" method.type=$method contact.sweeps=$sweeps
                            [ "$(field status)" != completed ] || completed=$((completed + 1))
                        done
                        row=$row,$completed
                    done
                done
                echo "$row"
            done
        done
    done
}

# stages: what of the time of a step goes into contact, into the guarantee and into all else, %.
stages()
{
    echo "scene,step ms,contact %,guarantee %,all else %"
    for of in 05_stack 14_bowl 16_through_layers 31_hooked_rings 57_limited; do
        run "examples/contact/$of.json" duration=0.5
        awk -v name=$of '
            { value = $2; gsub(/[",]/, "", value) }
            $1 == "\"median\":" && step == "" { step = value }
            $1 == "\"name\":" { effect = value }
            $1 == "\"ms\":" { all += value; part[effect] += value }
            END {
                printf "%s,%.3g,%.0f,%.0f,%.0f\n", name, step, 100 * part["contact"] / all,
                    100 * part["guarantee"] / all, 100 * (all - part["contact"] - part["guarantee"]) / all
            }' "$scratch/report.json"
    done
}

# led_scene MESH SPEED: a mesh that is led by 1.5 m into a sheet of 0.5 m, held by its upper edge.
led_scene()
{
    case $1 in
        plate) shape='"grid": {"cells": [6, 6], "size": [0.2, 0.2]}, "material": {"thickness": 0.004}' from=-0.05 ;;
        ball) shape='"ball": {"cells": 4, "radius": 0.08}' from=-0.13 ;;
    esac
    end=$(awk -v v="$2" 'BEGIN { printf "%.5f", 1.5 / v }')
    duration=$(awk -v end="$end" 'BEGIN { printf "%.4f", (end < 0.5 ? end : 0.5) + 0.1 }')
    cat << END
{"taut": 1, "duration": $duration,
"contact": {"friction": 0.3, "guarantee": "no_crossing"}, "bodies": [
{$shape, "transform": {"translate": [0, 0, $from]},
 "kinematic": {"motion": [{"time": 0}, {"time": $end, "translate": [0, 0, 1.5]}]}},
{"grid": {"cells": [12, 12], "size": [0.5, 0.5]}, "material": {"density": 0.2, "stretch_stiffness": 3000,
 "bending_stiffness": 0.00001, "thickness": 0.004}, "contact": {"self": true}, "pins": [{"edge": "top"}]}]}
END
}

# field NAME: a number or word of the report.
field()
{
    awk -v name="\"$1\":" '$1 == name { value = $2; gsub(/[",]/, "", value); print value; exit }' "$scratch/report.json"
}

# led: what the guarantee does where meshes are led into cloth fast; "without": what the run says without it.
led()
{
    echo "mesh,m/s,method,status,pinched,steps in parts,of steps,stretch %,median step ms,95th percentile ms,without"
    for mesh in plate ball; do
        for speed in 1 10 50 100; do
            led_scene $mesh $speed > "$scratch/led.json"
            for method in xpbd vbd implicit_euler; do
                run "$scratch/led.json" method.type=$method
                row=$(field status),$(field pinched),$(field refined),$(field frames)
                row=$row,$(field max_stretch | awk '{ printf "%.2g", 100 * $1 }'),$(field median | awk '{ printf "%.3g", $1 }')
                row=$row,$(field p95 | awk '{ printf "%.3g", $1 }')
                run "$scratch/led.json" method.type=$method contact.guarantee=none
                echo "$mesh,$speed,$method,$row,$(field status)"
            done
        done
    done
}

for name in "$@"; do
    case $name in
        stack) stack > "$scratch/$name.csv" ;;
        creep) creep > "$scratch/$name.csv" ;;
        laden) laden > "$scratch/$name.csv" ;;
        stages) stages > "$scratch/$name.csv" ;;
        led) led > "$scratch/$name.csv" ;;
        *) echo "$0: no table is called $name" >&2; exit 2 ;;
    esac
    cp "$scratch/$name.csv" "$tables/$name.csv"
    table "$name"
done
