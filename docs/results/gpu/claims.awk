# What docs/results/gpu.md concludes: of the compiled kernels by tests/hardware/radv.csv, of the model by the page's own tables
# (which test_hardware holds against the plans). Before claims.awk, whose rules end with the page's lines:
#   awk -f docs/results/gpu/claims.awk -f docs/claims.awk docs/results/gpu.md tests/hardware/radv.csv
FILENAME == ARGV[1] && /^<!-- [a-z]+ -->$/ { part = substr($0, 6, length($0) - 9) }
FILENAME == ARGV[1] && /^[|]/ { # by its first cell, or by its first two or three
    parts = split($0, of_page, / *[|] */)
    for (i = 2; i < parts; ++i)
        at[part, of_page[2], i - 1] = at[part, of_page[2] " " of_page[3], i - 1] = \
            at[part, of_page[2] " " of_page[3] " " of_page[4], i - 1] = of_page[i]
}

# Of the table `part`: the cell of a row, by number.
function of(part, row, column)
{
    if (!((part, row, column) in at)) fail("no row \"" row "\" in the table " part)
    return at[part, row, column]
}
function cloth(row, column) { return of("cloth", row, column) }
function per_cent(part, whole) { return sprintf("%.0f %%", 100 * part / whole) }

# Whether all three GPUs have this largest roof with so many cells or unknowns.
function largest(part, row, column, roof)
{
    return of(part, row " RX 580", column) == roof && of(part, row " RX Vega 64", column) == roof \
        && of(part, row " RX 6900 XT", column) == roof
}

function claims_of_cloth(    here, newest, passes, of_64, shipped)
{
    newest = "RX 6900 XT"
    here = "64² " newest
    passes = cloth(here, 8)
    name("At 64² cells with 20 substeps and without self-contact")
    claim(cloth(here, 3) " dispatches are too many: on the RX 6900 XT they take " passes " ms, " \
          sprintf("%.1f", passes / cloth(here, 5)) " times what the bytes take", 1)
    claim("a chain of single waves takes " cloth(here, 7) " ms more", 1)
    claim("On the two older GPUs the chain of waves is the largest roof.",
          cloth("64² RX 580", 9) == "waves" && cloth("64² RX Vega 64", 9) == "waves")
    claim("instructions take " per_cent(cloth(here, 6), passes) " of the dispatches' time on the RX 6900 XT and " \
          per_cent(cloth("64² RX 580", 6), cloth("64² RX 580", 8)) " on the RX 580.", 1)
    claim("Of a step of 16.7 ms that is " per_cent(passes, 16.7) "; with a driver that takes 3 µs a dispatch " \
          per_cent(of("dispatches", "64²", 4), 16.7) ".", 1)
    name("As the scene is shipped, with 80 substeps and self-contact")
    shipped = 4321 # docs/rerun.sh holds it against the program
    claim("4,321 dispatches are " per_cent(shipped * passes / cloth(here, 3), 16.7) " of it, and " \
          per_cent(shipped * 0.003, 16.7) " at 3 µs", 1)
    claim("From 128² on, bytes are the largest roof on all three GPUs",
          largest("cloth", "128²", 9, "bytes") && largest("cloth", "256²", 9, "bytes") \
          && largest("cloth", "512²", 9, "bytes") && largest("cloth", "1024²", 9, "bytes"))
    claim("dispatches are " per_cent(passes, cloth("256² " newest, 5)) " of them at 256² and " \
          per_cent(passes, cloth("1024² " newest, 5)) " at 1024² on the RX 6900 XT.", 1)
}
function claims_of_dispatches(    substeps, bending, waves)
{
    substeps = of("dispatches", "colours and all in one dispatch a substep", 2)
    bending = of("passes", "64² bending `xpbd_hinge`", 4)
    claim("Bending makes " bending " of the " cloth("64² RX 6900 XT", 3) " dispatches: " bending / substeps \
          " colours, " substeps " substeps.", 1)
    claim("fused passes over vertices save " cloth("64² RX 6900 XT", 3) \
          - of("dispatches", "passes over vertices fused, one a substep", 2) ".", 1)
    claim("Both together leave " of("dispatches", "both", 2) ", which is below the " of("dispatches", "64²", 6) " at", 1)
    waves = sprintf("%.0f", of("passes", "64² bending `xpbd_hinge`", 5) / 64)
    claim("At 64² a colour of bending has " waves " waves of 64 at the mean, for 160 SIMDs.",
          of("gpus", "RX 6900 XT", 3) * of("gpus", "RX 6900 XT", 4) == 160)
}
function claims_of_gradients(    ok, side, gpu, sides, gpus)
{
    split("64² 128² 256² 512² 1024²", sides, " ")
    split("RX 580,RX Vega 64,RX 6900 XT", gpus, ",")
    ok = 1
    for (side in sides)
        for (gpu in gpus)
            ok = ok && gradient(sides[side], "sell", gpus[gpu], 8) <= gradient(sides[side], "csr", gpus[gpu], 8) / 2 \
                && gradient(sides[side], "sell", gpus[gpu], 5) <= gradient(sides[side], "csr", gpus[gpu], 5)
    claim("Rows in slices (sell) have half the chain of csr or less, and never more bytes.", ok)
    ok = 1
    for (gpu in gpus) {
        ok = ok && gradient("64²", "csr", gpus[gpu], 10) != "bytes" && gradient("64²", "sell", gpus[gpu], 10) != "bytes"
        for (side = 3; side <= 5; ++side)
            ok = ok && gradient(sides[side], "csr", gpus[gpu], 10) == "bytes" \
                && gradient(sides[side], "sell", gpus[gpu], 10) == "bytes"
    }
    claim("An iteration of conjugate gradients waits for its waves or dispatches at 64² and for its bytes from 256² on.", ok)
}
function gradient(side, format, gpu, column) { return of("gradients", side " " format " " gpu, column) }

function range(least, most) { return least < most ? least " to " most : most "" }
# Of radv.csv, whose rows repeat a family: the widest kernel of a precision, by family.
function claims_of_kernels(    i, key, wide, spills, p, precision)
{
    for (i = 1; i <= kernels; ++i) {
        spills += spilled[i]
        key = of_kernel[i, "precision"] SUBSEP of_kernel[i, "family"]
        if (of_kernel[i, "vgprs"] + 0 > most[key]) { most[key] = of_kernel[i, "vgprs"] + 0; widest[key] = of_kernel[i, "kernel"] }
    }
    for (key in most) {
        split(key, p, SUBSEP)
        precision = p[1]
        if (!(precision in least) || most[key] < least[precision]) least[precision] = most[key]
        if (most[key] > top[precision]) { top[precision] = most[key]; named[precision] = widest[key] }
    }
    claim("No kernel spills.", kernels > 0 && !spills)
    claim("The widest in float is `" named["float"] "`, " range(least["float"], top["float"]) \
          " vector registers, and in double `" named["double"] "`, " range(least["double"], top["double"]) ".", 1)
}
FILENAME != ARGV[1] && !/^#/ {
    n = split($0, of_line, ",")
    if (!radv_columns) { radv_columns = n; for (i = 1; i <= n; ++i) radv_head[i] = of_line[i] }
    else {
        ++kernels
        for (i = 1; i <= n; ++i) of_kernel[kernels, radv_head[i]] = of_line[i]
        spilled[kernels] = of_kernel[kernels, "spilled_vgprs"] + of_kernel[kernels, "spilled_sgprs"]
    }
}
function claims()
{
    claims_of_cloth()
    claims_of_dispatches()
    claims_of_gradients()
    claims_of_kernels()
}
