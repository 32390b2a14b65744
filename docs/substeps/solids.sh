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
