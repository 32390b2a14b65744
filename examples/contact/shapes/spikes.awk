# Writes the bed of spikes of 18_spikes.json, in metres: a row by row of slender four-sided spikes with their tips at y = 0.
#   awk -f examples/contact/shapes/spikes.awk > examples/contact/shapes/spikes.obj
#   awk -v across=1 -v half=0.06 -f examples/contact/shapes/spikes.awk > examples/contact/shapes/spike.obj
# -v across=N: spikes along a side; -v half=B: half the side of a foot [m]. The same bytes every time.
BEGIN {
    if (across == "") across = 6
    if (half == "") half = 0.012
    height = 0.15; apart = 0.07
    print "# Spikes, written by spikes.awk."
    for (i = 0; i < across; ++i)
        for (j = 0; j < across; ++j) {
            x = (i - (across - 1) / 2) * apart; z = (j - (across - 1) / 2) * apart
            print "v", x, 0, z
            print "v", x - half, -height, z - half
            print "v", x - half, -height, z + half
            print "v", x + half, -height, z + half
            print "v", x + half, -height, z - half
        }
    for (k = 0; k < across * across; ++k)
        for (s = 0; s < 4; ++s) print "f", 5 * k + 1, 5 * k + 2 + s, 5 * k + 2 + (s + 1) % 4
}
