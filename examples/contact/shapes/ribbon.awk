# Writes the ribbon of 24_capstan.json, in metres: it hangs over the upper half of the cylinder of cylinder.awk, both
# ends as long; -v gap=G leaves so much between them [m].
#   awk -f examples/contact/shapes/ribbon.awk > examples/contact/shapes/ribbon.obj
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

BEGIN {
    over = 24; down = 8; hang = 0.1; radius = 0.1 + (gap == "" ? 0.0041 : gap); width = 0.03
    pi = atan2(0, -1)
    rows = over + 2 * down
    print "# A ribbon, written by ribbon.awk."
    for (k = 0; k <= rows; ++k)
        for (j = 0; j < 2; ++j) {
            z = width * (j - 0.5)
            if (k < down) print "v " short(-radius) " " short(-hang * (1 - k / down)) " " short(z)
            else if (k > rows - down) print "v " short(radius) " " short(-hang * (1 - (rows - k) / down)) " " short(z)
            else {
                a = pi * (1 - (k - down) / over)
                print "v " short(radius * cos(a)) " " short(radius * sin(a)) " " short(z)
            }
        }
    for (k = 0; k < rows; ++k) {
        p = 2 * k + 1
        print "f " p " " p + 1 " " p + 3
        print "f " p " " p + 3 " " p + 2
    }
}
