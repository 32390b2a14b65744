#!/bin/sh
# What the pages conclude is what their tables say, and the tables of a page are the CSV files beside it: exit status 0
# when all of it holds. In CI.
#
#   docs/check.sh [PAGE...]      cloth, contact, fabric, solids, hybrid, linear, acad, accuracy, bench, gpu, tune, sleep; all without
set -eu
cd "$(dirname "$0")"
. ./put.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bad=0
[ $# -gt 0 ] || set -- cloth contact fabric solids hybrid linear acad accuracy bench gpu tune sleep
for page in "$@"; do
    case $page in
        accuracy) sh accuracy/check.sh ;;
        cloth) check_tables cloth.md cloth || bad=1
            check_bench cloth.md size size.csv 7 || bad=1
            check_bench cloth.md bullet bullet.csv || bad=1
            awk -f claims.awk -f cloth/claims.awk cloth.md cloth/*.csv \
            ../tests/bench/results/bullet.csv ../tests/bench/results/size.csv ;;
        acad) check_tables methods/acad.md methods/acad || bad=1
            check_bench methods/acad.md acad acad.csv || bad=1
            awk -f claims.awk -f methods/acad/claims.awk methods/acad.md methods/acad/compress.csv \
            ../tests/bench/results/acad.csv ;;
        bench) for shown in ../README.md bench.md; do
            awk -v whole=1 -f claims.awk -f bench/claims.awk $shown ../tests/bench/results/epyc-2-cores.csv \
            ../tests/bench/results/solid.csv ../tests/bench/results/acad.csv || bad=1
            done ;;
        contact) check_tables results/contact.md results/contact || bad=1
            awk -f claims.awk -f results/contact/claims.awk results/contact.md results/contact/*.csv ;;
        fabric) awk -f claims.awk -f fabric/claims.awk fabric.md fabric/overhang.csv ;;
        hybrid) check_bench hybrid.md hybrid hybrid.csv || bad=1
            check_bench hybrid.md split split.csv || bad=1
            awk -f claims.awk -f hybrid/claims.awk hybrid.md ../tests/bench/results/split.csv ;;
        gpu) awk -f results/gpu/claims.awk results/gpu.md ../tests/hardware/radv.csv || bad=1 ;;
        tune) check_tables tune.md tune || bad=1
            awk -f claims.awk -f tune/claims.awk tune.md tune/tune.csv ;;
        linear) for part in crossover condition residuals; do
                check_bench linear.md $part linear_$part.csv || bad=1
            done
            awk -f claims.awk -f linear/claims.awk linear.md ../tests/bench/results/linear_*.csv ;;
        sleep) check_bench sleep.md sleep sleep.csv || bad=1 ;;
        *) check_tables "$page.md" "$page" || bad=1
            awk -f claims.awk -f "$page/claims.awk" "$page.md" "$page"/*.csv ;;
    esac
done
exit $bad
