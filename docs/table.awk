# A CSV file as the lines of a Markdown table, for check_tables of put.sh: awk -f table.awk -f claims.awk TABLE.csv
/^#/ { next }
{
    n = cells($0)
    line = "|"
    for (i = 1; i <= n; ++i) line = line " " cell[i] " |"
    print line
    next
}
function claims() {}
