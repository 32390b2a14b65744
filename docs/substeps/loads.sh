# For docs/substeps/update.sh: bodies that ask for substeps by other things than their weight, cloth that pins draw apart, and
# chains that swing.

# asks NAME WHAT N NUMBER UNIT REFERENCE SETTING: a row of "asked", scene (N); NUMBER prints it from report and meshes.
asks()
{
    scene "$(of_page "$3")"
    set -- "$1 ($3)" "$2" "$4" "$5" "$6" "$7" "$(substeps "$scratch/scene.json")"
    for settings in "" method.substeps=10 "$6"; do
        runs "$scratch/scene.json" $settings
        set -- "$@" "$(digits "$("$3" | awk -v unit="$4" '{ print unit * $1 }')")$(said)"
    done
    row "$1" "$2" "$7" "$8" "$9" "${10}, $5"
}
kinetic() { report kinetic_energy; }
elastic() { report potential_energy; }
volume() { report final; }
asked()
{
    row 'scene: `{"taut": 1, ...}`' what substeps "so many" "with 10" right
    implicit="method.type=implicit_euler"
    asks "sail of fabric, 4 m/s" "bulge, mm" 1 highest_z 1000 '`implicit_euler`' $implicit
    asks "sail of springs, 3 m/s" "bulge, mm" 2 highest_z 1000 '`implicit_euler`' $implicit
    asks "strip of 1 m, 0.8 N m" "tip, mm" 3 lowest 1000 '`implicit_euler`' $implicit
    asks 'the same, 5 cm and 0.003 N m, "plate"' "tip, mm" 4 lowest 1000 "1,000 substeps" method.substeps=1000
    asks 'sheet that its pins turn, `vbd`' "kinetic energy, J" 5 kinetic 1 '`implicit_euler`' $implicit
    asks "plastic cloth that its pins draw" "elastic energy, J" 7 elastic 1 '`implicit_euler`' $implicit
    asks "ball with a gas of -20 Pa" "volume, of that at rest" 6 volume 1 "300 substeps" method.substeps=300
}
table asked "|---|---|---:|---:|---:|---:|" asked

# off: mm, the furthest that a vertex of the last mesh is from its place in $scratch/there.obj.
off()
{
    awk 'FNR == 1 { k = 0 }
        $1 != "v" { next }
        { ++k }
        FILENAME == ARGV[1] { x[k] = $2; y[k] = $3; z[k] = $4; next }
        { far = sqrt((x[k] - $2) ^ 2 + (y[k] - $3) ^ 2 + (z[k] - $4) ^ 2); if (far > most) most = far }
        END { print 1000 * most }' "$scratch/there.obj" "$(ls "$scratch"/run/*.obj | tail -1)"
}
drawn()
{
    row strain material 'energy, `implicit_euler`' "substeps taken: off" "substeps taken: energy" "with ten: off" "with ten: energy"
    for material in springs fabric; do for strain in 0.05 0.2; do
        case $material in
            springs) stiff='"stretch_stiffness": 1e4' ;;
            fabric) stiff='"fabric": {"warp": 1e4, "weft": 1e4, "shear": 500}' ;;
        esac
        scene '"duration": 2, "damping": 2, "gravity": [0, 0, 0], "bodies": [{"grid": {"cells": [12, 12], "size": [1, 1]},
            "material": {"density": 0.2, "bending_stiffness": 1e-4, '$stiff'}, "pins": [{"edge": "left"}, {"edge": "right",
            "motion": [{"time": 0}, {"time": 1, "translate": ['$strain', 0, 0]}]}]}]'
        runs "$scratch/scene.json" method.type=implicit_euler
        cp "$(ls "$scratch"/run/*.obj | tail -1)" "$scratch/there.obj"
        set -- "$(digits "$(elastic)" 3 J)$(said)"
        for settings in "" method.substeps=10; do
            runs "$scratch/scene.json" $settings
            set -- "$@" "$(digits "$(off)" 2 mm)" "$(digits "$(elastic)" 3 J)$(said)"
        done
        row $strain $material "$@"
    done; done
}
table drawn "|---:|---|---:|---:|---:|---:|---:|" drawn

# swings LINKS LENGTH K DEGREES SECONDS [MASS]: a row of "chains"; MASS is that of each vertex, without it the material's.
swings()
{
    name="$1 links, $2 m, $3 N/m, $4°, $5 s${6:+, $6 kg a vertex}"
    masses=
    [ $# -lt 6 ] || masses=$(awk -v n="$1" -v m="$6" 'BEGIN { printf "\"vertex_masses\": [" m; while (n--) printf "," m; print "]," }')
    scene '"duration": '"$5"', "bodies": [{"chain": {"links": '"$1"', "length": '"$2"'}, "material": {"stretch_stiffness": '"$3"'},
        '"$masses"' "pins": [{"corner": "first"}], "transform": {"rotate": {"axis": [0, 0, 1], "degrees": '"$4"'}}}]'
    runs "$scratch/scene.json" method.type=xpbd method.substeps=1000 method.precision=double
    cp "$(ls "$scratch"/run/*.obj | tail -1)" "$scratch/there.obj"
    [ "$(report status)" = completed ] || { echo "$name: the reference is $(report status)" >&2; exit 1; }
    set -- "$2" "$name" "$(substeps "$scratch/scene.json" method.type=vbd)"
    for settings in "" method.substeps=25; do
        runs "$scratch/scene.json" method.type=vbd $settings
        set -- "$@" "$(digits "$(off | awk -v all="$1" '{ print $1 / 1000 / all }')" 2)$(said)"
    done
    shift
    row "$@"
}
chains()
{
    row chain substeps "off, lengths" "with 25"
    swings 3 0.07 8e3 85 0.35
    swings 10 0.3 8e3 75 0.6
    swings 10 0.5 1e4 60 1
    swings 20 1 8e3 80 1
    swings 20 1 5e5 90 1 0.01
    swings 50 1 1e4 90 1
}
table chains "|---|---:|---:|---:|" chains
