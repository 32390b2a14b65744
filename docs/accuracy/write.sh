#!/bin/sh
# Puts the studies of update.sh into this folder and writes README.md: write.sh PROGRAM SCRATCH
set -eu
program=$1 scratch=$2
folder=docs/accuracy
problems="spring chain_1 chain_100 chain_10000 net_9 net_17 net_33 net_65 cloth elastica slide"
. "$folder/parts.sh"
keep_problems $problems
cp "$scratch/precision/cost.csv" "$folder/precision.csv"
cp "$scratch/precision/cost_substeps.svg" "$folder/precision.svg"
for what in mass stiffness; do
    cp "$scratch/ratio_$what/ratio_$what.csv" "$scratch/ratio_$what/ratio_$what.svg" "$folder"
done
for name in conserved conserved_free; do
    cp "$scratch/$name/energy.svg" "$folder/${name}_energy.svg"
done
cp "$scratch/conserved_free/momentum.svg" "$folder/conserved_free_momentum.svg"

{
    cat "$folder/head.md"
    written_by "one core each"
    echo
    echo "## In plain words"
    echo
    echo "<!-- from the tables; check.sh compares -->"
    sh "$folder/facts.sh"
    echo "<!-- end -->"
    echo
    echo "## Work-precision and convergence, problem by problem"
    problem spring "One kilogram on a spring of 100 N/m: 38 frames a period."
    problem chain_1 "Twenty links of 100000 N/m and 10 g each, at rest."
    problem chain_100 "The same with a bob of 100 links."
    problem chain_10000 "The same with a bob of 10000 links."
    problem net_9 "A clamped net of 9 x 9 vertices, stretched by 5 %, damped until it rests."
    problem net_17 "A clamped net of 17 x 17 vertices, stretched by 5 %, let go under gravity, undamped."
    problem net_33 "The same of 33 x 33 vertices, damped until it rests."
    problem net_65 "The same of 65 x 65 vertices; a few settings of three methods, for time."
    problem cloth "Cloth of 33 x 33 vertices, hung by two corners from level."
    problem elastica "A heavy strip clamped level; density x gravity x length^3 / rigidity = 10."
    problem slide "Cloth that slides down a slope with friction, pushed across it: friction turns as the way does."
    echo
    echo "## Precision floor"
    echo
    quoted "$scratch/precision/command"
    echo
    echo "Modes: \`float\` (with positions in two floats) and \`double\`. Plain float positions, and float kernels with"
    echo "a double residual, do not exist in the program; their floor cannot be shown. The settings run until they move by"
    echo "less than 1e-13 of the displacement a second, with linear solves down to 1e-12, so that neither is the floor:"
    echo "lines show both, the reference's own error and one rounding of each format."
    echo
    echo "![error against substeps in both precisions](precision.svg)"
    gaps "$scratch/precision/cost_gaps.md"
    for what in mass stiffness; do
        echo
        echo "## Ratio of $what"
        echo
        quoted "$scratch/ratio_$what/command"
        echo
        echo "![error against the ratio of $what](ratio_$what.svg)"
        gaps "$scratch/ratio_$what/ratio_${what}_gaps.md"
    done
    echo
    echo "## Energy and momentum"
    echo
    for name in conserved conserved_free; do
        quoted "$scratch/$name/command"
        echo
        sed '1d; s/^/- /' "$scratch/$name/text"
        echo
        echo "![energy against time](${name}_energy.svg)"
        echo
    done
    echo "![momentum against time](conserved_free_momentum.svg)"
    echo
    echo "## Linear systems"
    echo
    echo "Errors and residuals of conjugate gradients, and times by format: [docs/linear.md](../linear.md)."
    echo
    echo "## Solids, effects, hard cases"
    echo
    echo "The same for solids: [solids.md](solids.md). What each effect costs: [effects.md](effects.md). Which hard" \
         "case which method passes or refuses: [robustness.md](../results/robustness.md)."
} > "$scratch/README.md"
mv "$scratch/README.md" "$folder/README.md"
