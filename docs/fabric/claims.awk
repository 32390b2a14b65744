# What docs/fabric.md concludes, held against its tables (docs/claims.awk).
function angle(row, k) { return v("overhang", row, strip[k]) }

# Least and largest angle of a row, into `low` and `high` of all rows of `which`; `apart`: largest difference within one.
function take_row(which, row,    k, near, far)
{
    near = 360
    far = 0
    for (k = 1; k <= 3; ++k) {
        if (angle(row, k) < near) near = angle(row, k)
        if (angle(row, k) > far) far = angle(row, k)
    }
    if (far - near > apart) apart = far - near
    if (!(which in low) || near < low[which]) low[which] = near
    if (far > high[which]) high[which] = far
}
function off(which) { return 100 * (high[which] - 41.5 > 41.5 - low[which] ? high[which] / 41.5 - 1 : 1 - low[which] / 41.5) }

function claims(    models, meshes, m, d, c)
{
    split("warp,weft,bias", strip, ",")
    split("hinge,plate", models, ",")
    split("alternating,uniform", meshes, ",")
    for (m = 1; m <= 2; ++m)
        for (d = 1; d <= 2; ++d)
            for (c = 2; c <= 4; c += 2) {
                take_row(models[m], models[m] " " meshes[d] " " c)
                take_row(models[m] c, models[m] " " meshes[d] " " c)
            }
    claim("strips of unlike length hang within 4.0° of each other on every mesh", apart < 4.05)
    claim("Hinges hang too far, by 11 to 27 % of the angle that was read", about(100 * (low["hinge"] / 41.5 - 1), "11") && about(100 * (high["hinge"] / 41.5 - 1), "27"))
    claim("plates come back to it within 2.7 %", about(off("plate"), "2.7"))
    claim("and within 1.5 % on the finer meshes", off("plate4") <= 1.5)
    name("1000 substeps")
    name("with 4 of")
}
