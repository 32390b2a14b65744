# What docs/cloth.md concludes, held against its tables (docs/claims.awk).
function worst(t, r) { return v(t, r, "worst strain %") }
function ms(t, r) { return v(t, r, "ms a step") }
function apart(t, r) { return v(t, r, "difference e_L %") }
function times(t, a, b) { return ms(t, a) / ms(t, b) }

function claims()
{
    claim("Four executors end with the same bits (difference 0), for springs and for constraints.",
          apart("apis", "springs, native on all cores") + apart("apis", "springs, Vulkan") \
              + apart("apis", "springs, OpenGL") == 0 \
          && apart("apis", "constraints, Vulkan") == apart("apis", "constraints, native serial") \
          && apart("apis", "constraints, OpenGL") == apart("apis", "constraints, native serial"))
    claim("springs, with few passes a substep, take 4 to 20 times the native time",
          among(times("apis", "springs, Vulkan", "springs, native serial"), 4, 20) \
          && among(times("apis", "springs, OpenGL", "springs, native serial"), 4, 20))
    claim("up to twenty conjugate gradients, more than 25 times.",
          times("apis", "constraints, Vulkan", "constraints, native serial") > 25 \
          && times("apis", "constraints, OpenGL", "constraints, native serial") > 25)
    claim("The two models of one material end 1.3 % of the cloth's diagonal apart.",
          about(apart("apis", "constraints, native serial"), "1.3"))

    claim("Between 100 and 500 N/m a spring five times as stiff stretches a fifth as far (0.22);",
          about(worst("stiffness", "k = 500") / worst("stiffness", "k = 100"), "0.22"))
    claim("at 20 N/m the law bends (0.33)",
          about(worst("stiffness", "k = 100") / worst("stiffness", "k = 20 N/m"), "0.33"))

    claim("enforcing the structural ones leaves a fifth of the worst strain.",
          among(worst("constraints", "structural springs enforced") / worst("constraints", "springs alone"), 0.17, 0.23))
    claim("Enforced with the compliance of the springs, constraints stretch like springs",
          among(worst("constraints", "all enforced with their own compliance") / worst("constraints", "springs alone"),
                0.95, 1.05))

    claim("and falls with their stiffness.",
          worst("acad_stiffness", "k = 20 N/m") > worst("acad_stiffness", "k = 100") \
          && worst("acad_stiffness", "k = 100") > worst("acad_stiffness", "k = 500"))
    claim("k = 20 N/m costs several times k = 100", times("acad_stiffness", "k = 20 N/m", "k = 100") > 3)

    claim("stretch by 219 to 251 % at worst",
          about(worst("large_force", "vertex block descent"), "219") && about(worst("large_force", "xpbd"), "251") \
          && among(worst("large_force", "springs"), 219, 251))
    claim("Activation and enforcement keep the worst strain at 47 % and 45 %",
          about(worst("large_force", "adaptive"), "47") && about(worst("large_force", "enforced"), "45"))
    claim("at many times the price of xpbd.",
          times("large_force", "adaptive", "xpbd") > 20 && times("large_force", "enforced", "xpbd") > 20)
    claim("Ten substeps of xpbd are too few for that load (`unconverged`)",
          text_of("large_force", "xpbd", "status") == "unconverged")

    claim("A threshold of 5 % leaves a third of the worst strain of springs alone.",
          among(worst("acad_load", "adaptive, 5 %") / worst("acad_load", "springs"), 0.3, 0.36))
    claim("At 1 % most springs are active most of the time, go on and off, and a step costs three times as much and more.",
          times("acad_load", "adaptive, 1 %", "adaptive, 5 %") > 3)

    claim("By colours, all executors end with the same bits.",
          apart("pbd_devices", "native on all cores") + apart("pbd_devices", "Vulkan") \
              + apart("pbd_devices", "OpenGL") == 0)
    claim("The two Jacobi schemes agree with each other",
          apart("pbd_devices", "native, by vertices") == apart("pbd_devices", "native, by constraints"))
    claim("and stretch five times as far for the same 20 sweeps",
          among(worst("pbd_devices", "native, by vertices") / worst("pbd_devices", "native serial"), 4.5, 5.5))
    claim("None of these settings solves its cloth (`unconverged`)",
          all_are("pbd_devices", "status", "unconverged"))

    claim("(k' = 1 − (1 − k)^(1/20)), 0.9 is 0.11 a sweep and 0.999 is 0.29",
          about(1 - 0.1 ^ (1 / 20), "0.11") && about(1 - 0.001 ^ (1 / 20), "0.29"))
    claim("only 1 leaves the cloth in some shape (115 %, the others 315 % and more)",
          about(worst("pbd_stretch", "1"), "115") && worst("pbd_stretch", "0.999") >= 315 \
          && worst("pbd_stretch", "0.99") > 315 && worst("pbd_stretch", "stretch 0.9") > 315)

    claim("Hinges at 0.02 already change the shape by 4.7 % of the diagonal; more stiffness adds little.",
          about(apart("pbd_bend", "0.02"), "4.7") && apart("pbd_bend", "0.5") < 1.2 * apart("pbd_bend", "0.02"))
    claim("a step with them takes several times as long.", times("pbd_bend", "0.02", "bend 0") > 3)

    claim("The worst strain falls a little more slowly than the sweeps grow: 80 sweeps leave 37 %.",
          about(worst("pbd_iterations", "80"), "37") \
          && worst("pbd_iterations", "80") * 80 > worst("pbd_iterations", "1 iteration"))

    claim("For the same 20 sweeps a step, twenty substeps of one sweep leave a third of the strain of one substep of twenty, for about the same price",
          among(worst("pbd_sphere", "20 x 1") / worst("pbd_sphere", "1 x 20"), 0.3, 0.36) \
          && times("pbd_sphere", "20 x 1", "1 x 20") < 1.5)
    name("(Macklin et al., 2019)")
    claim("and alone are solved", text_of("pbd_sphere", "20 x 1", "status") == "completed" \
          && text_of("pbd_sphere", "1 x 20", "status") == "unconverged" \
          && text_of("pbd_sphere", "4 x 5", "status") == "unconverged")

    claim("Four other methods end within 14 % of the diagonal of `xpbd`",
          apart("methods", "pbd") < 14 && apart("methods", "mass_spring") < 14 \
          && apart("methods", "implicit_constraints") < 14 && apart("methods", "acad") < 14)
    claim("implicit Euler and block descent damp the swing (their energy is the lowest) and hang elsewhere",
          v("methods", "implicit_euler", "energy at the end J") < v("methods", "xpbd", "energy at the end J") \
          && v("methods", "vbd", "energy at the end J") < v("methods", "implicit_euler", "energy at the end J") \
          && apart("methods", "implicit_euler") > 15 && apart("methods", "vbd") > 15)
    claim("The least strain has acad, which was asked to allow 5 %;",
          worst("methods", "acad") < worst("methods", "pbd") && worst("methods", "acad") < worst("methods", "implicit_euler"))
    claim("the least time have xpbd and pbd, with 16 % and 6.5 % of it.",
          about(worst("methods", "xpbd"), "16") && about(worst("methods", "pbd"), "6.5") \
          && times("methods", "xpbd", "vbd") < 1 && times("methods", "pbd", "vbd") < 1)

    claim("springs stretch by 200 %.", about(v("opencloth", "pbd, native serial", "largest strain at the end %"), "200"))
    claim("xpbd with the compliance of the scene's springs stretches a quarter of that, and is not solved either.",
          among(v("opencloth", "xpbd", "largest strain at the end %") / 200, 0.22, 0.28) \
          && all_are("opencloth", "status", "unconverged"))
    claim("Executors agree bit for bit.", apart("opencloth", "native on all cores") + apart("opencloth", "Vulkan") \
              + apart("opencloth", "OpenGL") == 0)
    claims_of_size()
    claims_of_bullet()
}

function at(side, method, executor, column) { return v("size", method " " side * side " " executor, column) }
function step(side, method) { return at(side, method, "cpu:serial", "median_ms") }
function far(side, method) { return at(side, method, "cpu:serial", "worst_stretch") * 100 }

function claims_of_size()
{
    claim("From 16² to 64² vertices a step on one core becomes 51 times as dear for mass-spring",
          about(step(64, "mass_spring") / step(16, "mass_spring"), "51"))
    claim("40 times for enforcement and 18 times for position-based dynamics.",
          about(step(64, "implicit_constraints") / step(16, "implicit_constraints"), "40") \
          && about(step(64, "pbd") / step(16, "pbd"), "18"))
    claim("At 64² the latter costs a thirtieth of mass-spring and stretches by 863 %, 75 times as far",
          among(step(64, "mass_spring") / step(64, "pbd"), 27, 33) && about(far(64, "pbd"), "863") \
          && about(far(64, "pbd") / far(64, "mass_spring"), "75"))
    name("20 iterations do not reach across so many vertices")
    claim("Enforcement stretches by 0.7 % at most, for two to three and a half times the price of mass-spring.",
          about(far(64, "implicit_constraints"), "0.7") \
          && among(step(64, "implicit_constraints") / step(64, "mass_spring"), 2, 3.6) \
          && among(step(16, "implicit_constraints") / step(16, "mass_spring"), 2, 3.6))
    claim("Software drivers take 3 to 82 times the native time, the less the larger the cloth.",
          drivers_take("3", "82"))
}

# Whether software drivers take LEAST to MOST times the native time over all rows, and less on each larger cloth.
function drivers_take(least, most,    m, d, side, methods, drivers, time, before, low, high, ok)
{
    split("mass_spring implicit_constraints pbd", methods, " ")
    split("vulkan opengl", drivers, " ")
    low = 1e9
    ok = 1
    for (m in methods)
        for (d in drivers) {
            before = 1e9
            for (side = 16; side <= 64; side *= 2) {
                time = at(side, methods[m], drivers[d], "to_serial")
                ok = ok && time < before
                before = time
                if (time < low) low = time
                if (time > high) high = time
            }
        }
    return ok && about(low, least) && about(high, most)
}

# SIDE ENGINE COLUMN of bullet.csv.
function of(side, engine, column) { return v("bullet", side " x " side " " engine, column) }
function ratio(side, engine, other, column) { return of(side, engine, column) / of(side, other, column) }

function claims_of_bullet(    sides, n, i, s, ours, like, less, same, cheaper, worse, column)
{
    n = split("20 32 64 128", sides, " ")
    ours = like = less = same = cheaper = 1
    for (i = 1; i <= n; ++i) {
        s = sides[i]
        for (column = 1; column <= 2; ++column) {
            worse = column == 1 ? "1 x 10" : "10 x 1"
            ours = ours && among(of(s, "pbd, " worse, "to Bullet"), 0.08, 0.42) \
                && among(of(s, "xpbd, " worse, "to Bullet"), 0.08, 0.45)
            same = same && of(s, "pbd, " worse, "worst stretch %") == of(s, "xpbd, " worse, "worst stretch %")
            if (s <= 64)
                like = like && among(ratio(s, "bullet, " worse, "pbd, " worse, "e_L after 0.5 s %"), 0.65, 0.95)
        }
        if (s <= 64)
            less = less && among(ratio(s, "pbd, 10 x 1", "pbd, 1 x 10", "worst stretch %"), 1 / 8.3, 1 / 5.8) \
                && among(ratio(s, "bullet, 10 x 1", "bullet, 1 x 10", "worst stretch %"), 1 / 8.3, 1 / 5.8)
        cheaper = cheaper && of(s, "pbd, 10 x 1", "median ms") < of(s, "bullet, 1 x 10", "median ms") \
            && ratio(s, "pbd, 10 x 1", "bullet, 1 x 10", "worst stretch %") < 1 / 3
    }
    claim("For the same number of projections ours takes a tenth to four tenths of Bullet's time.", ours)
    claim("up to 64² Bullet has 0.7 to 0.9 of our error;", like)
    claim("at 128² and 1 × 10 both stretch by more than 170 % at worst;",
          of(128, "pbd, 1 x 10", "worst stretch %") > 170 && of(128, "bullet, 1 x 10", "worst stretch %") > 170)
    claim("at 128² and 10 × 1 Bullet stretches more than twice as far as ours and has not come to rest.",
          ratio(128, "bullet, 10 x 1", "pbd, 10 x 1", "worst stretch %") > 2 \
          && of(128, "bullet, 10 x 1", "last motion %") > 100 * of(128, "pbd, 10 x 1", "last motion %"))
    claim("a sixth to an eighth of the worst stretch of one step of ten, in both engines, up to 64².", less)
    claim("`pbd` 10 × 1 takes less time than Bullet's 1 × 10 at every size, and stretches less than a third as far.", cheaper)
    claim("At compliance 0 `xpbd` ends with the numbers of `pbd`.", same)
}
