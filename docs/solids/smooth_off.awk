# Moves the vertices of faces that cut each other to the mean of their neighbours, once:
# tetgen -dV SURFACE.off | awk -f smooth_off.awk - SURFACE.off > SMOOTHED.off
# Reads what TetGen lists as "(a, b, c) and (d, e, f)", then an OFF file as close_off.awk writes it.
BEGIN { points = face = 0 }
FNR == NR {
    if ($0 ~ /^ *\(.*\) and \(/) { gsub(/[^0-9]+/, " "); for (k = 1; k <= NF; ++k) bad[$k] }
    next
}
FNR == 1 { next }
FNR == 2 { vertices = $1; faces = $2; next }
points < vertices { x[points] = $1; y[points] = $2; z[points++] = $3; next }
{ row[face++] = $0; for (k = 2; k <= 4; ++k) for (j = 2; j <= 4; ++j) if (j != k && $k in bad) near[$k, $j] }
END {
    for (pair in near) {
        split(pair, ends, SUBSEP)
        ++count[ends[1]]; sx[ends[1]] += x[ends[2]]; sy[ends[1]] += y[ends[2]]; sz[ends[1]] += z[ends[2]]
    }
    print "OFF"; print vertices, faces, 0
    for (v = 0; v < vertices; ++v)
        if (v in bad) printf "%.9g %.9g %.9g\n", sx[v] / count[v], sy[v] / count[v], sz[v] / count[v]
        else print x[v], y[v], z[v]
    for (k = 0; k < faces; ++k) print row[k]
}
