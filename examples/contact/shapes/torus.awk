# Writes a ring of tetrahedra with a square section, in metres, round the z axis, for 31_hooked_rings.json and
# 32_chain.json, in the format of Medit.
#   awk -f examples/contact/shapes/torus.awk > examples/contact/shapes/torus.mesh
# The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }
# The corner of cell k that lies a along the ring, r outwards and z up.
function corner(k, a, r, z) { return 1 + 4 * ((k + a) % cells) + 2 * r + z }
function tet(a, b, c, d) { print a, b, c, d, 0 }

BEGIN {
    cells = 24; radius = 0.05; half = 0.01
    turn = 2 * atan2(0, -1) / cells
    print "MeshVersionFormatted 1\nDimension 3\n\n# A ring, written by torus.awk.\nVertices\n" 4 * cells
    for (k = 0; k < cells; ++k)
        for (r = -1; r < 2; r += 2)
            for (z = -1; z < 2; z += 2)
                print short((radius + r * half) * cos(k * turn)), short((radius + r * half) * sin(k * turn)), short(z * half), 0
    # Five a cell, mirrored from cell to cell, so that faces fit.
    print "\nTetrahedra\n" 5 * cells
    for (k = 0; k < cells; ++k) {
        m = k % 2
        tet(corner(k, m, 0, 0), corner(k, 1 - m, 1, 0), corner(k, 1 - m, 0, 1), corner(k, m, 1, 1))
        tet(corner(k, 1 - m, 0, 0), corner(k, m, 0, 0), corner(k, 1 - m, 1, 0), corner(k, 1 - m, 0, 1))
        tet(corner(k, m, 1, 0), corner(k, m, 0, 0), corner(k, 1 - m, 1, 0), corner(k, m, 1, 1))
        tet(corner(k, m, 0, 1), corner(k, m, 0, 0), corner(k, 1 - m, 0, 1), corner(k, m, 1, 1))
        tet(corner(k, 1 - m, 1, 1), corner(k, 1 - m, 1, 0), corner(k, 1 - m, 0, 1), corner(k, m, 1, 1))
    }
    print "\nEnd"
}
