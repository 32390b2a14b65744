# Writes the skirt of examples/scenes/skirt.json, in metres, y up, round without a seam:
#   awk -f examples/scenes/shapes/skirt.awk > examples/scenes/shapes/skirt.obj
# Rings of vertices go from the waist to the hem. The number in a ring follows its length, so triangles keep
# their size while the skirt widens; a strip joins two rings of different numbers. The same bytes every time.

# To hundredths of a millimetre, without a sign of zero.
function short(x) { return sprintf("%.5f", x) + 0 }

# Sets px, py, pz: where the ring at the share t of the way from waist to hem is at the angle a.
function point(t, a,    flare, r)
{
    flare = t < band ? 0 : (t - band) / (1 - band)
    r = waist + (hem - waist) * flare * (0.6 + 0.4 * flare)
    r *= 1 + depth * flare * cos(folds * a)
    px = r * cos(a)
    py = height * (1 - t)
    pz = -r * sin(a)
}

# The length of the ring t; `sum` has the lengths from its start to each of `fine` points.
function measure(t,    k, x, z)
{
    sum[0] = 0
    point(t, 0)
    for (k = 1; k <= fine; ++k)
    {
        x = px
        z = pz
        point(t, 2 * pi * k / fine)
        sum[k] = sum[k - 1] + sqrt((px - x) ^ 2 + (pz - z) ^ 2)
    }
    return sum[fine]
}

# Writes the vertices of a ring at equal distances along it; every second ring starts half an edge later.
function ring(j,    t, whole, i, k, want)
{
    t = j / rings
    whole = measure(t)
    count[j] = int(whole / edge + 0.5)
    first[j] = vertices + 1
    shift[j] = j % 2 ? 0.5 : 0
    k = 1
    for (i = 0; i < count[j]; ++i)
    {
        want = (i + shift[j]) / count[j] * whole
        while (sum[k] < want)
            ++k
        point(t, 2 * pi * (k - 1 + (want - sum[k - 1]) / (sum[k] - sum[k - 1])) / fine)
        print "v", short(px), short(py), short(pz)
    }
    vertices += count[j]
}

# Joins ring j to the one below: the one that is behind, as a share of its turn, goes on by an edge.
# Seen from outside, triangles turn counter-clockwise.
function strip(j,    n, m, u, l)
{
    n = count[j]
    m = count[j + 1]
    u = l = 0
    while (u < n || l < m)
    {
        if (l == m || (u < n && (u + 0.5 + shift[j]) / n <= (l + 0.5 + shift[j + 1]) / m))
        {
            printf "f %d %d %d\n", first[j] + u % n, first[j + 1] + l % m, first[j] + (u + 1) % n
            ++u
        }
        else
        {
            printf "f %d %d %d\n", first[j] + u % n, first[j + 1] + l % m, first[j + 1] + (l + 1) % m
            ++l
        }
    }
}

BEGIN {
    pi = atan2(0, -1)
    waist = 0.12  # radius, m
    hem = 0.32    # mean radius, m
    height = 0.55 # m
    band = 0.08   # share of the height that is a straight waistband
    folds = 9
    depth = 0.10  # of the folds at the hem, share of the radius
    edge = 0.018  # m
    rings = 36    # strips of triangles
    fine = 4096   # parts that a ring is measured in

    print "# A skirt without a seam, in metres, written by skirt.awk. In the public domain (CC0 1.0)."
    for (j = 0; j <= rings; ++j)
        ring(j)
    for (j = 0; j < rings; ++j)
        strip(j)
}
