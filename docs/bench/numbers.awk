# Holds the numbers of a table of a page against the CSV that they were formed from, where the two are laid out differently: for
# check_numbers of put.sh,
#   awk -v keys="1 5" [-v skip=" 3 4 "] -f bench/numbers.awk -f claims.awk PAGE_ROWS BENCH.csv
# The first cells of a row of the page choose rows of the CSV: those that have them as the fields of `keys`, here the first and the
# fifth. What another cell begins with, if it is a number, must be a field of these rows, whichever, to the digits of the page (shows()
# of claims.awk). What stands in brackets or in a column of `skip` is formed from several rows and not held, nor are texts, of
# which a target ("≤ 0.7, missed") is one. Without keys any number of the file will do. Tables that have the columns of their file
# are for check_bench.
function plain(text)
{
    gsub(/\([^)]*\)|[`*]|[²%°]/, "", text)
    gsub(/^ +| +$/, "", text)
    return text
}
function chosen(row, of_page,    i)
{
    for (i = 1; i <= chosen_by; ++i)
        if (field[row, key[i]] != plain(of_page[i])) return 0
    return 1
}
BEGIN { chosen_by = split(keys, key, " ") }
FILENAME != ARGV[ARGC - 1] { sub(/^\| /, ""); sub(/ \|$/, ""); line[++shown_rows] = $0; next }
{
    sub(/^# model,/, "model,")
    if (/^#/) next
    n = cells($0)
    kept_rows++
    for (i = 1; i <= n; ++i) field[kept_rows, i] = plain(cell[i])
    width[kept_rows] = n
    next
}
END {
    for (r = 1; r <= shown_rows; ++r) {
        got = split(line[r], of_page, / *\| */)
        for (c = chosen_by + 1; c <= got; ++c) {
            if (index(skip, " " c " ") || !match(plain(of_page[c]), /^[-+]?[0-9.]+(e[-+]?[0-9]+)?/)) continue
            given = substr(plain(of_page[c]), RSTART, RLENGTH)
            found = 0
            for (k = 1; k <= kept_rows && !found; ++k)
                for (i = 1; i <= width[k] && !found && chosen(k, of_page); ++i)
                    found = field[k, i] ~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/ && shows(field[k, i], given)
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
