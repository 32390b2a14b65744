# Writes an open tube, in metres, along x: that of 08_twisted_tube.json, and with other sizes the loops of 51_loops.json.
#   awk -f examples/contact/shapes/tube.awk > examples/contact/shapes/tube.obj
#   awk -v radius=0.1 -v size=0.02 -v along=2 -f examples/contact/shapes/tube.awk > examples/contact/shapes/loop.obj
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

BEGIN {
    if (radius == "") radius = 0.06
    if (size == "") size = 0.4
    if (along == "") along = 24
    round = 24
    turn = 2 * atan2(0, -1) / round
    print "# A tube, written by tube.awk."
    for (i = 0; i <= along; ++i)
        for (k = 0; k < round; ++k)
            print "v", short(size * (i / along - 0.5)), short(radius * cos(k * turn)), short(radius * sin(k * turn))
    for (i = 0; i < along; ++i)
        for (k = 0; k < round; ++k) {
            p = i * round + k + 1; q = i * round + (k + 1) % round + 1
            print "f", p, q, q + round
            print "f", p, q + round, p + round
        }
}
