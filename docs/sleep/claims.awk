# What docs/sleep.md concludes, held against its table (docs/claims.awk).
function piles(column) { return v("sleep", "49 piles of two as well, all asleep", column) }
function asleep(column) { return v("sleep", "1,000 bodies, 999 asleep", column) }
function claims()
{
    claim("999 bodies that sleep cost 2 % of a step of the one that moves, and no dispatch; its bits are the same.",
          about(100 * (asleep("ratio") - 1), "2") \
          && asleep("dispatches") == v("sleep", "one body alone", "dispatches") && asleep("error_m") == 0)
    claim("98 that lie on each other in twos, which cost 5 %.",
          about(100 * (piles("ratio") - 1), "5") \
          && piles("dispatches") == v("sleep", "one body over a mesh", "dispatches") && piles("error_m") == 0)
}
