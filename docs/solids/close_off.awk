# Closes holes of three edges in an OFF file of triangles: awk -f close_off.awk SURFACE.off > CLOSED.off
# A larger hole is an error: what is missing there is not for a script to guess.
/^#/ || NF == 0 { next }
!header { if ($1 != "OFF") { fail("this is no OFF file") } header = 1; next }
vertices == "" { vertices = $1; faces = $2; next }
points < vertices { place[points++] = $0; next }
face < faces {
    if ($1 != 3) fail("face " face " has " $1 " corners; only triangles are taken")
    row[face++] = "3 " $2 " " $3 " " $4
    edge[$2, $3]; edge[$3, $4]; edge[$4, $2]
}
function fail(why) { print FILENAME ": " why > "/dev/stderr"; failed = 1; exit 2 }
END {
    if (failed) exit 2
    if (points < vertices || face < faces || vertices == "") fail("the file ends early")
    for (e in edge) {
        split(e, end, SUBSEP)
        if (!((end[2], end[1]) in edge)) { next_of[end[2]] = end[1]; ++open }
    }
    for (a in next_of) {
        b = next_of[a]; c = next_of[b]
        if (!(b in next_of) || !(c in next_of) || next_of[c] != a) fail("a hole has more than three edges")
        if (a + 0 < b + 0 && a + 0 < c + 0) { row[face++] = "3 " a " " b " " c; open -= 3 }
    }
    if (open != 0) fail("holes touch each other")
    print "OFF"; print vertices, face, 0
    for (k = 0; k < vertices; ++k) print place[k]
    for (k = 0; k < face; ++k) print row[k]
}
