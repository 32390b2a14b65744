#!/bin/sh
# Every expression of tests/mutants_host.txt changes its file: a mutant of code that has moved breaks nothing.
cd "$(dirname "$0")/../.." || exit 1
changed=$(mktemp) || exit 1
trap 'rm -f "$changed"' EXIT
worst=0
while IFS='|' read -r name file expression; do
    case $name in '' | '#'*) continue ;; esac
    if ! sed "$expression" "$file" > "$changed" || [ ! -s "$changed" ] || cmp -s "$changed" "$file"; then
        echo "tests/mutants_host.txt: $name changes nothing in $file: $expression"
        worst=1
    fi
done < tests/mutants_host.txt
exit $worst
