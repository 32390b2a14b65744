#!/bin/sh
# Tables and sentences from the CSV files of this folder, on standard output.
set -eu
cd "$(dirname "$0")"
set --
for name in spring chain_1 chain_100 chain_10000 net_17 net_33 cloth elastica slide; do
    [ ! -f "${name}_cost.csv" ] || set -- "$@" "${name}_cost.csv"
done
for name in precision ratio_mass ratio_stiffness; do
    [ ! -f "$name.csv" ] || set -- "$@" "$name.csv"
done
exec awk -f facts.awk "$@"
