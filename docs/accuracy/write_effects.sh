#!/bin/sh
# Puts the ablation into this folder and writes effects.md: write_effects.sh PROGRAM SCRATCH
set -eu
program=$1 scratch=$2
folder=docs/accuracy
. "$folder/parts.sh"
cp "$scratch/effects/ablation.csv" "$folder/effects.csv"
{
    cat "$folder/head_effects.md"
    written_by "one core"
    echo
    quoted "$scratch/effects/command"
    echo
    cat "$scratch/effects/text"
} > "$scratch/effects.md"
mv "$scratch/effects.md" "$folder/effects.md"
