# For the update.sh of the pages, and for check.sh: check_tables, check_bench and check_numbers.
#
# put PAGE PART FILE: what stands between "<!-- PART -->" and "<!-- end -->" of a page becomes the
# text of a file. `scratch` is the caller's folder. "<!--PART-->" and "<!--end-->" are marks too: in pages of which a test
# takes what stands between the others for a table of the program (docs/methods.md).
put()
{
    awk -v part="$2" -v table="$3" '
        { mark = $0; if (mark ~ /^<!--/) gsub(/ /, "", mark) }
        mark == "<!--" part "-->" {
            print; print ""
            while ((getline line < table) > 0) print line
            print ""; skip = 1
        }
        mark == "<!--end-->" { skip = 0 }
        !skip && mark != "<!--" part "-->" { print }' "$1" > "$scratch/page.md"
    mv "$scratch/page.md" "$1"
}

# put_table PAGE PART FILE: a CSV file, as it stands, as the table of a part; columns of numbers are not told apart.
put_table()
{
    awk -f docs/table.awk -f docs/claims.awk "$3" |
        awk '{ print } NR == 1 { gsub(/[^|]+/, "---"); print }' > "$scratch/put_table.md"
    put "$1" "$2" "$scratch/put_table.md"
}

# figure NAME SCENE VARIANT...: runs the variants of a scene, keeps table and picture beside the page, and the curves
# over time of those that `curves` names. For pages whose figures are comparisons: `program` is the built taut, `page`
# is docs/X.md, `wanted` is " NAME NAME " or two blanks for all, `curves` is " NAME NAME " or nothing.
figure()
{
    name=$1
    scene=$2
    shift 2
    case "$wanted" in "  " | *" $name "*) ;; *) return 0 ;; esac
    echo "$name" >&2
    for variant in "$@"; do
        set -- "$@" --variant "$variant"
        shift
    done
    "$program" compare "$scene" "$@" --out "$scratch/$name" > /dev/null || [ $? -eq 1 ]
    [ ! -f "$scratch/$name/compare.png" ] || cp "$scratch/$name/compare.png" "${page%.md}/$name.png"
    cp "$scratch/$name/compare.csv" "${page%.md}/$name.csv"
    case "${curves:-}" in *" $name "*) cp "$scratch/$name/compare_series.svg" "${page%.md}/$name.svg" ;; esac
    put "$page" "$name" "$scratch/$name/compare.md"
}

# check_tables PAGE FOLDER: every part NAME of a page for which FOLDER has NAME.csv is that table, cell by cell. Status 1
# with the lines that differ ("<" of the CSV, ">" of the page), or when no part has a table. `scratch` as for put.
check_tables()
{
    compared=0 differing=0
    for name in $(sed -n 's/^<!-- *\([a-z0-9_]*\) *-->$/\1/p' "$1"); do
        [ -f "$2/$name.csv" ] || continue
        compared=$((compared + 1))
        awk -f table.awk -f claims.awk "$2/$name.csv" > "$scratch/of_csv"
        sed -n "/^<!-- *$name *-->\$/,/^<!-- *end *-->\$/p" "$1" | grep '^|' | sed 2d > "$scratch/of_page"
        diff "$scratch/of_csv" "$scratch/of_page" >&2 ||
            { echo "$1: the table \"$name\" is not $2/$name.csv" >&2; differing=1; }
    done
    [ $compared -gt 0 ] || { echo "$1 has no table of $2" >&2; return 1; }
    return $differing
}

# check_bench PAGE PART FILE [COLUMN [SOME]]: the first table of a part is FILE of tests/bench/results, row by row, to the digits
# of the page (bench/rows.awk), or SOME (1) of its rows; COLUMN, a number, is in per cent on the page. Status 1 with what differs.
check_bench()
{
    sed -n "/^<!-- $2 -->\$/,/^<!-- end -->\$/p" "$1" | awk '/^\|/ { ++n; if (n > 2) print; next } n { exit }' > "$scratch/of_page"
    awk -v percent="${4:-0}" -v some="${5:-0}" -f bench/rows.awk -f claims.awk "$scratch/of_page" "../tests/bench/results/$3" ||
        { echo "$1: the table \"$2\" is not $3" >&2; return 1; }
}

# check_numbers PAGE PART FILE KEYS [TABLE [COLUMNS]]: the numbers of a part's table (the first, or TABLE) that is laid out
# otherwise than its file are fields of the rows that its first cells choose (bench/numbers.awk): "1 5" are the fields of the file
# that these cells are. COLUMNS of the page are left out.
check_numbers()
{
    sed -n "/^<!-- $2 -->\$/,/^<!-- end -->\$/p" "$1" | awk -v wanted="${5:-1}" '
        /^\|/ { if (!inside) { ++table; head = 2 } inside = 1; if (table == wanted && head <= 0) print; --head; next }
        { inside = 0 }' > "$scratch/of_page"
    awk -v keys="$4" -v skip=" ${6:-} " -f bench/numbers.awk -f claims.awk "$scratch/of_page" "$3" ||
        { echo "$1: table ${5:-1} of \"$2\" is not of $3" >&2; return 1; }
}
