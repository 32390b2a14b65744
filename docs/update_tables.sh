#!/bin/sh
# Puts the tables of keys and of methods, which the program makes of its own, into docs/scene.md and
# docs/methods.md. A test of tests/unit/scene/docs_test.cpp fails where they differ.
#
#   docs/update_tables.sh [PROGRAM]     by default build/release/taut
set -eu
program=$(realpath "${1:-$(dirname "$0")/../build/release/taut}")
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
. docs/put.sh

"$program" schema --markdown > "$scratch/all.md"
sed -n 's/^<!-- \(.*\) -->$/\1/p' "$scratch/all.md" | grep -vx end > "$scratch/names"
while read -r name; do
    awk -v mark="<!-- $name -->" '
        /^<!-- end -->$/ { inside = 0 }
        inside && NF { print }
        $0 == mark { inside = 1 }' "$scratch/all.md" > "$scratch/table.md"
    page=docs/scene.md
    grep -qxF "<!-- $name -->" "$page" || page=docs/methods.md
    put "$page" "$name" "$scratch/table.md"
done < "$scratch/names"
