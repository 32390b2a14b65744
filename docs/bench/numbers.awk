# Holds the numbers of a table of a page against the CSV that they were formed from, where the two are laid out differently: for
# check_numbers of put.sh,
#   awk -v keys=N [-v skip=" 3 4 "] -f bench/numbers.awk -f claims.awk PAGE_ROWS BENCH.csv
# The first N cells of a row of the page choose rows of the CSV: those that have each of them as a field. What
# other cells begin with, if it is a number, must be a field of these rows, to the digits of the page. What stands in brackets
# or in a column of `skip` is formed from several rows and not held.
function plain(text)
{
    gsub(/\([^)]*\)|[`*]|[²%°]/, "", text)
    gsub(/^ +| +$/, "", text)
    return text
}
# Whether a number of the file is what the page shows, but for the digits that either leaves out.
function same_number(kept, given) { return near(kept + 0, given) || near(given + 0, kept) }
function near(kept, given,    part, point, unit)
{
    if (kept == given) return 1
    split(given, part, "e")
    point = index(part[1], ".")
    unit = (point ? 10 ^ (point - length(part[1])) : 1) * 10 ^ (part[2] + 0)
    return kept - given <= 0.5001 * unit && given - kept <= 0.5001 * unit
}
FILENAME != ARGV[ARGC - 1] { sub(/^\| /, ""); sub(/ \|$/, ""); line[++shown_rows] = $0; next }
{
    sub(/^# model,/, "model,")
    if (/^#/) next
    n = cells($0)
    kept_rows++
    for (i = 1; i <= n; ++i) {
        field[kept_rows, i] = plain(cell[i])
        has[kept_rows, plain(cell[i])] = 1
    }
    width[kept_rows] = n
    next
}
END {
    for (r = 1; r <= shown_rows; ++r) {
        got = split(line[r], of_page, / *\| */)
        for (c = 1; c <= got; ++c) {
            if (index(skip, " " c " ") || !match(plain(of_page[c]), /^[-+]?[0-9.]+(e[-+]?[0-9]+)?/)) continue
            given = substr(plain(of_page[c]), RSTART, RLENGTH)
            found = 0
            for (k = 1; k <= kept_rows && !found; ++k) {
                fits = 1
                for (i = 1; i <= keys; ++i)
                    if (!has[k, plain(of_page[i])]) fits = 0
                for (i = 1; i <= width[k] && fits && !found; ++i)
                    found = field[k, i] ~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/ && same_number(field[k, i], given)
            }
            if (!found) {
                print "row " r ": no \"" given "\" (column " c ")" > "/dev/stderr"
                differs = 1
            }
        }
    }
    if (!shown_rows) print "the page has no rows" > "/dev/stderr"
    exit differs || !shown_rows
}
function claims() {}
