# For docs/substeps/update.sh: running scenes, reading what they leave, writing rows. `program` is the built taut, `scratch` a
# folder, `page` the page of the tables.

# scene TEXT...: makes $scratch/scene.json of the keys of a scene, whose files are named as from the root of the repository.
scene() { echo "{\"taut\": 1, $*}" | sed "s|\"examples/|\"$PWD/examples/|g" > "$scratch/scene.json"; }

# of_page N: the keys of the scene that stands as (N) below a table of the page.
of_page()
{
    awk -v mark="    ($1) " '
        !/^    / { inside = 0 }
        /^    \([0-9]\) / { inside = index($0, mark) == 1; sub(/^    \([0-9]\)/, "") }
        inside { sub(/^ +/, ""); print }' "$page"
}

# runs SCENE [SETTING...]: the report is in $scratch/report then, the first and the last mesh in $scratch/run.
runs()
{
    ran=$1
    shift
    rm -rf "$scratch/run"
    "$program" run "$ran" ${1:+--set "$@"} --json --device cpu:serial --no-picture --every 100000 --out "$scratch/run" \
        > "$scratch/report" 2> "$scratch/log" || [ $? -eq 1 ] || { cat "$scratch/log" >&2; exit 1; }
    grep -q '"status"' "$scratch/report" || { cat "$scratch/log" >&2; exit 1; }
}

# substeps SCENE [SETTING...]: as many as a step of it takes.
substeps()
{
    planned=$1
    shift
    "$program" plan "$planned" ${1:+--set "$@"} --json | awk '$1 == "\"substeps\":" { print $2 + 0 }'
}

# report KEY: a value of the report, without quotes.
report() { awk -v key="\"$1\":" '$1 == key { gsub(/[",]/, "", $2); print $2; exit }' "$scratch/report"; }

# said: what a cell says of how the run ended, nothing when it is `completed` without the warning `soft`.
said()
{
    if [ "$(report status)" != completed ]; then echo ", \`$(report status)\`"
    elif [ -n "$(report soft)" ]; then echo ", warning \`soft\`"; fi
}

# digits X [N [UNIT]]: X with N digits (3), and its unit.
digits()
{
    awk -v x="$1" -v n="${2:-3}" -v unit="${3:+ $3}" 'BEGIN {
        size = x < 0 ? -x : x
        shown = sprintf(size > 0 && size < 0.001 ? "%.5f" : "%#." n "g", x)
        sub(/\.$/, "", shown)
        print shown unit }'
}

# last_mesh AWK: a line of awk at the end of the last mesh, which has x, y, z of its k vertices.
last_mesh()
{
    awk '$1 == "v" { ++k; x[k] = $2; y[k] = $3; z[k] = $4 } END { '"$1"' }' "$(ls "$scratch"/run/*.obj | tail -1)"
}
lowest() { last_mesh 'low = y[1]; for (i = 2; i <= k; ++i) if (y[i] < low) low = y[i]; print low'; }
highest_z() { last_mesh 'high = z[1]; for (i = 2; i <= k; ++i) if (z[i] > high) high = z[i]; print high'; }

# sunk: m, the furthest that a vertex has come down from the first mesh to the last.
sunk()
{
    awk '
        FNR == 1 { k = 0 }
        $1 != "v" { next }
        { ++k }
        FILENAME == ARGV[1] { y[k] = $3; next }
        y[k] - $3 > most { most = y[k] - $3 }
        END { print most + 0 }' "$scratch"/run/*.obj
}

# row CELL...: a line of CSV.
row()
{
    between=
    for cell in "$@"; do
        case $cell in *[,\"]*) cell="\"$(printf %s "$cell" | sed 's/"/""/g')\"" ;; esac
        printf '%s%s' "$between" "$cell"
        between=,
    done
    echo
}

# table NAME ALIGNMENT FUNCTION: the rows that a function writes, as docs/substeps/NAME.csv and as the part of the page.
table()
{
    case "$wanted" in "  " | *" $1 "*) ;; *) return 0 ;; esac
    echo "$1" >&2
    "$3" > "$scratch/$1.csv"
    if grep -E '(^|,)(,|$)' "$scratch/$1.csv" >&2; then echo "$1: a cell is empty" >&2; exit 1; fi
    mv "$scratch/$1.csv" "docs/substeps/$1.csv"
    awk -f docs/table.awk -f docs/claims.awk "docs/substeps/$1.csv" |
        awk -v alignment="$2" '{ print } NR == 1 { print alignment }' > "$scratch/$1.md"
    put "$page" "$1" "$scratch/$1.md"
}
