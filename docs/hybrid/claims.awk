# What docs/hybrid.md concludes of bodies that are divided and of the cut cloth, held against its tables (docs/claims.awk).
function alone(side, column) { return v("hybrid", side " cpu", column) }

# Whether every hybrid run has all bodies on the CPU and takes LOW to HIGH of the time of `cpu`.
function divided(low, high,    i, on, side, ratio, least, most, ok)
{
    ok = 1
    least = 1e9
    for (i = 1; i <= rows["hybrid"]; ++i) {
        side = row_name["hybrid", i]
        on = second["hybrid", i]
        if (on !~ / and /) continue
        ok = ok && on ~ /, 4, 0$/
        ratio = v("hybrid", side " " on, "median_ms") / alone(side, "median_ms")
        if (ratio < least) least = ratio
        if (ratio > most) most = ratio
    }
    return ok && about(least, low) && about(most, high)
}

# Whether a cut between the native CPU and software Vulkan or OpenGL takes longer than `cpu` in every row.
function loses(    i, side, on, lost, seen)
{
    lost = 1
    for (i = 1; i <= rows["split"]; ++i) {
        side = row_name["split", i]
        on = second["split", i]
        if (on !~ /^cpu and (vulkan|opengl)/) continue
        ++seen
        lost = lost && v("split", side " " on, "median_ms") > v("split", side " cpu", "median_ms")
    }
    return lost && seen == 10
}

function cut(side, row) { return v("split", side " cpu:serial and cpu:serial, 0.50, " row, "ratio_to_serial") }
function once(side,    work)
{
    work = side == 20 ? "1.319" : side == 32 ? "1.201" : side == 64 ? "1.101" : side == 128 ? "1.051" : "1.025"
    return cut(side, "10 exchanges, work " work)
}

function claims()
{
    claim("it leaves all four cloths on the CPU at every size, and a hybrid run takes 0.90 to 1.10 of the time of `cpu` alone.",
          divided("0.90", "1.10"))
    claim("Two native devices of one thread step a cloth of 128² in 0.60 and one of 256² in 0.55 of the time of one: there a cut gains.",
          about(once(128), "0.60") && about(once(256), "0.55"))
    claim("At 64² it is 0.75,", about(once(64), "0.75"))
    claim("and below that waits cost more than the second core gives.", once(32) > 1 && once(20) > 1)
    claim("An executor with two threads is as fast without a cut (0.53 at 256²)",
          about(v("split", "256 cpu", "ratio_to_serial"), "0.53"))
    claim("Lavapipe and llvmpipe lose beside the native executor at every size", loses())
    claim("Bits are those of one device in every row.", all_are("hybrid", "error_m", "0"))
    claim("Bits are those of one device in every row.", all_are("split", "error_m", "0"))
}
