#!/bin/sh
# What the pages conclude is what their tables say, and the tables of a page are the CSV files beside it: exit status 0
# when all of it holds. In CI.
#
#   docs/check.sh [PAGE...]      without a page, all of `pages`
set -eu
pages="cloth continuum contact fabric solids hybrid linear acad accuracy bench gpu tune sleep substeps"
results=../tests/bench/results
cd "$(dirname "$0")"
. ./put.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bad=0
[ $# -gt 0 ] || set -- $pages
for page in "$@"; do
    case $page in
        accuracy) sh accuracy/check.sh ;;
        cloth) check_tables cloth.md cloth || bad=1
            check_bench cloth.md size size.csv 7 || bad=1
            check_bench cloth.md bullet bullet.csv || bad=1
            awk -f claims.awk -f cloth/claims.awk cloth.md cloth/*.csv \
            $results/bullet.csv $results/size.csv ;;
        acad) check_tables methods/acad.md methods/acad || bad=1
            check_bench methods/acad.md acad acad.csv || bad=1
            awk -f claims.awk -f methods/acad/claims.awk methods/acad.md methods/acad/compress.csv \
            $results/acad.csv ;;
        bench) awk -v whole=1 -f claims.awk -f bench/claims.awk ../README.md $results/medians.csv \
            $results/solid.csv $results/acad.csv $results/linear_peers.csv $results/size.csv || bad=1
            check_tables bench.md $results || bad=1
            check_bench bench.md sweeps epyc-2-cores.csv 0 1 || bad=1
            check_bench bench.md steps epyc-2-cores.csv 0 1 || bad=1
            check_bench bench.md hanging_box solid.csv 0 1 || bad=1
            check_bench bench.md block_descent solid.csv 0 1 || bad=1
            awk -f claims.awk -f bench/conclusions.awk bench.md $results/epyc-2-cores.csv $results/solid.csv \
            $results/medians.csv $results/second_core.csv $results/second_core_busy.csv $results/start.csv $results/host.csv || bad=1 ;;
        continuum) check_tables cost.md continuum || bad=1
            awk -f claims.awk -f continuum/claims.awk cost.md continuum/meshes.csv ;;
        contact) check_tables results/contact.md results/contact || bad=1
            awk -f claims.awk -f results/contact/claims.awk results/contact.md results/contact/*.csv ;;
        fabric) check_numbers fabric.md sag fabric/sag.csv "1 2" 1 7 || bad=1
            check_numbers fabric.md overhang fabric/overhang.csv "1 2 3" || bad=1
            awk -f claims.awk -f fabric/claims.awk fabric.md fabric/*.csv ;;
        hybrid) check_bench hybrid.md hybrid hybrid.csv || bad=1
            check_bench hybrid.md split split.csv || bad=1
            check_numbers hybrid.md split $results/split.csv "2 3" 2 "6 10 11 12 13" || bad=1
            awk -f claims.awk -f hybrid/claims.awk hybrid.md $results/split.csv $results/hybrid.csv ;;
        gpu) awk -f results/gpu/claims.awk -f claims.awk results/gpu.md ../tests/hardware/radv.csv || bad=1 ;;
        tune) check_tables tune.md tune || bad=1
            awk -f claims.awk -f tune/claims.awk tune.md tune/*.csv ;;
        linear) for part in crossover condition residuals; do
                check_bench linear.md $part linear_$part.csv || bad=1
            done
            # What is left out is formed of several rows: the best time of an iteration, shares, and a digit's price.
            check_numbers linear.md peers $results/linear_peers.csv 2 1 4 || bad=1
            check_numbers linear.md peers $results/linear_peers.csv "" 2 || bad=1
            check_numbers linear.md peers $results/linear_peers.csv 2 3 5 || bad=1
            check_numbers linear.md thesis $results/linear_thesis.csv "1 2 3 4" || bad=1
            check_numbers linear.md precision $results/linear_precision.csv "1 5" 1 9 || bad=1
            awk -F, '$7 == "1e-08"' $results/linear_precision.csv > "$scratch/preconditioners.csv"
            check_numbers linear.md precision "$scratch/preconditioners.csv" "1 6" 2 || bad=1
            check_numbers linear.md inventory $results/linear_inventory.csv "1 2" || bad=1
            awk -f claims.awk -f linear/claims.awk linear.md $results/linear_*.csv ;;
        sleep) check_bench sleep.md sleep sleep.csv || bad=1
            awk -f claims.awk -f sleep/claims.awk sleep.md $results/sleep.csv ;;
        solids) check_tables solids.md solids || bad=1
            cat solids/volume.csv solids/iterations.csv > "$scratch/published.csv"
            check_numbers solids.md published "$scratch/published.csv" "" 1 2 || bad=1
            awk -f claims.awk -f solids/claims.awk solids.md solids/*.csv ;;
        substeps) check_tables methods.md substeps || bad=1
            awk -f claims.awk -f substeps/claims.awk methods.md substeps/*.csv ;;
        *) echo "no page is called $page: take some of $pages" >&2 && exit 2 ;;
    esac
done
exit $bad
