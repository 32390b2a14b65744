# For docs/substeps/update.sh: solids that lie on a floor or fall on it, and how many of them end as `completed`.

# on_floor GAP HEIGHT SHAPE E NU: a solid as $scratch/scene.json, GAP above a floor; HEIGHT is that of its middle over its lowest
# point. Densities are 1,100 kg/m³.
on_floor()
{
    above=$(awk -v gap="$1" -v height="$2" 'BEGIN { print gap + height }')
    scene '"duration": '"$duration"', "bodies": [{'"$3"', "material": {"density": 1100, "youngs_modulus": '"$4"',
        "poissons_ratio": '"$5"', "model": "neo_hookean"}, "transform": {"translate": [0, '"$above"', 0]}}],
        "colliders": [{"plane": {"normal": [0, 1, 0]}}]'
}
ball() { echo "\"ball\": {\"cells\": $1, \"radius\": $2}"; }
cube() { echo "\"box\": {\"cells\": [$1, $1, $1], \"size\": [0.1, 0.1, 0.1]}"; }
is_completed() { runs "$scratch/scene.json" "$@"; [ "$(report status)" = completed ]; }

balls()
{
    duration=1
    row "radius, cells" 'least of 10, 20, 40, 80 substeps that `completed` takes, 1e8 Pa, ν 0.45' taken
    while read -r radius cells; do
        on_floor 0.001 $radius "$(ball $cells $radius)" 1e8 0.45
        least="more than 80"
        for count in 10 20 40 80; do
            if is_completed method.substeps=$count; then least=$count; break; fi
        done
        row "$radius m, $cells" "$least" "$(substeps "$scratch/scene.json")"
    done <<END
0.05 4
0.05 6
0.05 10
0.1 4
0.1 6
0.1 10
0.5 10
END
}
table balls "|---|---:|---:|" balls

named()
{
    duration=1
    row "substeps named" 'not `completed`, of 45'
    for many in 10 40; do
        count=0
        for radius in 0.05 0.1 0.5; do for cells in 4 6 10; do for modulus in 1e4 2e6 1e7 1e8 1e10; do
            on_floor 0.001 $radius "$(ball $cells $radius)" $modulus 0.45
            if ! is_completed method.substeps=$many; then count=$((count + 1)); fi
        done; done; done
        row $many $count
    done
}
table named "|---:|---:|" named

# lying_row METHOD SHAPE CELLS...: a row of "lying".
lying_row()
{
    method=$1 shape=$2
    shift 2
    ten=0 own=0
    for cells in "$@"; do for modulus in 2e6 1e7 1e8; do for nu in 0.45 0.49 0.499; do
        case $shape in
            balls) on_floor 0.001 0.05 "$(ball $cells 0.05)" $modulus $nu ;;
            cubes) on_floor 0.001 0.05 "$(cube $cells)" $modulus $nu ;;
        esac
        if is_completed method.type=$method method.substeps=10; then ten=$((ten + 1)); fi
        if is_completed method.type=$method; then own=$((own + 1))
        else echo "$shape, $method, $cells cells, $modulus Pa, ν $nu: $(report status)" >&2; fi
    done; done; done
    row "$shape, \`$method\`" $ten $own
}
lying()
{
    duration=1
    row '`completed`, of 18' "ten substeps" 'without `substeps`'
    lying_row vbd balls 4 6
    lying_row implicit_euler balls 4 6
    lying_row vbd cubes 3 4
    lying_row implicit_euler cubes 3 4
}
table lying "|---|---:|---:|" lying

# pressed_share [SETTING...]: elastic energy at the end, of the weight times the height; a cube of 0.1 m lies 1 mm above the floor.
pressed_share()
{
    runs "$scratch/scene.json" "$@"
    report potential_energy |
        awk '{ x = ($1 - 1.1 * 9.81 * 0.051) / (1.1 * 9.81 * 0.1); printf x < 10 ? "%.2g\n" : "%.0f\n", x }'
}
pressed()
{
    duration=1
    row "method, E, ν" substeps "energy / (weight × height)" "with ten"
    for method in xpbd implicit_euler; do for modulus in 1e6 1e8 1e10; do for nu in 0.3 0.45 0.499; do
        on_floor 0.001 0.05 "$(cube 4)" $modulus $nu
        own=$(pressed_share method.type=$method)
        ten=$(pressed_share method.type=$method method.substeps=10)
        row "\`$method\`, $modulus Pa, $nu" "$(substeps "$scratch/scene.json" method.type=$method)" "$own" "$ten"
    done; done; done
}
table pressed "|---|---:|---:|---:|" pressed

# fallen NU [SETTING...]: how many of the twelve cubes do not end as `completed`.
fallen()
{
    nu=$1 count=0
    shift
    for modulus in 1e6 1e8; do for cells in 3 4; do for gap in 0.001 0.002 0.005; do
        on_floor $gap 0.05 "$(cube $cells)" $modulus $nu
        if ! is_completed "$@"; then count=$((count + 1)); fi
    done; done; done
    echo $count
}
falling()
{
    duration=0.5
    row ν '`vbd`, 10' '`vbd`, 20' '`vbd`, 40' '`vbd`, 60' '`implicit_euler`, 10' '`implicit_euler`, 20' '`implicit_euler`, 40' \
        '`xpbd`, without `substeps`'
    for nu in 0.45 0.49 0.495 0.499; do
        set -- $nu
        for many in 10 20 40 60; do set -- "$@" "$(fallen $nu method.type=vbd method.substeps=$many)"; done
        for many in 10 20 40; do set -- "$@" "$(fallen $nu method.type=implicit_euler method.substeps=$many)"; done
        row "$@" "$(fallen $nu method.type=xpbd)"
    done
}
table falling "|---|---:|---:|---:|---:|---:|---:|---:|---:|" falling

# named_few KEYS...: runs a scene of these keys with 1 to 10 substeps under xpbd and implicit_euler, and counts how many end as
# `completed` of those that are warned of and of the others.
named_few()
{
    scene '"duration": 1, '"$*"
    for method in xpbd implicit_euler; do for many in 1 2 3 4 5 7 10; do
        runs "$scratch/scene.json" method.type=$method method.substeps=$many
        right=0
        [ "$(report status)" != completed ] || right=1
        [ "$(report status)" != diverged ] || right=2
        if grep -q "for these solids automatic takes" "$scratch/report"; then
            warned=$((warned + 1)); warned_right=$((warned_right + (right == 1))); warned_blown=$((warned_blown + (right == 2)))
        else silent=$((silent + 1)); silent_right=$((silent_right + (right == 1))); silent_blown=$((silent_blown + (right == 2)))
        fi
    done; done
}
few()
{
    warned=0 warned_right=0 warned_blown=0 silent=0 silent_right=0 silent_blown=0
    floor='"colliders": [{"plane": {"normal": [0, 1, 0]}}]'
    for modulus in 1e5 1e6 1e7 1e8; do
        stuff='"material": {"density": 1100, "youngs_modulus": '$modulus', "poissons_ratio": 0.45, "model": "neo_hookean"}'
        while read -r shape height; do
            named_few '"bodies": [{'"$shape, $stuff"', "transform": {"translate": [0, '$height', 0]}}], '"$floor"
        done <<END
"box":{"cells":[3,3,3],"size":[0.2,0.2,0.2]} 0.1
"box":{"cells":[3,3,3],"size":[0.2,0.2,0.2]} 0.3
"box":{"cells":[6,6,6],"size":[0.2,0.2,0.2]} 0.1
"box":{"cells":[4,4,4],"size":[0.04,0.04,0.04]} 0.02
"box":{"cells":[4,4,4],"size":[2,2,2]} 1
"ball":{"cells":6,"radius":0.1} 0.101
END
        named_few '"damping": 2, "bodies": [{"box": {"cells": [8, 2, 2], "size": [0.4, 0.1, 0.1]}, '"$stuff"', "pins": [{"face": "left"}]}]'
        named_few '"damping": 2, "bodies": [{"box": {"cells": [2, 6, 2], "size": [0.1, 0.3, 0.1]}, '"$stuff"', "pins": [{"face": "top"}]}]'
    done
    row 'of the 448 runs' runs '`completed`' '`diverged`'
    row 'warned of' $warned $warned_right $warned_blown
    row 'the others' $silent $silent_right $silent_blown
}
table few "|---|---:|---:|---:|" few
