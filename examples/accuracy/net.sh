#!/bin/sh
# A clamped net of N x N vertices, a square metre, held at its frame and stretched by 5 %: every spring of
# 1000 N/m is 1.05 times as long as at rest. Density 0.2 kg/m^2.
#
#   examples/accuracy/net.sh 17 "damping": 0 > net_17.json     (N, a line of JSON for the scene)
set -eu
[ $# -ge 1 ] || { echo "usage: $0 N [LINE]" >&2; exit 2; }
awk -v n="$1" -v line="${2:-}" 'BEGIN {
    rest = 1 / 1.05
    printf "{\n  \"taut\": 1,\n  \"name\": \"net_%d\",\n  \"timestep\": 0.016666666666666666,\n  \"duration\": 2,\n", n
    if (line != "") printf "  %s,\n", line
    printf "  \"bodies\": [\n    {\n      \"name\": \"net\",\n"
    printf "      \"grid\": {\"cells\": [%d, %d], \"size\": [%.15g, %.15g],\n", n - 1, n - 1, rest, rest
    printf "        \"network\": {\"structural\": 1000, \"shear\": 0, \"bend\": 0}},\n"
    printf "      \"material\": {\"density\": 0.2, \"stretch_stiffness\": 0},\n"
    printf "      \"pins\": [{\"edges\": [\"top\", \"bottom\", \"left\", \"right\"]}],\n"
    mass = 0.2 / ((n - 1) * (n - 1))
    printf "      \"vertex_masses\": ["
    for (i = 0; i < n * n; ++i) printf "%s%.10g", i ? ", " : "", mass
    printf "],\n      \"start_positions\": [\n"
    for (row = 0; row < n; ++row) {
        printf "        "
        for (column = 0; column < n; ++column)
            printf "[%.10g, 0, %.10g]%s", column / (n - 1) - 0.5, row / (n - 1) - 0.5, \
                   row == n - 1 && column == n - 1 ? "" : ", "
        printf "\n"
    }
    printf "      ]\n    }\n  ]\n}\n"
}'
