#!/bin/sh
# Measures what accuracy costs for the example scenes and writes this folder anew: no number in README.md
# is typed by hand. Run it on a machine that does nothing else; it takes a minute or two.
#
#   docs/accuracy/update.sh build/release/taut
set -eu
[ $# -eq 1 ] || { echo "usage: $0 PROGRAM (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
folder=docs/accuracy
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

study() # NAME SCENE DEVICE [OPTION...]
{
    name=$1 scene=$2 device=$3
    shift 3
    "$program" cost "$scene" --device "$device" "$@" --out "$scratch/$name" > "$scratch/$name.txt"
    for file in cost.csv cost.svg cost_work.svg; do
        mv "$scratch/$name/$file" "$folder/${name}_$file"
    done
    {
        echo "## $name"
        echo
        echo "    taut cost $scene --device $device${*:+ $*} --out OUT"
        echo
        grep '^reference\|^ *passed over' "$scratch/$name.txt" | sed 's/^reference */Reference /; s/^ */ /; s/^ Ref/Ref/'
        echo
        grep '^[0-9.]* %' "$scratch/$name.txt" | sed 's/^/- /'
        echo
        echo "![error against time](${name}_cost.svg)"
        echo
        echo "![error against sweeps](${name}_cost_work.svg)"
        echo
        echo "All settings ([CSV](${name}_cost.csv)):"
        echo
        sed -n '/^precision/,/^[0-9.]* %/p' "$scratch/$name.txt" | sed '/^[0-9.]* %/d; s/^/    /'
        echo
    } >> "$scratch/README.md"
}

{
    echo "# Results of \`taut cost\`"
    echo
    echo "How errors, references and times are taken, and how to read the diagrams, says [cost.md](../cost.md)."
    echo "Written by \`docs/accuracy/update.sh\` with $("$program" --version), commit" \
         "$(git describe --always --dirty=' with changes' 2>/dev/null || echo unknown),"
    echo "on $(nproc) cores of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)."
    echo "Error columns are in per cent, times in ms per simulated second."
    echo
} > "$scratch/README.md"
study hanging examples/scenes/hanging.json cpu
study strip_static examples/scenes/strip_static.json cpu
study strip_static_vulkan examples/scenes/strip_static.json vulkan --substeps 5,20,50 --iterations 1,5
mv "$scratch/README.md" "$folder/README.md"
