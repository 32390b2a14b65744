#!/bin/sh
# Makes the tables and pictures of docs/solids.md anew: no number between its marks is typed by hand. Figures of
# real meshes are made where the data is: TAUT_DATA, else ../shared/data.
#
#   docs/solids/update.sh build/release/taut [FIGURE...]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 PROGRAM [FIGURE...] (the built taut)" >&2; exit 2; }
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
page=docs/solids.md
scenes=examples/scenes/solids
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wanted=" $* "
curves=" volume_drop volume_squeeze "
. docs/put.sh

springs="bodies[0].material.model=springs"
bare="$springs; bodies[0].material.volume_stiffness=0"
surface="$springs; bodies[0].material.volume=surface; bodies[0].material.volume_stiffness=rigid"
ms="method.type=mass_spring; method.stability=substep"

figure volume $scenes/drop.json \
    "springs: device=cpu; $ms; $bare" \
    "springs, lengths held: device=cpu; method.type=implicit_constraints; method.substeps=5; method.constraint_compliance=0; method.linear_operator=matrix_free; $bare" \
    "springs, volume of the surface: device=cpu; $ms; $surface" \
    "the same, native serial: device=cpu:serial; $ms; $surface" "the same, Vulkan: device=vulkan; $ms; $surface" \
    "the same, OpenGL: device=opengl; $ms; $surface"
# over_time NAME SCENE: the volume error of the thesis' two models as curves.
over_time()
{
    pbd="device=cpu; method.type=pbd; method.substeps=1; $springs; method.iterations"
    figure "$1" "$2" "springs: device=cpu; $ms; $bare" "springs, volume of the surface: device=cpu; $ms; $surface" \
        "pbd, 1 iteration: $pbd=1" "pbd, 5 iterations: $pbd=5" "pbd, 10 iterations: $pbd=10" \
        "pbd, 20 iterations: $pbd=20"
}
over_time volume_drop $scenes/drop.json
over_time volume_squeeze $scenes/recovery.json
figure stiffness $scenes/stiffness.json \
    "E = 3e4 Pa: device=cpu; bodies[0].material.youngs_modulus=3e4" "1e5: device=cpu" \
    "1e6: device=cpu; bodies[0].material.youngs_modulus=1e6" \
    "3e4, volume held: device=cpu; bodies[0].material.youngs_modulus=3e4; bodies[0].material.volume=surface; bodies[0].material.volume_stiffness=rigid" \
    "1e6, volume held: device=cpu; bodies[0].material.youngs_modulus=1e6; bodies[0].material.volume=surface; bodies[0].material.volume_stiffness=rigid"
figure methods $scenes/drop.json \
    "xpbd, neo-Hookean: device=cpu" "vbd, neo-Hookean: device=cpu; method.type=vbd; method.substeps=10; method.iterations=4" \
    "implicit Euler, neo-Hookean: device=cpu; method.type=implicit_euler; method.substeps=2; method.iterations=2; method.linear_operator=matrix_free" \
    "xpbd, springs and volumes: device=cpu; $springs" "pbd, springs and volumes: device=cpu; method.type=pbd; method.substeps=5; method.iterations=4; $springs" \
    "implicit constraints: device=cpu; method.type=implicit_constraints; method.linear_operator=matrix_free; method.substeps=5; $springs" \
    "mass-spring, surface: device=cpu; $ms; $surface"
figure recovery $scenes/recovery.json \
    "xpbd, neo-Hookean: device=cpu" "vbd, neo-Hookean: device=cpu; method.type=vbd; method.substeps=10; method.iterations=4" \
    "xpbd, springs and volumes: device=cpu; $springs" "mass-spring: device=cpu; $ms; $bare" \
    "mass-spring, surface: device=cpu; $ms; $surface"
figure twist $scenes/twist.json \
    "xpbd, neo-Hookean: device=cpu" "vbd, neo-Hookean: device=cpu; method.type=vbd; method.substeps=10; method.iterations=4" \
    "xpbd, springs and volumes: device=cpu; $springs" "mass-spring: device=cpu; $ms; $bare" \
    "mass-spring, surface: device=cpu; $ms; $surface"
figure iterations $scenes/iterations.json \
    "1 iteration: device=cpu; method.iterations=1" "2: device=cpu; method.iterations=2" "5: device=cpu; method.iterations=5" \
    "10: device=cpu" "20: device=cpu; method.iterations=20" "10, Vulkan: device=vulkan" "10, OpenGL: device=opengl"
figure schemes $scenes/iterations.json \
    "colours, native serial: device=cpu:serial" "colours, native: device=cpu" \
    "by vertices, native serial: device=cpu:serial; method.scheme=node_centric" \
    "by vertices, native: device=cpu; method.scheme=node_centric" \
    "by constraints, native serial: device=cpu:serial; method.scheme=constraint_centric" \
    "by constraints, native: device=cpu; method.scheme=constraint_centric" \
    "colours, Vulkan: device=vulkan" "by vertices, Vulkan: device=vulkan; method.scheme=node_centric" \
    "by constraints, Vulkan: device=vulkan; method.scheme=constraint_centric" \
    "colours, OpenGL: device=opengl" "by vertices, OpenGL: device=opengl; method.scheme=node_centric" \
    "by constraints, OpenGL: device=opengl; method.scheme=constraint_centric"

# published NAME: mean volumes of the thesis beside ours, from the tables above.
published()
{
    case "$wanted" in "  " | *" $1 "*) ;; *) return 0 ;; esac
    mean() # FIGURE VARIANT
    {
        awk -v variant="$2" '
            { line = $0 }
            NR == 1 { n = split(line, head, ","); for (i = 1; i <= n; ++i) if (head[i] == "mean volume %") at = n - i }
            index(line, variant ",") == 1 || index(line, "\"" variant "\",") == 1 {
                n = split(line, cell, ","); print cell[n - at] }' "${page%.md}/$1.csv"
    }
    {
        echo "| | published, mean volume % | here, mean volume % |"
        echo "|---|---:|---:|"
        echo "| mass-spring | 68.21 | $(mean volume springs) |"
        echo "| distance constraints | 89.64 | $(mean volume 'springs, lengths held') |"
        echo "| volume constraint | 98.70 | $(mean volume 'springs, volume of the surface') |"
        echo "| position-based, 10 iterations | | $(mean iterations 10) |"
    } > "$scratch/$1.md"
    put "$page" "$1" "$scratch/$1.md"
}
published published

# cheapest NAME SCENE: what taut tune finds by volume.
cheapest()
{
    case "$wanted" in "  " | *" $1 "*) ;; *) return 0 ;; esac
    echo "$1" >&2
    set -- "$1" tune "$2" --by volume --error 0.01 --precision float --device cpu:serial --timing-seconds 0.3
    name=$1
    shift
    { echo "taut $*" && echo && "$program" "$@"; } > "$scratch/$name" || [ $? -eq 1 ]
    grep -v '^  ' "$scratch/$name" | sed 's/^\(.\)/    \1/' > "$scratch/$name.md"
    put "$page" "$name" "$scratch/$name.md"
}
cheapest cheapest $scenes/iterations.json

# mesh NAME FILE SCALE HEIGHT: a real mesh in place of the ball of iterations.json.
data=${TAUT_DATA:-../shared/data}
mesh()
{
    case "$wanted" in "  " | *" $1 "*) ;; *) return 0 ;; esac
    [ -f "$2" ] || { echo "SKIPPED: $2 is not there" >&2; return 0; }
    cat > "$scratch/$1.json" <<END
{
  "taut": 1, "timestep": 0.02, "duration": 2, "damping": 0.1,
  "method": {"type": "pbd", "substeps": 1, "iterations": 10, "stretch": 0.8},
  "bodies": [{
    "tetrahedra": "$(realpath "$2")",
    "material": {"model": "springs", "poissons_ratio": 0.4, "thickness": 0.005},
    "transform": {"scale": $3, "translate": [0, $4, 0]}
  }],
  "colliders": [{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.5}]
}
END
    figure "$1" "$scratch/$1.json" "1 iteration: device=cpu; method.iterations=1" \
        "5: device=cpu; method.iterations=5" "10: device=cpu" "20: device=cpu; method.iterations=20"
}
mesh bunny "$data/tets/bunny0.msh" 0.7 1.2
mesh armadillo "$data/tets/Armadillo13K.vtk" 0.01 1.3

# The dragon is a surface with two holes of three edges and some faces that cut each other: closed, untangled by one
# smoothing of those faces, and filled by TetGen, from packages (tetgen).
dragon()
{
    case "$wanted" in "  " | *" dragon "*) ;; *) return 0 ;; esac
    surface=$data/meshes/ChineseDragon-10kv.off
    for needed in "$surface" "$(command -v tetgen || echo tetgen)"; do
        [ -f "$needed" ] || { echo "SKIPPED: dragon, $needed is not there" >&2; return 0; }
    done
    awk -f docs/solids/close_off.awk "$surface" > "$scratch/closed.off"
    (cd "$scratch" && tetgen -dV closed.off) > "$scratch/cuts" || true
    awk -f docs/solids/smooth_off.awk "$scratch/cuts" "$scratch/closed.off" > "$scratch/dragon.off"
    "$program" tetrahedralise "$scratch/dragon.off" --program tetgen --out "$scratch/dragon.mesh" >&2
    mesh dragon "$scratch/dragon.mesh" 0.01 1.03
}
dragon
