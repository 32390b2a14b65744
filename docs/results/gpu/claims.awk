# What docs/results/gpu.md says of the compiled kernels, held against tests/hardware/radv.csv:
#   awk -f docs/results/gpu/claims.awk docs/results/gpu.md tests/hardware/radv.csv
# Exit status 1 with what does not hold.
BEGIN { FS = "," }
FNR == 1 { ++file }
file == 1 { page = page " " $0; next }
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
    print "gpu.md does not say \"" text "\", which radv.csv does" > "/dev/stderr"
    bad = 1
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
    exit bad
}
