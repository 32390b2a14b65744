# For the update.sh of the pages.
#
# put PAGE PART FILE: what stands between "<!-- PART -->" and "<!-- end -->" of a page becomes the
# text of a file. `scratch` is the caller's folder.
put()
{
    awk -v part="$2" -v table="$3" '
        $0 == "<!-- " part " -->" {
            print; print ""
            while ((getline line < table) > 0) print line
            print ""; skip = 1
        }
        $0 == "<!-- end -->" { skip = 0 }
        !skip && $0 != "<!-- " part " -->" { print }' "$1" > "$scratch/page.md"
    mv "$scratch/page.md" "$1"
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
