# What docs/results/gpu.md says of the compiled kernels, held against tests/hardware/radv.csv, and of the model, against the
# page's own tables (docs/results/update_gpu.sh):
#   awk -f docs/results/gpu/claims.awk docs/results/gpu.md tests/hardware/radv.csv
# Exit status 1 with what does not hold.
BEGIN { FS = "," }
FNR == 1 { ++file }
file == 1 {
    text = $0
    sub(/^ +/, "", text)
    page = page " " text
    if (/^<!-- [a-z]+ -->$/) part = substr($0, 6, length($0) - 9)
    n = split($0, cell, / *[|] */)
    for (i = 2; i < n && /^[|]/; ++i) # by its first cell, or by the first two
        at[part, cell[2], i - 1] = at[part, cell[2] " " cell[3], i - 1] = cell[i]
    next
}
/^#/ { next }
!head { for (i = 1; i <= NF; ++i) column[$i] = i; head = 1; next }
{
    precision = $column["precision"]
    wide = $column["vgprs"] + 0
    spills += $column["spilled_vgprs"] + $column["spilled_sgprs"]
    key = precision SUBSEP $column["family"]
    if (wide > most[key]) { most[key] = wide; kernel[key] = $column["kernel"] }
    families[$column["family"]]
}
function say(text)
{
    if (index(page, text)) return
    print "gpu.md does not say \"" text "\", which its tables do" > "/dev/stderr"
    bad = 1
}
# Of the table `part`: the cell of a row, by number.
function of(part, row, column)
{
    if (!((part, row, column) in at)) { print "gpu.md has no row \"" row "\" in " part > "/dev/stderr"; bad = 1 }
    return at[part, row, column]
}
function cloth(row, column) { return of("cloth", row, column) }
function per_cent(part, whole) { return sprintf("%.0f %%", 100 * part / whole) }
function say_of_model(    here, passes)
{
    here = "64² RX 6900 XT"
    passes = cloth(here, 8)
    say(cloth(here, 3) " dispatches are too many: on the RX 6900 XT they take " passes " ms, " \
        sprintf("%.1f", passes / cloth(here, 5)) " times what the bytes take")
    say("a chain of single waves takes " cloth(here, 7) " ms more")
    say("instructions take " per_cent(cloth(here, 6), passes) " of the dispatches' time on the RX 6900 XT and " \
        per_cent(cloth("64² RX 580", 6), cloth("64² RX 580", 8)) " on the RX 580.")
    say("Of a step of 16.7 ms that is " per_cent(passes, 16.7) "; with a driver that takes 3 µs a dispatch " \
        per_cent(of("dispatches", "64²", 4), 16.7) ".")
    say("dispatches are " per_cent(passes, cloth("256² RX 6900 XT", 5)) " of them at 256² and " \
        per_cent(passes, cloth("1024² RX 6900 XT", 5)) " at 1024² on the RX 6900 XT.")
    say("Bending makes " of("effects", "64² bending", 3) " of the " cloth(here, 3) " dispatches")
    say("fused passes over vertices save " cloth(here, 3) - of("dispatches", "passes over vertices fused, one a substep", 2) ".")
    say("Both together leave " of("dispatches", "both", 2) ", which is below the " of("dispatches", "64²", 6))
}
function range(least, most) { return least < most ? least " to " most : most "" }
END {
    if (!head || spills) { print "radv.csv has spills, or no rows" > "/dev/stderr"; bad = 1 }
    for (family in families) {
        f = most["float" SUBSEP family]; d = most["double" SUBSEP family]
        if (!least_f || f < least_f) least_f = f
        if (!least_d || d < least_d) least_d = d
        if (f > top_f) { top_f = f; name_f = kernel["float" SUBSEP family] }
        if (d > top_d) { top_d = d; name_d = kernel["double" SUBSEP family] }
    }
    say("No kernel spills.")
    say("The widest in float is `" name_f "`, " range(least_f, top_f) " vector registers, and in double `" \
        name_d "`, " range(least_d, top_d) ".")
    say_of_model()
    exit bad
}
