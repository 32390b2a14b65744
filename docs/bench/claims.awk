# What README.md shows of the benches, held against their tables (docs/claims.awk, -v whole=1): the rows that it shows are those
# of the medians; other digits of the page are not held against anything.
function row_of(what,    columns, n, i, line)
{
    line = "| " what " |"
    n = split("ms median,ms least,ms largest,error m,ratio median,ratio least,ratio largest,to,target", columns, ",")
    for (i = 1; i <= n; ++i) line = line " " text_of("medians", what, columns[i]) " |"
    return line
}
function cloth(side) { return v("medians", "native parallel, hanging cloth " side " x " side, "ratio median") }
# Targets of conjugate gradients: five ratios at most so much, and the speed of the product at least 0.8 of a copy's.
table == "linear_peers" && cell[1] ~ /^ratio/ && n > 9 && cell[10] != "" {
    ++asked
    if (cell[8] + 0 > cell[10] + 0) by[++missed] = cell[8] / cell[10] - 1
}
table == "linear_peers" && cell[1] == "product" { speed[cell[2]] = cell[8] + 0 }
# Least and largest time of software drivers over that of native code.
table == "size" && cell[3] ~ /^(vulkan|opengl)$/ {
    if (!slowest || cell[6] + 0 < quickest) quickest = cell[6] + 0
    if (cell[6] + 0 > slowest) slowest = cell[6] + 0
}

function claims(    i, what, found)
{
    digits = "\001" # none
    for (i = 1; i <= rows["medians"]; ++i) {
        what = row_name["medians", i]
        if (index(shown, "| " what " |")) { claim(row_of(what), 1); ++found }
    }
    if (!found) fail("no row of the table is there")
    claim("1.0 of a plain OpenMP program's time (0.6; 0.595 and 0.59 at 128² and 256²)",
          about(cloth(64), "1.0") && about(cloth(128), "0.595") && about(cloth(256), "0.59"))
    claim("a sweep on two cores, 0.675 of one core (0.6); recording 1,000 dispatches for Vulkan, 1.4 ms (1)",
          about(v("medians", "native parallel", "ratio median"), "0.675") \
          && about(v("medians", "record 1,000 dispatches, vulkan", "ms median"), "1.4"))
    for (i = 1; i <= rows["solid"]; ++i)
        if (row_name["solid", i] ~ /^native parallel/)
            claim("box of tetrahedra, 0.68 (0.6)", about(v("solid", row_name["solid", i], "ratio"), "0.68"))
    claim("linear systems miss two of six targets, by 10 and 26 %", asked == 5 && missed + (speed["taut csr double"] < 0.8 * speed["memcpy, 2 threads"]) == 2 \
          && about(100 * by[1], "10") && about(100 * by[2], "26"))
    claim("take 3 to 82 times as long as native code", about(quickest, "3") && about(slowest, "82"))
    claim("adaptive activation with nothing active, 1.15 of mass-spring (1.1)",
          about(v("acad", "acad, nothing active", "ratio"), "1.15"))
}
