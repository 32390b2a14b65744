#!/usr/bin/env bash
# The step of every method in two builds of the program, one run: median of the step, smallest of three turns.
#   tests/bench/two_builds.sh OLD_TAUT NEW_TAUT [DEVICE]      DEVICE: cpu:serial
# Prints a table in Markdown: ms of the old build, of the new one, and their ratio. Settings are given, so that
# both builds take the same substeps; a run that ends as anything but completed still has a time.
set -euo pipefail
old=$1 new=$2 device=${3:-cpu:serial}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

scene() { # NAME METHOD SUBSTEPS ITERATIONS BODY
    local more=
    case $2 in mass_spring | acad) more=', "stability": "substep"' ;; esac
    printf '{"taut": 1, "duration": 1, "damping": 0.5, "bodies": [%s],
        "method": {"type": "%s", "substeps": %s, "iterations": %s%s}}' "$5" "$2" "$3" "$4" "$more" \
        > "$work/$1 $2.json"
}
cloth='{"grid": {"cells": [48, 48]}, "pins": [{"corners": ["top_left", "top_right"]}],
    "material": {"stretch_stiffness": 1000, "bending_stiffness": 1e-5}}'
solid='{"box": {"cells": [8, 8, 8], "size": [0.5, 0.5, 0.5]}, "pins": [{"faces": ["top"]}],
    "material": {"youngs_modulus": 1e5, "poissons_ratio": 0.3}}'
springs=${solid/'"material": {'/'"material": {"model": "springs", "volume_stiffness": 0, '}
for method in 'mass_spring 20 1' 'implicit_euler 2 1' 'implicit_constraints 2 1' 'acad 5 1' 'pbd 10 1' 'xpbd 10 1' \
    'vbd 5 4'; do
    # shellcheck disable=SC2086 # words
    scene cloth $method "$cloth"
done
for method in 'implicit_euler 2 1' 'xpbd 10 1' 'vbd 5 4'; do
    # shellcheck disable=SC2086 # words
    scene solid $method "$solid"
done
for method in 'mass_spring 20 1' 'implicit_constraints 2 1' 'acad 5 1' 'pbd 10 1'; do
    # shellcheck disable=SC2086 # words
    scene solid $method "$springs"
done

step_of() { # PROGRAM SCENE
    "$1" run "$2" --device "$device" --no-picture --out "$work/out" > /dev/null 2> "$work/errors" || true
    sed -n '/"step_ms"/,/}/s/.*"median": \([0-9.e+-]*\).*/\1/p' "$work/out/report.json"
    rm -rf "$work/out"
}
echo "| scene | before, ms | after, ms | after / before |"
echo "|---|---:|---:|---:|"
for file in "$work"/*.json; do
    a=() b=()
    for _ in 1 2 3; do a+=("$(step_of "$old" "$file")") b+=("$(step_of "$new" "$file")"); done
    awk -v name="$(basename "$file" .json)" -v a="${a[*]}" -v b="${b[*]}" 'BEGIN {
        n = split(a, x, " "); m = split(b, y, " "); p = q = 1e9
        for (i = 1; i <= n; ++i) p = x[i] < p ? x[i] : p
        for (i = 1; i <= m; ++i) q = y[i] < q ? y[i] : q
        if (n == 0 || m == 0) printf "| %s | %s | %s | |\n", name, n ? p : "-", m ? q : "-"
        else printf "| %s | %.3g | %.3g | %.2f |\n", name, p, q, q / p }'
done
