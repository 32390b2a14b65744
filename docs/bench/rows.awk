# Holds a table of a page against the CSV of a bench: for check_bench of put.sh,
#   awk [-v some=1] -f bench/rows.awk -f claims.awk PAGE_ROWS BENCH.csv
# PAGE_ROWS are the lines of the table without its head; all rows of the file in its order or, with `some`, those whose first cell
# the page has. A cell is the same text, or the same number to the digits of the page (shows() of claims.awk); "20²" is 20,
# "64 x 64" is 4096, nothing is 0, and a column of the page in per cent (`percent`, its number) is a share.
function same(shown, kept, column,    side)
{
    if (shown == kept || (shown == "" && kept == "0")) return 1
    if (shown ~ /^[0-9]+²$/) return shown + 0 == kept + 0
    if (shown ~ /^[0-9]+ x [0-9]+$/ && split(shown, side, " x ") == 2) return side[1] * side[2] == kept + 0
    if (kept !~ /^-?[0-9.]+(e[-+][0-9]+)?$/ || shown !~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/) return 0
    return column == percent ? about(100 * kept, shown) : shows(kept, shown)
}
FILENAME != ARGV[ARGC - 1] { sub(/^\| /, ""); sub(/ \|$/, ""); line[++shown_rows] = $0; next }
/^#/ { next }
!past_head { past_head = 1; next }
{
    n = cells($0)
    if (some) {
        for (row = 1; row <= shown_rows; ++row) if (index(line[row], cell[1] " | ") == 1) break
        if (row > shown_rows) next
        if (!hit[row]++) ++seen
    }
    else if (++row > shown_rows) next
    got = split(line[row], of_page, / *\| */)
    for (i = 1; i <= n; ++i)
        if (i > got || !same(of_page[i], cell[i], i)) {
            print "row " row ": \"" of_page[i] "\" is not " cell[i] > "/dev/stderr"
            differs = 1
        }
    if (got > n) { print "row " row ": more cells than the file has" > "/dev/stderr"; differs = 1 }
    next
}
END {
    if (some) row = seen
    if (row != shown_rows || !row) print "the page has " shown_rows + 0 " rows, the file " row + 0 > "/dev/stderr"
    exit differs || row != shown_rows || !row
}
function claims() {}
