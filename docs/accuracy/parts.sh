# What the pages of this folder are put together from. `program`, `scratch` and `folder` are the caller's.
keep_problems() # NAME...: the tables and diagrams of studies
{
    for name in "$@"; do
        cp "$scratch/$name/cost.csv" "$folder/${name}_cost.csv"
        for file in cost cost_work cost_substeps cost_iterations; do
            cp "$scratch/$name/$file.svg" "$folder/${name}_$file.svg"
        done
    done
}
written_by() # what wrote a page, and where
{
    echo "Written by \`docs/accuracy/update.sh\` with $("$program" --version), commit" \
         "$(git describe --always --dirty=' with changes' 2>/dev/null || echo unknown)," \
         "on $1 of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)."
}
gaps() # FILE: the table of what has no point, if there is any
{
    [ ! -s "$1" ] || { echo; cat "$1"; }
}
quoted() { sed 's/^/    /' "$1"; }
problem() # NAME TEXT
{
    echo
    echo "### $1"
    echo
    echo "$2"
    echo
    quoted "$scratch/$1/command"
    echo
    grep '^reference\|^ *passed over' "$scratch/$1/text" | sed 's/^reference */Reference /; s/^ *passed/Passed/'
    echo
    echo "![error against CPU time, $1]($1_cost.svg)"
    echo "![error against sweeps, $1]($1_cost_work.svg)"
    echo "![error against substeps, $1]($1_cost_substeps.svg)"
    echo "![error against iterations, $1]($1_cost_iterations.svg)"
    gaps "$scratch/$1/cost_gaps.md"
    echo
    echo "All settings, refused ones with their reason: [CSV]($1_cost.csv)."
}
