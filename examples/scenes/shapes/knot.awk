# Writes the ribbon of knot.json, in metres: tied in an overhand knot, on edge all along, its ends up left and right.
#   awk -f examples/scenes/shapes/knot.awk > examples/scenes/shapes/knot.obj
# The same bytes every time. The knot is Shastri's: (t^3 - 3t, t^4 - 4t^2, t^5 - 10t).

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

function place(t) { p[0] = 0.034 * (t^3 - 3 * t); p[1] = 0.034 * (t^4 - 4 * t^2); p[2] = 0.01 * (t^5 - 10 * t) }

BEGIN {
    rows = 110; width = 0.012; fine = 6000; far = 2.12
    place(-far); x = p[0]; y = p[1]; z = p[2]; way = 0
    for (i = 1; i <= fine; ++i) {
        place(-far + 2 * far * i / fine)
        way += sqrt((p[0] - x)^2 + (p[1] - y)^2 + (p[2] - z)^2)
        along[i] = way; x = p[0]; y = p[1]; z = p[2]
    }
    at = 0
    for (k = 0; k <= rows; ++k) { # as far apart along the curve
        while (at < fine && along[at + 1] <= way * k / rows + 1e-12) ++at
        place(-far + 2 * far * at / fine)
        for (a = 0; a < 3; ++a) c[k, a] = p[a]
    }
    w[0] = 0; w[1] = 0; w[2] = 1
    print "# A knotted ribbon, written by knot.awk."
    for (k = 0; k <= rows; ++k) { # the width is carried along without turning about the curve
        l = k > 0 ? k - 1 : 0; m = k < rows ? k + 1 : rows
        size = 0; s = 0
        for (a = 0; a < 3; ++a) { d[a] = c[m, a] - c[l, a]; size += d[a]^2 }
        for (a = 0; a < 3; ++a) s += w[a] * d[a] / size
        size = 0
        for (a = 0; a < 3; ++a) { w[a] -= s * d[a]; size += w[a]^2 }
        for (a = 0; a < 3; ++a) w[a] /= sqrt(size)
        for (j = -1; j <= 1; ++j)
            print "v " short(c[k, 0] + j * width / 2 * w[0]) " " short(c[k, 1] + j * width / 2 * w[1]) " " \
                short(c[k, 2] + j * width / 2 * w[2])
    }
    for (k = 0; k < rows; ++k)
        for (j = 1; j <= 2; ++j) {
            q = 3 * k + j
            if ((k + j) % 2) print "f " q " " q + 1 " " q + 4 "\nf " q " " q + 4 " " q + 3
            else print "f " q " " q + 1 " " q + 3 "\nf " q + 1 " " q + 4 " " q + 3
        }
}
