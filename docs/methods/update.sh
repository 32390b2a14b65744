#!/bin/sh
# Makes the figures of docs/methods/*.md that are comparisons anew: no number between their marks is typed by hand.
# What docs/benches.sh measures is not among them.
#
#   docs/methods/update.sh build/release/taut [FIGURE...]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [FIGURE...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
page=docs/methods/acad.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wanted=" $* "
. docs/put.sh

serial="device=cpu:serial"
figure compress examples/scenes/acad_compress.json "springs alone: $serial; method.type=mass_spring" \
    "stretched ones alone: $serial; method.compress=false" "compress: $serial" \
    "compress, released by strain: $serial; method.release=strain; method.release_strain=0.03" \
    "compress, 1 %: $serial; method.activate_strain=0.01"
