#!/usr/bin/env bash
# Whether a second core ever costs time: `cpu` over `cpu:serial`, both in turns within one process, over many processes.
#   tests/bench/second_core.sh TAUT_CORES_BENCH [PROCESSES [TURNS]]      20 processes of 20 turns
# Prints CSV: the processes and the round trips of a cache line that they found, then by scene the median, the least and the
# largest of the processes' ratios of median steps. With BUSY=1 beside a process that keeps one core busy.
set -euo pipefail
bench=$1 processes=${2:-20} turns=${3:-20}
work=$(mktemp -d)
busy=
trap 'rm -rf "$work"; [ -z "$busy" ] || kill "$busy"' EXIT

if [ "${BUSY:-0}" = 1 ]; then
    (while :; do :; done) &
    busy=$!
fi
for ((k = 1; k <= processes; ++k)); do
    "$bench" "$turns" > "$work/$k.csv"
done
sed -n 's/.*core and back: \([0-9]*\) ns.*/\1/p' "$work"/*.csv | sort -n > "$work/trips"

echo "# $processes processes of $turns turns${busy:+ beside a busy one}; a cache line to another core and back:" \
    "$(head -1 "$work/trips") to $(tail -1 "$work/trips") ns"
echo "scene,ratio median,ratio least,ratio largest"
grep '^hanging' "$work/1.csv" | cut -d, -f1 | while read -r scene; do
    cat "$work"/*.csv | awk -F, -v scene="$scene" '$1 == scene { print $4 }' | sort -n |
        awk -v scene="$scene" '{ r[NR] = $1 } END {
            printf "%s,%.2f,%.2f,%.2f\n", scene, (r[int((NR + 1) / 2)] + r[int(NR / 2) + 1]) / 2, r[1], r[NR] }'
done
