#!/bin/sh
# Makes the tables and pictures of docs/cloth.md anew: no number between its marks is typed by hand. The figures "size"
# and "bullet" are made by taut_size_bench and taut_bullet_bench beside the program (TAUT_BUILD_TESTS; libbullet-dev).
#
#   docs/cloth/update.sh build/release/taut [FIGURE...]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [FIGURE...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
page=docs/cloth.md
scenes=examples/scenes/cloth
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wanted=" $* "
. docs/put.sh

constraints="method.type=implicit_constraints; method.constrained=structural; method.constraint_compliance=0; method.substeps=8; method.iterations=2"
acad="method.type=acad; method.constrained=structural; method.constraint_compliance=0; method.activate_strain=0.05"
network() # STRUCTURAL SHEAR BEND
{
    echo "bodies[0].grid.network.structural=$1; bodies[0].grid.network.shear=$2; bodies[0].grid.network.bend=$3"
}

# Looser solves than elsewhere: software Vulkan and OpenGL pay half a millisecond for each of their dispatches. The
# strains are those of solves to 1e-5.
loose="method.type=implicit_constraints; method.substeps=16; method.linear_iterations=20; method.linear_tolerance=1e-2"
figure apis $scenes/apis.json "springs, native serial: device=cpu:serial" "springs, native on all cores: device=cpu" \
    "springs, Vulkan: device=vulkan" "springs, OpenGL: device=opengl" \
    "constraints, native serial: device=cpu:serial; $loose" \
    "constraints, native on all cores: device=cpu; $loose" \
    "constraints, Vulkan: device=vulkan; $loose" "constraints, OpenGL: device=opengl; $loose"
figure stiffness $scenes/stiffness.json "k = 20 N/m: device=cpu; $(network 20 10 2)" "k = 100: device=cpu" \
    "k = 500: device=cpu; $(network 500 250 50)" "k = 2500: device=cpu; $(network 2500 1250 250)"
figure constraints $scenes/constraints.json "springs alone: device=cpu" "structural springs enforced: device=cpu; $constraints" \
    "all enforced with their own compliance: device=cpu; method.type=implicit_constraints; method.substeps=8"
figure acad_stiffness $scenes/acad_stiffness.json "k = 20 N/m: device=cpu; $(network 20 10 2)" "k = 100: device=cpu; $(network 100 50 10)" \
    "k = 500: device=cpu; method.stability=substep; $(network 500 250 50)"
figure large_force $scenes/large_force.json "springs: device=cpu" "adaptive: device=cpu; $acad" "enforced: device=cpu; $constraints" \
    "xpbd: device=cpu; method.type=xpbd" "vertex block descent: device=cpu; method.type=vbd; method.iterations=2; method.substeps=16"
figure acad_load $scenes/acad_load.json "springs: device=cpu" "adaptive, 5 %: device=cpu; $acad" \
    "adaptive, 1 %: device=cpu; $acad; method.activate_strain=0.01"
figure pbd_devices $scenes/pbd_devices.json "native serial: device=cpu:serial" "native on all cores: device=cpu" "Vulkan: device=vulkan" \
    "OpenGL: device=opengl" "native, by vertices: device=cpu; method.scheme=node_centric" \
    "native, by constraints: device=cpu; method.scheme=constraint_centric"
figure pbd_stretch $scenes/pbd_stretch.json "stretch 0.9: device=cpu; method.stretch=0.9" \
    "0.99: device=cpu; method.stretch=0.99" "0.999: device=cpu; method.stretch=0.999" "1: device=cpu"
figure pbd_bend $scenes/pbd_bend.json "bend 0: device=cpu; method.bend=0" "0.02: device=cpu; method.bend=0.02" \
    "0.1: device=cpu; method.bend=0.1" "0.5: device=cpu; method.bend=0.5"
figure pbd_iterations $scenes/pbd_iterations.json "1 iteration: device=cpu; method.iterations=1" "4: device=cpu; method.iterations=4" \
    "20: device=cpu" "80: device=cpu; method.iterations=80"
figure pbd_sphere $scenes/pbd_sphere.json "4 x 5: device=cpu" "1 x 20: device=cpu; method.substeps=1; method.iterations=20" \
    "20 x 1: device=cpu; method.substeps=20; method.iterations=1"
figure methods $scenes/methods.json "xpbd: device=cpu" "pbd: device=cpu; method.type=pbd" "mass_spring: device=cpu; method.type=mass_spring; method.stability=substep" \
    "implicit_euler: device=cpu; method.type=implicit_euler; method.substeps=2; method.iterations=1" \
    "implicit_constraints: device=cpu; method.type=implicit_constraints; method.substeps=5" \
    "acad: device=cpu; method.type=acad; method.stability=substep" \
    "vbd: device=cpu; method.type=vbd; method.substeps=5; method.iterations=2"
figure opencloth examples/scenes/opencloth.json "pbd, native serial: device=cpu:serial" "native on all cores: device=cpu" \
    "Vulkan: device=vulkan" "OpenGL: device=opengl" "xpbd: device=cpu:serial; method.type=xpbd"

# bench NAME [ARGUMENT...]: the table of taut_NAME_bench. Wants a machine that does nothing else.
bench()
{
    case "$wanted" in "  " | *" $1 "*) ;; *) return 0 ;; esac
    name=$1
    shift
    bench=$(dirname "$program")/tests/bench/taut_${name}_bench
    [ -x "$bench" ] || { echo "SKIPPED: $bench is not built" >&2; return 0; }
    echo "$name" >&2
    "$bench" "tests/bench/results/$name.csv" "$@" > "$scratch/$name.md"
    put "$page" "$name" "$scratch/$name.md"
}
bench size docs/cloth
bench bullet
