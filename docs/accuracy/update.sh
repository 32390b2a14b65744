#!/bin/sh
# Measures what accuracy costs, with every method, and writes the pages of this folder anew: no number of a table
# is typed by hand. Two studies run side by side on one core each; times are CPU time, the median of ten repetitions in
# turns with all other settings of the study, so that a busy machine spoils little. Cloth (README.md) takes some forty
# minutes, solids (solids.md) twenty, effects (effects.md) one. LIMITS in the environment stands in for the limits of
# timing, to try the script: LIMITS="--timing-seconds 0".
#
#   docs/accuracy/update.sh build/release/taut [cloth|solids|effects...]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [cloth|solids|effects...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
wanted=" ${*:-cloth solids effects} "
cd "$(dirname "$0")/../.."
folder=docs/accuracy
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
common="--device cpu:serial --rank cpu ${LIMITS:---repeats 10 --timing-seconds 600}"
# Past the rest test and the tolerance of linear solves, down to what rounding leaves.
floors="--rest-tolerance 1e-13 --linear-tolerance 1e-12 --rest-seconds 60"

study() # NAME SCENE [OPTION...]
{
    name=$1 scene=$2
    shift 2
    mkdir -p "$scratch/$name"
    echo "taut cost $scene $*" > "$scratch/$name/command"
    "$program" cost "$scene" "$@" --out "$scratch/$name" > "$scratch/$name/text" || [ $? -eq 1 ]
}
is_wanted() { case "$wanted" in *" $1 "*) ;; *) return 1 ;; esac }
# side_by_side FIRST SECOND: two functions, one core each.
side_by_side()
{
    "$1" & one=$!
    "$2" & two=$!
    wait $one
    wait $two
}

cloth_first()
{
    study spring examples/accuracy/spring.json --methods all $common
    study chain_1 examples/accuracy/chain_1.json --methods all $common
    study chain_100 examples/accuracy/chain_100.json --methods all $common
    study chain_10000 examples/accuracy/chain_10000.json --methods all $common
    study elastica examples/accuracy/elastica.json --methods all $common
    study precision examples/accuracy/chain_1.json --methods all --precision float,double \
        --substeps 4,16,64,256,1000 --iterations 1 $floors $common
    study ratio_mass examples/accuracy/chain_1.json --methods all --ratio mass --substeps 64 $common
    study ratio_stiffness examples/accuracy/chain_1.json --methods all --ratio stiffness --substeps 64 $common
    study conserved examples/accuracy/spring.json --methods all --conserved --substeps 8 --device cpu:serial
    study conserved_free examples/accuracy/free.json --methods all --conserved --substeps 8 --device cpu:serial
}

cloth_second()
{
    study net_9 examples/accuracy/net_9.json --methods all $common
    study net_17 examples/accuracy/net_17.json --methods all $common
    study net_33 examples/accuracy/net_33.json --methods all $common
    sh examples/accuracy/net.sh 65 '"damping": 4' > "$scratch/net_65.json"
    study net_65 "$scratch/net_65.json" --methods xpbd,vbd,implicit_euler --substeps 8,32 --iterations 1,4 \
        $common
    { echo "examples/accuracy/net.sh 65 '\"damping\": 4' > net_65.json"
      sed "s|$scratch/||" "$scratch/net_65/command"; } > "$scratch/command"
    mv "$scratch/command" "$scratch/net_65/command"
    study cloth examples/accuracy/cloth.json --methods all $common
    study slide examples/accuracy/slide.json --methods all $common
}

solids_first()
{
    study beam examples/accuracy/beam.json --methods all --rest-seconds 8 $common
    study beam_16 examples/accuracy/beam_16.json --methods xpbd,vbd,implicit_euler --substeps 1,4,16 \
        --iterations 1,4 --rest-seconds 8 $common
    study ratio_mass_solids examples/accuracy/beam.json --methods all --ratio mass --ratios 1,10,100,1000 \
        --substeps 16 --rest-seconds 8 $common
}

solids_second()
{
    study cube examples/accuracy/cube.json --methods all $common
    study ball examples/accuracy/ball.json --methods all $common
    study ball_surface examples/accuracy/ball_surface.json --methods all $common
    study precision_solids examples/accuracy/cube.json --methods all --precision float,double \
        --substeps 4,16,64,256 --iterations 1 --linear-tolerance 1e-12 $common
    study conserved_solids examples/accuracy/cube_free.json --methods all --conserved --substeps 8 \
        --device cpu:serial
}

if is_wanted cloth; then
    side_by_side cloth_first cloth_second
    sh "$folder/write.sh" "$program" "$scratch"
fi
if is_wanted solids; then
    side_by_side solids_first solids_second
    sh "$folder/write_solids.sh" "$program" "$scratch"
fi
if is_wanted effects; then
    study effects examples/scenes/all_effects.json --ablation --device cpu:serial
    sh "$folder/write_effects.sh" "$program" "$scratch"
fi
sh "$folder/check.sh"
