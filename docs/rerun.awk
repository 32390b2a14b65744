# Whether the rows of a CSV file that was measured now stand in the committed one, but for times:
#
#   awk -f rerun.awk -f claims.awk COMMITTED.csv NOW.csv
#
# A row stands there where one has the same words in its other columns, and numbers within a hundredth. Exit status 1
# with the rows that do not.
function is_of_time(name) { return name ~ /ms($|_| )/ || name ~ /^(pareto|repetitions|at_reference_floor)$/ }
function is_number(text) { return text ~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/ }
function size(x) { return x < 0 ? -x : x }
function same(a, b,    off)
{
    if (a == b) return 1
    if (!is_number(a) || !is_number(b)) return 0
    off = size(a - b)
    return off <= 0.01 * size(a) || (size(a) < 1e-12 && size(b) < 1e-12)
}
function stands_there(n,    row, i, all)
{
    for (row = 1; row <= committed; ++row) {
        all = 1
        for (i = 1; i <= n && all; ++i)
            all = (i in skipped) || same(old[row, i], cell[i])
        if (all) return 1
    }
    return 0
}
FNR == 1 {
    ++file
    heads[file] = $0
    if (file == 2 && heads[1] != heads[2]) { print FILENAME ": other columns" > "/dev/stderr"; failed = 1 }
    n = cells($0)
    for (i = 1; i <= n; ++i) if (is_of_time(cell[i])) skipped[i] = 1
    next
}
file == 1 { n = cells($0); ++committed; for (i = 1; i <= n; ++i) old[committed, i] = cell[i]; next }
{
    ++compared
    n = cells($0)
    if (!stands_there(n)) { print "measured now, not in the table: " $0 > "/dev/stderr"; failed = 1 }
    next
}
END { if (!compared) { print "nothing was compared" > "/dev/stderr"; failed = 1 } }
function claims() {}
