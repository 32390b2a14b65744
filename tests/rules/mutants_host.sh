#!/bin/sh
# Every expression of tests/mutants_host.txt changes its file: a mutant of code that has moved breaks nothing.
cd "$(dirname "$0")/../.." || exit 1
worst=0
while IFS='|' read -r name file expression; do
    case $name in '' | '#'*) continue ;; esac
    if sed "$expression" "$file" | cmp -s - "$file"; then
        echo "tests/mutants_host.txt: $name changes nothing in $file: $expression"
        worst=1
    fi
done < tests/mutants_host.txt
exit $worst
