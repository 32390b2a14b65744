#!/bin/sh
# Puts the studies of solids into this folder and writes solids.md: write_solids.sh PROGRAM SCRATCH
set -eu
program=$1 scratch=$2
folder=docs/accuracy
. "$folder/parts.sh"
keep_problems beam beam_16 cube ball ball_surface
cp "$scratch/precision_solids/cost.csv" "$folder/precision_solids.csv"
cp "$scratch/precision_solids/cost_substeps.svg" "$folder/precision_solids.svg"
for file in csv svg; do
    cp "$scratch/ratio_mass_solids/ratio_mass.$file" "$folder/ratio_mass_solids.$file"
done
cp "$scratch/conserved_solids/energy.svg" "$folder/conserved_solids_energy.svg"
cp "$scratch/conserved_solids/momentum.svg" "$folder/conserved_solids_momentum.svg"

{
    cat "$folder/head_solids.md"
    written_by "one core each"
    echo
    echo "## In plain words"
    echo
    cat "$folder/words_solids.md"
    echo "<!-- from the tables; check.sh compares -->"
    sh "$folder/facts.sh" solids
    echo "<!-- end -->"
    echo
    echo "## Work-precision and convergence, problem by problem"
    problem beam "A neo-Hookean beam of 8 x 2 x 2 cells, clamped at one end, sags under its weight to rest (P6)."
    problem beam_16 "The same beam of 16 x 4 x 4 cells: each size is compared with its own reference; a few settings, for time."
    problem cube "A neo-Hookean cube, squeezed to half its height, is let go and swings (P7)."
    problem ball "A ball of springs and volumes of tetrahedra falls on a floor and bounces."
    problem ball_surface "The thesis' own solid: the same ball, of springs and one volume within its surface, which mass_spring alone holds."
    echo
    echo "## Precision floor"
    echo
    quoted "$scratch/precision_solids/command"
    echo
    echo "![error against substeps in both precisions](precision_solids.svg)"
    gaps "$scratch/precision_solids/cost_gaps.md"
    echo
    echo "## Ratio of mass"
    echo
    quoted "$scratch/ratio_mass_solids/command"
    echo
    echo "The vertex that is made heavier is a corner of the beam's free end."
    echo
    echo "![error against the ratio of mass](ratio_mass_solids.svg)"
    gaps "$scratch/ratio_mass_solids/ratio_mass_gaps.md"
    echo
    echo "There is no sweep over stiffness: a body of tetrahedra has one material, and \`--ratio stiffness\` refuses it."
    echo
    echo "## Energy and momentum"
    echo
    quoted "$scratch/conserved_solids/command"
    echo
    sed '1d; s/^/- /' "$scratch/conserved_solids/text"
    echo
    echo "![energy against time](conserved_solids_energy.svg)"
    echo "![momentum against time](conserved_solids_momentum.svg)"
    echo
    echo "## Hard cases"
    echo
    echo "Which hard case of solids which method passes or refuses: [robustness.md](../results/robustness.md)."
} > "$scratch/solids.md"
mv "$scratch/solids.md" "$folder/solids.md"
