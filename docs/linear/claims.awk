# What docs/linear.md concludes, held against its tables (docs/claims.awk).

# linear_precision has a line for every setting. fastest: milliseconds of the fastest setting of a system and a
# precision that reached a tolerance in truth; quickest and iterations: of a preconditioner in double to 1e-8.
table == "linear_precision" && cell[16] == "" {
    key = cell[1] " " cell[5]
    if (!(key in least) || cell[11] + 0 < least[key]) least[key] = cell[11] + 0
    if (cell[11] + 0 <= cell[7] + 0) faster(fastest, key " " (cell[7] + 0), cell[9] + 0)
    if (cell[7] + 0 == 1e-8 && cell[13] == "converged" && cell[6] == "jacobi") {
        if (!(cell[1] in error_low) || cell[12] + 0 < error_low[cell[1]]) error_low[cell[1]] = cell[12] + 0
        if (cell[12] + 0 > error_high[cell[1]]) error_high[cell[1]] = cell[12] + 0
    }
    if (cell[7] + 0 == 1e-8 && cell[13] == "converged" && cell[5] == "double") {
        if (faster(quickest, cell[1] " " cell[6], cell[9] + 0)) {
            iterations[cell[1] " " cell[6]] = cell[8] + 0
            setup[cell[1] " " cell[6]] = cell[10] + 0
        }
    }
}
# linear_peers: a_ratio by rival and the rival that it is compared with, and who solved.
table == "linear_peers" && cell[1] ~ /^ratio/ {
    a_ratio[cell[2] " " cell[9]] = cell[8] + 0
    missed += n > 9 && cell[10] != "" && cell[8] + 0 > cell[10] + 0
}
table == "linear_peers" && cell[1] == "solve" { solve[++solves] = cell[2] }
function faster(list, key, ms) {
    if (key in list && list[key] <= ms) return 0
    list[key] = ms
    return 1
}
function reached(which, precision, power) { return fastest[which " " precision " " (10 ^ -power)] }
# Milliseconds a digit of the two digits up to 10^-power.
function digit(which, power) {
    return (reached(which, "double", power) - (power > 2 ? reached(which, "double", power - 2) : 0)) / 2
}

function claims()
{
    split("bcsstk16 fv3 nos3 poisson3d_30", systems, " ")
    claims_of_peers()
    claims_of_residuals()
    claims_of_precision()
    claims_of_condition()
    claims_of_crossover()
    claims_of_inventory()
}

function claims_of_peers(    i, low, high, residual)
{
    claim("An iteration of `csr` in double takes 0.55 of the time of Eigen's on two threads, 0.77 of ViennaCL's with Jacobi and 0.78 of plain C++'s;",
          about(a_ratio["taut csr double Eigen, 2 threads"], "0.55") \
          && about(a_ratio["taut csr double ViennaCL, Jacobi"], "0.77") \
          && about(a_ratio["taut csr double plain C++, 2 threads"], "0.78"))
    claim("without a matrix it takes 0.25 of Eigen's, and `mixed` 0.78 of double.",
          about(a_ratio["taut matrix-free double Eigen, 2 threads"], "0.25") \
          && about(a_ratio["taut csr mixed taut csr double"], "0.78"))
    claim("Two targets are missed: 0.7 of ViennaCL with Jacobi, and 0.2 of Eigen without a matrix.",
          missed == 2 && a_ratio["taut csr double ViennaCL, Jacobi"] > 0.7 \
          && a_ratio["taut matrix-free double Eigen, 2 threads"] > 0.2)
    low = high = v("linear_peers", "solve taut csr double", "true_residual")
    for (i = 1; i <= solves; ++i) {
        residual = v("linear_peers", "solve " solve[i], "true_residual")
        if (residual < low) low = residual
        if (residual > high) high = residual
    }
    claim("All end at the same true residual, within a factor of 1.1.", solves > 5 && high < 1.1 * low)
    claim("The product of `csr` reads at 1.35 times the speed of a copy",
          about(v("linear_peers", "product taut csr double", "value") \
                / v("linear_peers", "product memcpy, 2 threads", "value"), "1.35"))
}

function told(precision, power, column) { return v("linear_residuals", precision " 1e-" power, column) }
function claims_of_residuals(    i, precision, ok, at_first)
{
    at_first = told("float", "05", "true_residual_there") > 1e-5
    for (i = 6; i <= 10; i += 2)
        at_first = at_first && told("float", i < 10 ? "0" i : i, "true_residual_there") > 10 ^ -i
    claim("The recurrence in float claims every tolerance and has reached none of them: its x stays at 2.6·10⁻⁵.",
          at_first && about(1e5 * told("float", "08", "true_residual_there"), "2.6") \
          && about(1e5 * told("float", "10", "true_residual_there"), "2.6"))
    claim("`mixed` reaches 10⁻⁸ in truth one iteration after the recurrence claims it.",
          told("mixed", "08", "solve_iterations") == told("mixed", "08", "recurrence_at") + 1)
    claim("At 10⁻¹⁰ it takes 1033 iterations where double takes 883",
          told("mixed", "10", "solve_iterations") == 1033 && told("double", "10", "solve_iterations") == 883)
}

function claims_of_precision(    i, k, ok, first, firsts, last, low, high, cheapest, n, s, r, dearest)
{
    ok = 1
    for (i in systems) {
        dearest = 0
        first = 1
        for (k = 4; k <= 12; k += 2) {
            first = first && digit(systems[i], 2) < digit(systems[i], k)
            if (digit(systems[i], k) > dearest) dearest = digit(systems[i], k)
        }
        firsts += first
        ok = ok && digit(systems[i], 12) < dearest
        n += reached(systems[i], "float", 6) < reached(systems[i], "double", 6) \
            && reached(systems[i], "float", 6) < reached(systems[i], "mixed", 6)
    }
    claim("The first two are the cheapest on three of the four systems, and the last two cost less than the dearest on all",
          ok && firsts == 3)
    s = systems[4]
    claim("on `poisson3d_30` 0.9, 2.6, 2.7, 1.9, 1.1 and 1.9 ms a digit in double.",
          about(digit(s, 2), "0.9") && about(digit(s, 4), "2.6") && about(digit(s, 6), "2.7") \
          && about(digit(s, 8), "1.9") && about(digit(s, 10), "1.1") && about(digit(s, 12), "1.9"))
    name("float ends near 10⁻⁷")
    range_of(least, "float", 1)
    claim("Its least true residual is 6.5·10⁻⁸ to 1.4·10⁻⁷ on the four systems",
          about(1e8 * lowest, "6.5") && about(1e7 * highest, "1.4"))
    claim("Down to 10⁻⁶ it is the cheapest on all four.", n == 4)
    low = 9; high = 0; ok = 1
    for (i in systems)
        for (k = 8; k <= 12; k += 2) {
            ok = ok && reached(systems[i], "mixed", k) > 0 && reached(systems[i], "double", k) > 0
            r = reached(systems[i], "mixed", k) / reached(systems[i], "double", k)
            if (r < low) low = r
            if (r > high) high = r
        }
    claim("mixed goes on to the last tolerance asked, 10⁻¹², as double does**, for 0.90 to 1.17 of double's time from 10⁻⁸ on:",
          ok && about(low, "0.90") && about(high, "1.17"))
    name("devices without 64-bit floats")
    low = 1; high = 0
    for (i in systems) {
        if (error_low[systems[i]] < low) low = error_low[systems[i]]
        if (error_high[systems[i]] > high) high = error_high[systems[i]]
    }
    claim("At a true residual of 10⁻⁸ the forward error with Jacobi is 8·10⁻⁸ to 7·10⁻⁷.",
          about(1e8 * low, "8") && about(1e7 * high, "7"))
    claim("**multigrid pays on `fv3`, once it is set up**: 9 iterations where Jacobi takes 184, and 5.3 ms where the next takes 13.7; its set-up takes 11.1 ms",
          iterations["fv3 multigrid"] == 9 && iterations["fv3 jacobi"] == 184 \
          && about(quickest["fv3 multigrid"], "5.3") && about(next_to("fv3", "multigrid"), "13.7") \
          && about(setup["fv3 multigrid"], "11.1"))
    claim("On `poisson3d_30` its 8 iterations cost 0.70 of what 100 of Jacobi do",
          iterations[s " multigrid"] == 8 && iterations[s " jacobi"] == 100 \
          && about(quickest[s " multigrid"] / quickest[s " jacobi"], "0.70"))
    name("On `bcsstk16`, elasticity")
    claim("`spai0` and `jacobi` win.", next_to("bcsstk16", "spai0") == quickest["bcsstk16 jacobi"] \
          && quickest["bcsstk16 spai0"] < quickest["bcsstk16 jacobi"])
    claim("On `nos3` `spai0`, `chebyshev`, `block_jacobi` and `jacobi` are within 6 % of each other.",
          quickest["nos3 spai0"] <= next_to("nos3", "spai0") && quickest["nos3 jacobi"] < 1.06 * quickest["nos3 spai0"] \
          && quickest["nos3 chebyshev"] < quickest["nos3 jacobi"] && quickest["nos3 block_jacobi"] < quickest["nos3 jacobi"])
    name("3 × 3 blocks of unknowns")
    claim("`block_jacobi` is the slowest on `fv3` and on `poisson3d_30`.",
          slowest("fv3", "block_jacobi") && slowest("poisson3d_30", "block_jacobi"))
}
# lowest, highest: of list[which " " precision].
function range_of(list, precision,    i, x)
{
    lowest = 1e300; highest = 0
    for (i in systems) {
        x = list[systems[i] " " precision]
        if (x < lowest) lowest = x
        if (x > highest) highest = x
    }
}
# Milliseconds of the fastest preconditioner but one.
function next_to(which, but,    key, best)
{
    for (key in quickest)
        if (index(key, which " ") == 1 && key != which " " but && (!best || quickest[key] < best)) best = quickest[key]
    return best
}
function slowest(which, one,    key)
{
    for (key in quickest)
        if (index(key, which " ") == 1 && quickest[key] > quickest[which " " one]) return 0
    return 1
}

function of_k(power, precision, column) { return v("linear_condition", "1e" power " " precision, column) }
function claims_of_condition(    i, k, more, ok)
{
    split("1 2 4 6", powers, " ")
    claim("a hundred times the condition number costs 8.0 and 7.3 times the iterations to 10⁻⁶ in double (65, 517, 3769), where the bound says ten.",
          of_k(2, "double", "to_1e-6") == 65 && of_k(4, "double", "to_1e-6") == 517 \
          && of_k(6, "double", "to_1e-6") == 3769 && about(517 / 65, "8.0") && about(3769 / 517, "7.3") \
          && among(of_k(4, "double", "bound_1e-6") / of_k(2, "double", "bound_1e-6"), 9.8, 10.2) \
          && among(of_k(6, "double", "bound_1e-6") / of_k(4, "double", "bound_1e-6"), 9.8, 10.2))
    claim("to 10⁻³ they take 0.82, 0.49 and 0.18 of the bound at k = 10², 10⁴ and 10⁶",
          about(of_bound(2), "0.82") && about(of_bound(4), "0.49") && about(of_bound(6), "0.18"))
    claim("float reaches 10⁻⁶ up to k = 10² only",
          of_k(2, "float", "to_1e-6") > 0 && text_of("linear_condition", "1e4 float", "to_1e-6") == "never" \
          && text_of("linear_condition", "1e6 float", "to_1e-6") == "never")
    claim("its least error grows from 1.3·10⁻⁷ to 1.3·10⁻⁵, a hundredfold for a k 10⁵ times as large.",
          about(1e7 * of_k(1, "float", "least_error"), "1.3") && about(1e5 * of_k(6, "float", "least_error"), "1.3"))
    ok = 1
    for (i = 1; i <= 4; ++i) {
        k = of_k(powers[i], "mixed", "to_1e-6") / of_k(powers[i], "double", "to_1e-6")
        if (k > more) more = k
        ok = ok && of_k(powers[i], "mixed", "least_error") < of_k(powers[i], "float", "least_error") / 1000
    }
    claim("`mixed` needs up to 14 % more iterations than double and has left float's floor behind at every k.",
          ok && about(more, "1.14"))
}
function of_bound(power) { return of_k(power, "double", "to_1e-3") / of_k(power, "double", "bound_1e-3") }

function c(row, column) { return v("linear_crossover", row, column) }
# lowest, highest: of a column over the matrices whose names match; empty cells are left out.
function span(column, pattern,    i, x)
{
    lowest = 1e300; highest = 0
    for (i = 1; i <= rows["linear_crossover"]; ++i) {
        x = text_of("linear_crossover", row_name["linear_crossover", i], column)
        if (x == "" || row_name["linear_crossover", i] !~ pattern) continue
        if (x + 0 < lowest) lowest = x + 0
        if (x + 0 > highest) highest = x + 0
    }
}
function spans(column, pattern, low, high) { span(column, pattern); return about(lowest, low) && about(highest, high) }
# Whether a format is the fastest of all matrices whose names match, and of one at least.
function wins(format, pattern,    i, some)
{
    for (i = 1; i <= rows["linear_crossover"]; ++i)
        if (row_name["linear_crossover", i] ~ pattern) {
            some = 1
            if (text_of("linear_crossover", row_name["linear_crossover", i], "fastest") != format) return 0
        }
    return some
}
function fill(row) { return c(row, "mean row") / c(row, "rows") }
# A format's time over that of the fastest.
function to_best(row, format) { return to_csr_of(row, format) / to_csr_of(row, text_of("linear_crossover", row, "fastest")) }
function to_csr_of(row, format) { return format == "csr" ? 1 : c(row, format) }

function claims_of_crossover(    i, row, ok, k, jacobi, low, high, best, t)
{
    t = "linear_crossover"
    span("coo", ".")
    ok = lowest > 2
    for (i = 1; i <= rows[t]; ++i) ok = ok && text_of(t, row_name[t, i], "fastest") != "coo"
    claim("No format is the fastest everywhere, and `coo` is it nowhere: it takes more than 2 times as long as `csr`.", ok)

    claim("**dense** beats `csr` from a fill between 38 and 67 % on at 600 rows, and at 150 rows only above 67 %.",
          about(100 * fill("band of 257 in 600"), "38") && about(100 * fill("band of 513 in 600"), "67") \
          && c("band of 257 in 600", "dense") > 1 && c("band of 513 in 600", "dense") < 1 \
          && about(100 * fill("band of 129 in 150"), "67") && c("band of 129 in 150", "dense") > 1 \
          && c("band of 150 in 150", "dense") < 1)
    claim("On full matrices of 600 rows and more it is within a third of the fastest.",
          to_best("band of 600 in 600", "dense") < 1.34 && to_best("band of 2250 in 2250", "dense") < 1.34)
    span("dense", "24²|solid 8")
    claim("At 1.5 % it takes more than 80 times as long as `csr`, and on the simulator's matrices of some 2,000 rows more than 40 times as long.",
          about(100 * fill("band of 33 in 2250"), "1.5") && c("band of 33 in 2250", "dense") > 80 && lowest > 40)
    claim("**ell** is as fast as `csr` where rows are equal and short (0.9 to 1.2 up to 33 entries)",
          spans("ell", "^band of (3|9|33) ", "0.9", "1.2"))
    span("ell", "^scattered")
    claim("on scattered rows it takes 2 to more than 200 times as long.", among(lowest, 2, 4) && highest > 200)
    span("sell", "^band|cloth|solid")
    claim("**sell** is never slower than `csr` on bands and on the simulator's matrices.", highest <= 1)
    span("sell", "^scattered, (one|power)")
    claim("it takes at least 1.4 times as long, and `csr` wins.", lowest >= 1.4 && wins("csr", "^scattered, (one|power)"))
    span("bcsr3", "^band of (33|129|150|257|513|600) ")
    ok = highest < 0.9
    span("bcsr3", "^band of (129|257|513|600) in (600|2250)")
    claim("**bcsr3** takes less than 0.9 of `csr` on bands of 33 to 600 entries, and less than 0.6 on those of 129 and more in 600 and 2250 rows.",
          ok && highest < 0.6)
    span("bcsr3", "^scattered")
    claim("it takes more than 4 times as long.", lowest > 4)
    span("bcsr3", "K cloth (24|64)")
    ok = wins("bcsr3", "K cloth (24|64)") && highest < 0.85
    span("sell", "solid|J W J")
    claim("are the fastest in `bcsr3` from 24² on (below 0.85), those of solids and of constraints in `sell` (below 1).",
          ok && wins("sell", "solid|J W J") && highest < 1)
    high = 0
    for (i = 1; i <= rows[t]; ++i) {
        row = row_name[t, i]
        best = row ~ /cloth|solid/ ? to_best(row, text_of(t, row, "auto")) : 0
        if (best > high) high = best
    }
    claim("What `auto` takes there is at most 1.3 times the fastest.", about(high, "1.3"))

    claim("From 8² to 64² the k of the cloth's matrix grows 68-fold, and iterations from 84 to 624; constraints take 145 to 1048.",
          about(c("M + h²K cloth 64²", "k") / c("M + h²K cloth 8²", "k"), "68") \
          && spans("iterations", "K cloth", "84", "624") && spans("iterations", "J W J", "145", "1048"))
    claim("The solid's k stays at 65, and 46 iterations do.",
          c("M + h²K solid 12³", "k") == 65 && spans("k", "solid", "22", "65") && c("M + h²K solid 12³", "iterations") == 46)
    low = 1e300; high = k = 0
    for (i = 1; i <= rows[t]; ++i) {
        row = row_name[t, i]
        jacobi = c(row, "k") / c(row, "k, Jacobi")
        if (row ~ /h²K/ && jacobi < low) low = jacobi
        if (row ~ /h²K/ && jacobi > high) high = jacobi
        if (row ~ /J W/ && jacobi > k) k = jacobi
    }
    claim("Jacobi divides the k of implicit Euler by 2 to 15, and that of constraints by less than 1.5.",
          about(low, "2") && about(high, "15") && among(k, 1, 1.5))
}

function held(format, what) { return v("linear_inventory", format " " what, "bytes_or_count") }
function to_csr(format) { return held(format, "all buffers") / held("csr", "all buffers") }
function claims_of_inventory(    i, shared)
{
    for (i = 1; i <= rows["linear_inventory"]; ++i) shared += row_name["linear_inventory", i] == "every"
    claim("All formats share ten buffers, and an iteration is three dispatches, in `coo` four.",
          shared == 10 && held("coo", "dispatches") == 4 && held("dense", "dispatches") == 3 \
          && held("csr", "dispatches") == 3 && held("ell", "dispatches") == 3 && held("sell", "dispatches") == 3 \
          && held("bcsr3", "dispatches") == 3)
    claim("Of what `csr` keeps of the matrix, 37 % are indices.",
          about(100 * (held("csr", "row starts") + held("csr", "columns")) \
                / (held("csr", "row starts") + held("csr", "columns") + held("csr", "matrix values")), "37"))
    claim("`coo` and `ell` bind 1.18 and 1.02 times the bytes of `csr`; `bcsr3`, on a matrix without blocks, 1.74 times; `dense` 111 times.",
          about(to_csr("coo"), "1.18") && about(to_csr("ell"), "1.02") && about(to_csr("bcsr3"), "1.74") \
          && about(to_csr("dense"), "111"))
}
