#!/bin/sh
# Tables and sentences from the CSV files of this folder, on standard output: facts.sh [cloth|solids]
set -eu
cd "$(dirname "$0")"
if [ "${1:-cloth}" = solids ]; then
    problems="beam beam_16 cube ball ball_surface" others="precision_solids ratio_mass_solids"
else
    problems="spring chain_1 chain_100 chain_10000 net_9 net_17 net_33 net_65 cloth elastica slide"
    others="precision ratio_mass ratio_stiffness"
fi
set --
for name in $problems; do
    [ ! -f "${name}_cost.csv" ] || set -- "$@" "${name}_cost.csv"
done
for name in $others; do
    [ ! -f "$name.csv" ] || set -- "$@" "$name.csv"
done
exec awk -f facts.awk "$@"
