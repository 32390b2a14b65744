# What README.md and bench.md show of taut_bench, held against its tables (docs/claims.awk, -v whole=1): the rows that
# a page shows stand there as the table says; other digits of the page are not held against anything.
function row_of(what,    error, to, target)
{
    error = v("epyc-2-cores", what, "error_m")
    to = text_of("epyc-2-cores", what, "to")
    target = v("epyc-2-cores", what, "target")
    return sprintf("| %s | %.3f | %.3f | %s | %.2f | %s | %s |", what, v("epyc-2-cores", what, "median_ms"),
                   v("epyc-2-cores", what, "best_ms"), error ? sprintf("%.2g", error) : "0",
                   v("epyc-2-cores", what, "ratio"), to, target ? target "" : "")
}
function cloth(side) { return v("epyc-2-cores", "native parallel, hanging cloth " side " x " side, "ratio") }

function claims(    i, what, found)
{
    digits = "\001" # none
    for (i = 1; i <= rows["epyc-2-cores"]; ++i) {
        what = row_name["epyc-2-cores", i]
        if (index(shown, "| " what " |")) { claim(row_of(what), 1); ++found }
    }
    if (!found) fail("no row of the table is there")
    if (page != "README.md") return
    claim("1.19, 0.67 and 0.69 of a plain OpenMP program's time at 64², 128² and 256² (0.6)",
          about(cloth(64), "1.19") && about(cloth(128), "0.67") && about(cloth(256), "0.69"))
    for (i = 1; i <= rows["solid"]; ++i)
        if (row_name["solid", i] ~ /^native parallel/)
            claim("box of tetrahedra, 0.68 (0.6)", about(v("solid", row_name["solid", i], "ratio"), "0.68"))
    claim("adaptive activation with nothing active, 1.15 of mass-spring (1.1)",
          about(v("acad", "acad, nothing active", "ratio"), "1.15"))
}
