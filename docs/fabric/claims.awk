# What docs/fabric.md concludes, held against its tables (docs/claims.awk).
function angle(i, k) { return v("overhang", mesh[i], strip[k]) }

function claims(    i, k, low, high, near, far, finer)
{
    split("alternating 2,alternating 4,alternating 8,uniform 2,uniform 4,uniform 8", mesh, ",")
    split("warp,weft,bias", strip, ",")
    low = near = 360
    high = far = 0
    finer = 1
    for (i = 1; i <= 6; ++i) {
        near = 360
        far = 0
        for (k = 1; k <= 3; ++k) {
            if (angle(i, k) < near) near = angle(i, k)
            if (angle(i, k) > far) far = angle(i, k)
            if (i % 3 != 1 && angle(i, k) >= angle(i - 1, k)) finer = 0
        }
        if (far - near > apart) apart = far - near
        if (near < low) low = near
        if (far > high) high = far
    }
    claim("strips of unlike length hang within 5° of each other on every mesh", apart < 5)
    claim("All hang too far, by 6 to 27 % of the angle that was read", about(100 * (low / 41.5 - 1), "6") && about(100 * (high / 41.5 - 1), "27"))
    claim("less on finer meshes", finer)
}
