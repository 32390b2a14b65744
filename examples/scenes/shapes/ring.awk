# Writes the ring of examples/scenes/kinematic.json, in metres, standing in the plane z = 0:
#   awk -f examples/scenes/shapes/ring.awk > examples/scenes/shapes/ring.obj
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

BEGIN {
    round = 36; across = 14; radius = 0.24; thick = 0.07
    pi = atan2(0, -1)
    print "# A ring, written by ring.awk."
    for (i = 0; i < round; ++i)
        for (j = 0; j < across; ++j) {
            a = 2 * pi * i / round
            b = 2 * pi * j / across
            r = radius + thick * cos(b)
            print "v " short(r * cos(a)) " " short(r * sin(a)) " " short(thick * sin(b))
        }
    for (i = 0; i < round; ++i)
        for (j = 0; j < across; ++j) {
            p = i * across + j + 1
            q = i * across + (j + 1) % across + 1
            s = (i + 1) % round * across + j + 1
            t = (i + 1) % round * across + (j + 1) % across + 1
            print "f " p " " s " " t
            print "f " p " " t " " q
        }
}
