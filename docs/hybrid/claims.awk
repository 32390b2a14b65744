# What docs/hybrid.md concludes of the cut cloth, held against its table (docs/claims.awk).
function cut(side, row) { return v("split", side " cpu:serial and cpu:serial, 0.50, " row, "ratio_to_serial") }
function once(side,    work)
{
    work = side == 20 ? "1.319" : side == 32 ? "1.201" : side == 64 ? "1.101" : side == 128 ? "1.051" : "1.025"
    return cut(side, "10 exchanges, work " work)
}

function claims()
{
    claim("Two native devices of one thread step a cloth of 128² in 0.60 and one of 256² in 0.55 of the time of one: there a cut gains.",
          about(once(128), "0.60") && about(once(256), "0.55"))
    claim("At 64² it is 0.75,", about(once(64), "0.75"))
    claim("and below that waits cost more than the second core gives.", once(32) > 1 && once(20) > 1)
    claim("An executor with two threads is as fast without a cut (0.53 at 256²)",
          about(v("split", "256 cpu", "ratio_to_serial"), "0.53"))
    claim("Bits are those of one device in every row.", all_are("split", "error_m", "0"))
}
