#!/bin/sh
# Measures what accuracy costs, with every method, and writes this folder anew: no number in README.md is typed
# by hand. Two studies run side by side on one core each; times are CPU time, so that a busy machine spoils
# little. It takes some ten minutes.
#
#   docs/accuracy/update.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
folder=docs/accuracy
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
common="--device cpu:serial --rank cpu --timing-seconds 0.3"

study() # NAME SCENE [OPTION...]
{
    name=$1 scene=$2
    shift 2
    mkdir -p "$scratch/$name"
    echo "taut cost $scene $*" > "$scratch/$name/command"
    "$program" cost "$scene" "$@" --out "$scratch/$name" > "$scratch/$name/text" || [ $? -eq 1 ]
}

first()
{
    study spring examples/accuracy/spring.json --methods all $common
    study chain_1 examples/accuracy/chain_1.json --methods all $common
    study chain_100 examples/accuracy/chain_100.json --methods all $common
    study chain_10000 examples/accuracy/chain_10000.json --methods all $common
    study elastica examples/accuracy/elastica.json --methods all $common
    study precision examples/accuracy/chain_1.json --methods all --precision float,double \
        --substeps 4,16,64,256,1000 --iterations 1 $common
    study ratio_mass examples/accuracy/chain_1.json --methods all --ratio mass --substeps 64 $common
    study ratio_stiffness examples/accuracy/chain_1.json --methods all --ratio stiffness --substeps 64 $common
    study conserved examples/accuracy/spring.json --methods all --conserved --substeps 8 --device cpu:serial
    study conserved_free examples/accuracy/free.json --methods all --conserved --substeps 8 --device cpu:serial
}

second()
{
    study net_17 examples/accuracy/net_17.json --methods all $common
    study net_33 examples/accuracy/net_33.json --methods all $common
    study cloth examples/accuracy/cloth.json --methods all $common
    study slide examples/accuracy/slide.json --methods all $common
}

first & one=$!
second & two=$!
wait $one
wait $two
sh "$folder/write.sh" "$program" "$scratch"
sh "$folder/check.sh"
