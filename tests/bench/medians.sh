#!/usr/bin/env bash
# The tables of taut_bench over many processes: where the system puts the threads is decided once a process, and one
# process says little of the next.
#   tests/bench/medians.sh TAUT_BENCH PROCESSES TABLE...      for example: ... 20 distance cloth
# Prints CSV: the processes and the round trips of a cache line that they found, then of each row the median, the
# least and the largest of the processes' median times and of their ratios, with the largest error.
set -euo pipefail
bench=$1 processes=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for ((k = 1; k <= processes; ++k)); do
    "$bench" "$@" "$work/$k.csv" > "$work/$k.md"
done
sed -n 's/.*core and back: \([0-9]*\) ns.*/\1/p' "$work"/*.csv | sort -n > "$work/trips"

# of FIELD WHAT: the field of that row in every process, as "median,least,largest".
of() {
    awk -F' *[|] *' -v what="$2" -v field="$1" '$2 == what { print $field }' "$work"/*.md | sort -n |
        awk '{ v[NR] = $1 } END { printf "%.3g,%.3g,%.3g", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2, v[1], v[NR] }'
}

# worst WHAT: the largest error of that row in any process.
worst() {
    awk -F' *[|] *' -v what="$1" '$2 == what && $5 + 0 >= most + 0 { most = $5 } END { print most }' "$work"/*.md
}

echo "# $processes processes of taut_bench $*; a cache line to another core and back:" \
    "$(head -1 "$work/trips") to $(tail -1 "$work/trips") ns"
echo "what,ms median,ms least,ms largest,error m,ratio median,ratio least,ratio largest,to,target"
awk -F' *[|] *' '/^[|] / && $2 != "what" { print $2 "|" $7 "|" $8 }' "$work/1.md" | while IFS='|' read -r what to target; do
    echo "\"$what\",$(of 3 "$what"),$(worst "$what"),$(of 6 "$what"),\"$to\",$target"
done
