# Tables and sentences of README.md, from the CSV files beside it: awk -f facts.awk *_cost.csv precision.csv ...
# A point counts as reaching a tolerance when its error plus the reference's own is within it, as in `taut cost`.

function cells(line, out,    n, i, c, text, quoted) {
    n = 1; text = ""; quoted = 0
    for (i = 1; i <= length(line); ++i) {
        c = substr(line, i, 1)
        if (c == "\"") quoted = !quoted
        else if (c == "," && !quoted) { out[n++] = text; text = "" }
        else text = text c
    }
    out[n] = text
    return n
}
function short(value) { return sprintf("%.3g", value) + 0 }
function setting(at) {
    return substeps[at] (substeps[at] == 1 ? " substep" : " substeps") \
           (method[at] == "mass_spring" ? "" : " x " iterations[at]) (details[at] == "" ? "" : ", " details[at])
}
# Whether a point moves another material than the scene's, as the study says. A number: the text "0" is true.
function foreign(p) { return other[p] + 0 }
# The cheapest point of a problem (and method, unless empty) for a tolerance; 0 = none. `own`: with the scene's material.
function cheapest(problem, name, tolerance, own_only,    p, best) {
    best = 0
    for (p = first[problem]; p <= last[problem]; ++p)
        if ((name == "" || method[p] == name) && error[p] != "" && error[p] + own[p] <= tolerance && !(own_only && foreign(p)))
            if (!best || cost[p] < cost[best]) best = p
    return best
}
# The cheapest of the other methods that have the scene's material.
function runner_up(problem, p, tolerance,    m, q, best) {
    best = 0
    for (m = 1; m <= method_count; ++m) {
        if (methods[m] == method[p]) continue
        q = cheapest(problem, methods[m], tolerance, 1)
        if (q && (!best || cost[q] < cost[best])) best = q
    }
    return best
}
function refused_all(problem, name,    p, any) {
    any = 0
    for (p = first[problem]; p <= last[problem]; ++p)
        if (method[p] == name) { if (refused[p] == "") return 0; any = 1 }
    return any
}
function row(problem, name, tolerance,    p) {
    p = cheapest(problem, name, tolerance, 0)
    if (p) return short(cost[p]) " (" short(sweeps[p]) ")"
    return refused_all(problem, name) ? "R" : "-"
}
FNR == 1 {
    split("", column)
    n = cells($0, head)
    for (i = 1; i <= n; ++i) column[head[i]] = i
    problem = FILENAME
    sub(/.*\//, "", problem); sub(/(_cost|_solids)?\.csv$/, "", problem)
    problems[++problem_count] = problem
    first[problem] = points + 1
    next
}
{
    cells($0, cell)
    ++points
    last[problem] = points
    method[points] = cell[column["method"]]
    substeps[points] = cell[column["substeps"]]; iterations[points] = cell[column["iterations"]]
    precision[points] = cell[column["precision"]]
    error[points] = cell[column["error"]]; metric[problem] = cell[column["error_metric"]]
    class[problem] = cell[column["reference"]]
    own[points] = cell[column["reference_error"]] + 0
    cost[points] = cell[column["cpu_ms_per_simulated_second"]] + 0
    sweeps[points] = cell[column["sweeps"]]
    reason[points] = cell[column["reason"]]
    other[points] = cell[column["other_material"]]
    floor[points] = column["floor"] ? cell[column["floor"]] : ""
    details[points] = cell[column["details"]]; refused[points] = cell[column["refused"]]
    if (column["ratio"]) ratio[points] = cell[column["ratio"]]
    if (!(method[points] in known)) { known[method[points]] = 1; methods[++method_count] = method[points] }
}
function table(tolerance,    i, m, line) {
    printf "\nWithin %g %%: CPU ms per simulated second (sweeps per simulated second).\n\n", 100 * tolerance
    line = "| method |"
    for (i = 1; i <= problem_count; ++i) if (is_problem(problems[i])) line = line " " problems[i] " |"
    print line
    gsub(/[^|]+/, "---", line); print line
    for (m = 1; m <= method_count; ++m) {
        line = "| " methods[m] " |"
        for (i = 1; i <= problem_count; ++i)
            if (is_problem(problems[i])) line = line " " row(problems[i], methods[m], tolerance) " |"
        print line
    }
}
function is_problem(name) { return name !~ /^(precision|ratio_mass|ratio_stiffness)$/ }
# Which floors a point's error lies below: a share of a bound then says no more than that the bound holds.
function mark(p) {
    return (floor[p] ~ /rest/ ? "†" : "") (floor[p] ~ /linear_tolerance/ ? "‡" : "") \
           (floor[p] ~ /reference/ ? "§" : "") (floor[p] ~ /float|double/ ? "¶" : "")
}
function share(p, tolerance) { return short(error[p] / tolerance) mark(p) " of the bound" }
# The cheapest point of all methods, its error over the bound, and what the best other method costs. Where the cheapest is
# of another material it says so, and the cheapest with the scene's own follows.
function say_point(problem, p, tolerance,    q) {
    q = runner_up(problem, p, tolerance)
    return method[p] ", " setting(p) ", " short(cost[p]) " ms (" share(p, tolerance) "; " \
           (q ? method[q] " " short(cost[q] / cost[p]) " x" : "no other") ")"
}
function say_cheapest(problem, tolerance,    p, q) {
    p = cheapest(problem, "", tolerance, 0)
    if (!p) return "none"
    if (!foreign(p)) return say_point(problem, p, tolerance)
    q = cheapest(problem, "", tolerance, 1)
    return "of another material: " method[p] ", " setting(p) ", " short(cost[p]) " ms (" share(p, tolerance) \
           "); of the scene's own: " (q ? say_point(problem, q, tolerance) : "none")
}
# Where the explicit limit lies, and what it is worth to be below it.
function say_explicit(problem,    p, least, most, one, q, why) {
    least = 0; most = 0; why = ""
    for (p = first[problem]; p <= last[problem]; ++p) {
        if (method[p] != "mass_spring" || details[p] != "") continue
        if (error[p] != "" && (!least || substeps[p] + 0 < least)) least = substeps[p] + 0
        if (refused[p] == "unstable_timestep" && substeps[p] + 0 > most) most = substeps[p] + 0
        if (refused[p] != "" && why == "") why = refused[p]
    }
    if (!least) return "mass_spring has no point" (why == "" ? "" : " (" why ")")
    one = cheapest(problem, "mass_spring", 0.01, 1)
    if (one) q = runner_up(problem, one, 0.01)
    p = "the limit is met from " least " substep" (least == 1 ? "" : "s") " on" (most ? " (" most " are refused)" : "")
    if (one && q) return p "; for 1 % mass_spring costs " short(cost[one]) " ms, the best other method, " \
        method[q] ", " short(cost[q]) " ms: " short(cost[q] / cost[one]) " times as much"
    if (one) return p "; for 1 % mass_spring costs " short(cost[one]) " ms, no other method gets there"
    return p "; within 1 % it is not"
}
function below(p) { return floor[p] == "" ? "" : " (below: " floor[p] ")" }
# What the modes of precision differ by, for each method at its most substeps.
function say_precision(name,    p, q, best) {
    best = 0
    for (p = first["precision"]; p <= last["precision"]; ++p)
        for (q = first["precision"]; q <= last["precision"]; ++q)
            if (method[p] == name && method[q] == name && precision[p] == "float" && precision[q] == "double" &&
                substeps[p] == substeps[q] && error[p] != "" && error[q] != "" &&
                (!best || substeps[p] + 0 > substeps[best] + 0)) { best = p; twin = q }
    if (!best) return "no setting that both have"
    return "at " substeps[best] " substeps " short(100 * error[best]) " % in float" below(best) ", " \
           short(100 * error[twin]) " % in double" below(twin) ", which costs " short(cost[twin] / cost[best]) \
           " times as much"
}
# Up to which ratio a method's error stays within 10 %. What has no result is named and passed over.
function say_ratio(problem, name,    p, held, above, gap, gaps, text) {
    held = ""; above = 0; gap = 0; gaps = ""
    for (p = first[problem]; p <= last[problem]; ++p) {
        if (method[p] != name || details[p] != "") continue
        if (error[p] == "") { if (!gap) gap = p; gaps = gaps (gaps == "" ? "" : ", ") ratio[p] }
        else if (!above && error[p] + 0 <= 0.1) held = ratio[p]
        else if (!above) above = p
    }
    text = held != "" ? "within 10 % up to " held : above ? "above 10 % from the start" : "no result"
    if (above) text = text "; at " ratio[above] " " short(100 * error[above]) " %"
    if (gap) text = text "; nothing at " gaps (refused[gap] != "" ? " (refused: " refused[gap] ")" : ": " reason[gap])
    return text
}
# What a linear solve that stops early does to a motion: the same setting with and without, at the most substeps.
function say_early(    i, p, q, best, with, problem, shown) {
    for (i = 1; i <= problem_count; ++i) {
        problem = problems[i]
        best = 0
        if (!is_problem(problem) || metric[problem] != "e_traj") continue
        for (p = first[problem]; p <= last[problem]; ++p)
            for (q = first[problem]; q <= last[problem]; ++q)
                if (details[p] == "" && details[q] ~ /^linear_tolerance [0-9.e-]+$/ && method[p] == method[q] &&
                    substeps[p] == substeps[q] && iterations[p] == iterations[q] && error[p] != "" && error[q] != "" &&
                    (!best || substeps[p] + 0 > substeps[best] + 0)) { best = p; with = q }
        if (!best) continue
        if (!shown++) print "\n### What a linear solve that stops early does to a motion\n"
        print "- " problem ", " method[best] ", " setting(best) ": " short(100 * error[best]) " %; with " details[with] " " \
              short(100 * error[with]) " %."
    }
}
END {
    print "### Which method is cheapest: scene by bound\n"
    print "The method, its setting, CPU ms per simulated second; in brackets its error over the bound, and how many times"
    print "dearer the best other method with the scene's material is. pbd has a stiffness of its own: a small error of it says"
    print "that the two materials look alike in that scene.\n"
    print "| problem | metric, reference | 10 % | 1 % | 0.1 % |\n|---|---|---|---|---|"
    for (i = 1; i <= problem_count; ++i) {
        p = problems[i]
        if (is_problem(p))
            print "| " p " | " metric[p] ", " class[p] " | " say_cheapest(p, 0.1) " | " say_cheapest(p, 0.01) \
                  " | " say_cheapest(p, 0.001) " |"
    }
    print "\nMarked shares are of errors below a floor of the study, where they say no more than that the bound holds: † the"
    print "rest test, ‡ the tolerance of the linear solves, § ten times the reference's own error, ¶ one rounding."
    table(0.1); table(0.01); table(0.001)
    print "\n### Where the explicit limit is met\n"
    for (i = 1; i <= problem_count; ++i)
        if (is_problem(problems[i])) print "- " problems[i] ": " say_explicit(problems[i]) "."
    if ("precision" in first) {
        print "\n### What each precision buys\n"
        for (m = 1; m <= method_count; ++m) print "- " methods[m] ": " say_precision(methods[m]) "."
    }
    say_early()
    split("ratio_mass ratio_stiffness", sweeps_of, " ")
    for (i = 1; i <= 2; ++i) {
        p = sweeps_of[i]
        if (!(p in first)) continue
        print "\n### Which method fails which ratio of " substr(p, 7) "\n"
        for (m = 1; m <= method_count; ++m) print "- " methods[m] ": " say_ratio(p, methods[m]) "."
    }
}
