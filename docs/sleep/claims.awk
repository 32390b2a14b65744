# What docs/sleep.md concludes, held against its table (docs/claims.awk).
function asleep(column) { return v("sleep", "1,000 bodies, 999 asleep", column) }
function claims()
{
    claim("999 bodies that sleep cost 1 % of a step of the one that moves, and no dispatch; its bits are the same.",
          about(100 * (asleep("ratio") - 1), "1") \
          && asleep("dispatches") == v("sleep", "one body alone", "dispatches") && asleep("error_m") == 0)
}
