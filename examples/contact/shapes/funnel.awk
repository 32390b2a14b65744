# Writes the funnel of the scenes of this folder, in metres, open above and below, about the y axis:
#   awk -f examples/contact/shapes/funnel.awk > examples/contact/shapes/funnel.obj
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

BEGIN {
    round = 32; rings = 7
    split("0.2 0.16 0.12 0.08 0.05 0.05 0.05", radius, " ")
    split("0 -0.04 -0.08 -0.12 -0.15 -0.18 -0.21", height, " ")
    pi = atan2(0, -1)
    print "# A funnel, written by funnel.awk."
    for (i = 0; i < round; ++i)
        for (j = 1; j <= rings; ++j) {
            a = 2 * pi * i / round
            print "v " short(radius[j] * cos(a)) " " short(height[j]) " " short(radius[j] * sin(a))
        }
    for (i = 0; i < round; ++i)
        for (j = 1; j < rings; ++j) {
            p = i * rings + j
            s = (i + 1) % round * rings + j
            print "f " p " " s " " s + 1
            print "f " p " " s + 1 " " p + 1
        }
}
