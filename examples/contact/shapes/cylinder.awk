# Writes the cylinder of the scenes of this folder, in metres, along z, without ends:
#   awk -f examples/contact/shapes/cylinder.awk > examples/contact/shapes/cylinder.obj
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

BEGIN {
    round = 64; along = 4; radius = 0.1; length_ = 0.2
    pi = atan2(0, -1)
    print "# A cylinder, written by cylinder.awk."
    for (i = 0; i < round; ++i)
        for (j = 0; j <= along; ++j) {
            a = 2 * pi * i / round
            print "v " short(radius * cos(a)) " " short(radius * sin(a)) " " short(length_ * (j / along - 0.5))
        }
    for (i = 0; i < round; ++i)
        for (j = 0; j < along; ++j) {
            p = i * (along + 1) + j + 1
            s = (i + 1) % round * (along + 1) + j + 1
            print "f " p " " s " " s + 1
            print "f " p " " s + 1 " " p + 1
        }
}
