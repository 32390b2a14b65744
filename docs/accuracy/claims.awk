# What the text that people wrote for the pages of this folder says in numbers, held against the tables. For check.sh:
#
#   cat head*.md words_*.md > WORDS.md
#   awk -v whole=1 -f claims.awk -f ../claims.awk WORDS.md *_cost.csv
#
# Conclusions with numbers beyond these stand in what facts.sh writes from the tables.

BEGIN { digits = "[0-9]|twenty|ten times|tenth|hundred|thousand|percent|half|twice" }

# Every point by problem and method: ../claims.awk keeps one line a name.
files >= 1 && FNR == 1 && FILENAME ~ /\.csv$/ { split("", at); width = cells($0); for (i = 1; i <= width; ++i) at[cell[i]] = i }
files >= 1 && FNR > 1 && FILENAME ~ /\.csv$/ {
    cells($0)
    problem = cell[at["scene"]]; method = cell[at["method"]]
    wide = wide > ++settings[problem, method] ? wide : settings[problem, method]
    n = cell[at["substeps"]] + 0; most_substeps = n > most_substeps ? n : most_substeps
    n = cell[at["iterations"]] + 0; most_iterations = n > most_iterations ? n : most_iterations
    if (cell[at["precision"]] != "float") other_precision = 1
    error = cell[at["error"]]
    if (error == "") next
    if (error + 0 > highest[problem, method]) highest[problem, method] = error + 0
    if (!((problem, method) in least) || error + 0 < least[problem, method]) least[problem, method] = error + 0
    if (cell[at["details"]] == "" && cell[at["iterations"]] == 1) curve[problem, method, cell[at["substeps"]]] = error + 0
    if (cell[at["details"]] == "linear_tolerance 0.01") early[problem, method, cell[at["substeps"]]] = error + 0
}

# The one method that has an error; empty where none or several have.
function least_method(problem,    key, parts, found)
{
    for (key in least) {
        split(key, parts, SUBSEP)
        if (parts[1] == problem) found = found (found == "" ? "" : " ") parts[2]
    }
    return found
}

# Whether an error falls with the square of the substeps, where it is small.
function is_second_order(problem, method,    n, ratio)
{
    for (n = 16; n <= 64; n *= 2) {
        if (!((problem, method, n) in curve) || !((problem, method, 2 * n) in curve)) return 0
        ratio = curve[problem, method, n] / curve[problem, method, 2 * n]
        if (ratio < 3.5 || ratio > 4.6) return 0
    }
    return 1
}

function claims()
{
    claim("at most twenty settings in float (substeps 1 to 128, iterations 1 to 64)", \
          wide <= 20 && most_substeps == 128 && most_iterations == 64 && !other_precision)
    claim("at most twenty settings in float", wide <= 20 && !other_precision) # solids, too
    name("a stiffness in [0, 1] without a unit")
    claim("XPBD's error at rest falls with the square of the substeps", is_second_order("beam", "xpbd"))
    claim("A linear solve that stops early (`linear_tolerance`) spoils the motion of the cube when the substeps are many", \
          early["cube", "implicit_euler", 64] > 10 * curve["cube", "implicit_euler", 64])
    claim("more substeps take it further from the reference, and no setting gets within 1 %", \
          least["ball", "pbd"] > 0.01 && curve["ball", "pbd", 128] > curve["ball", "pbd", 16] && \
          curve["ball", "pbd", 16] > curve["ball", "pbd", 1])
    claim("is mass_spring's alone, and its error is below 1 % from the fewest stable substeps on", \
          least_method("ball_surface") == "mass_spring" && highest["ball_surface", "mass_spring"] < 0.01)
    name("The reference R3")
}
