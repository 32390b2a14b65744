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

function sag(sheet, method, side) { return v("sag", sheet " " method, side) }
# The limit and the order, as docs/fabric/update.sh takes them from the last three meshes.
function order(sheet,    last)
{
    last = (sag(sheet, "implicit_euler", 32) - sag(sheet, "implicit_euler", 16)) \
           / (sag(sheet, "implicit_euler", 64) - sag(sheet, "implicit_euler", 32))
    return log(last) / log(2)
}
function limit(sheet,    last)
{
    last = 2 ^ order(sheet)
    return sag(sheet, "implicit_euler", 64) + (sag(sheet, "implicit_euler", 64) - sag(sheet, "implicit_euler", 32)) / (last - 1)
}
function from_limit(sheet, method, side) { return 100 * (sag(sheet, method, side) / limit(sheet) - 1) }
# The largest difference of a method from implicit_euler on meshes of up to MOST cells a side, per cent.
function apart_from(method, most,    sheets, i, side, gap, far)
{
    split("fabric along the warp,fabric along the bias,springs", sheets, ",")
    for (i in sheets)
        for (side = 8; side <= most; side *= 2) {
            gap = 100 * (sag(sheets[i], method, side) / sag(sheets[i], "implicit_euler", side) - 1)
            if (gap < 0) gap = -gap
            if (gap > far) far = gap
        }
    return far
}

function claims_of_sag(    warp, bias)
{
    warp = "fabric along the warp"
    bias = "fabric along the bias"
    claim("(3 ρ g L⁴ / 64 E)^(1/3) = 26.40 mm", about(1000 * (3 * 0.2 * 9.81 / 64 / 5000) ^ (1 / 3), "26.40"))
    claim("the limit is 26.36", about(limit(warp), "26.36"))
    claim("`implicit_euler` and `mass_spring` agree within 0.01 %, `vbd` with them",
          apart_from("mass_spring", 64) <= 0.01 && apart_from("vbd", 32) <= 0.01)
    claim("32² is within 0.1 %", among(from_limit(warp, "implicit_euler", 32), -0.1, 0.1))
    claim("the order is 1.2, 32² is 1.2 % from the limit",
          about(order(bias), "1.2") && about(-from_limit(bias, "implicit_euler", 32), "1.2"))
    name("400 substeps")
    claim("3.2 % on 64², where springs have 5.5 %",
          about(from_limit(warp, "xpbd", 64), "3.2") && about(from_limit("springs", "xpbd", 64), "5.5") \
          && from_limit(warp, "xpbd", 32) < from_limit(warp, "xpbd", 64) && from_limit(warp, "xpbd", 16) < from_limit(warp, "xpbd", 32))
    claim("6 % less than the fabric along the warp, and half of it along the bias",
          about(100 * (1 - limit("springs") / limit(warp)), "6") && among(limit("springs") / limit(bias), 0.45, 0.55))
    name("(`vbd` on 64² was left out")
}

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
    claims_of_sag()
    name("1000 substeps")
    name("with 4 of")
}
