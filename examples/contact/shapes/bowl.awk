# Writes the bowl of 14_bowl.json, in metres: the lower half of a sphere, open above, its rim at y = 0.
#   awk -f examples/contact/shapes/bowl.awk > examples/contact/shapes/bowl.obj
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

BEGIN {
    round = 24; rings = 8; radius = 0.2
    pi = atan2(0, -1)
    print "# A bowl, written by bowl.awk."
    print "v 0", -radius, 0
    for (i = 1; i <= rings; ++i)
        for (k = 0; k < round; ++k) {
            a = pi / 2 * i / rings; b = 2 * pi * k / round
            print "v", short(radius * sin(a) * cos(b)), short(-radius * cos(a)), short(radius * sin(a) * sin(b))
        }
    for (k = 0; k < round; ++k) print "f 1", 2 + k, 2 + (k + 1) % round
    for (i = 1; i < rings; ++i)
        for (k = 0; k < round; ++k) {
            p = 2 + (i - 1) * round + k; q = 2 + (i - 1) * round + (k + 1) % round
            print "f", p, p + round, q + round
            print "f", p, q + round, q
        }
}
