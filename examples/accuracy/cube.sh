#!/bin/sh
# A neo-Hookean cube of 1 m, 4 x 4 x 4 cells of five tetrahedra, that starts squeezed to SHARE of its height and is
# let go. Nothing pulls, nothing holds it.
#
#   examples/accuracy/cube.sh cube 0.5 1 "0, 0, 0" > cube.json     (NAME, SHARE, damping in 1/s, velocity in m/s)
#   examples/accuracy/cube.sh cube_free 0.8 0 "0.2, 0.1, 0.05" > cube_free.json
set -eu
[ $# -eq 4 ] || { echo "usage: $0 NAME SHARE DAMPING VELOCITY" >&2; exit 2; }
awk -v name="$1" -v share="$2" -v damping="$3" -v velocity="$4" 'BEGIN {
    n = 4
    printf "{\n  \"taut\": 1,\n  \"name\": \"%s\",\n  \"timestep\": 0.016666666666666666,\n  \"duration\": 1,\n", name
    printf "  \"damping\": %s,\n  \"gravity\": [0, 0, 0],\n  \"bodies\": [\n    {\n", damping
    printf "      \"name\": \"neo-Hookean cube, squeezed to %s of its height\",\n", share
    printf "      \"box\": {\"cells\": [%d, %d, %d], \"size\": [1, 1, 1]},\n", n, n, n
    printf "      \"material\": {\"model\": \"neo_hookean\", \"density\": 1000, \"youngs_modulus\": 20000, "
    printf "\"poissons_ratio\": 0.3},\n      \"velocity\": [%s],\n      \"start_positions\": [\n", velocity
    for (z = 0; z <= n; ++z)
        for (y = 0; y <= n; ++y) {
            printf "        "
            for (x = 0; x <= n; ++x)
                printf "[%.10g, %.10g, %.10g]%s", x / n - 0.5, share * (y / n - 0.5), z / n - 0.5, \
                       x < n ? ", " : y < n || z < n ? ",\n" : "\n"
        }
    printf "      ]\n    }\n  ]\n}\n"
}'
