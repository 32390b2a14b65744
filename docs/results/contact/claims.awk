# What docs/results/contact.md concludes (docs/claims.awk).

function lowest(row) { return v("stack", row, "lowest %") }
function worst(row) { return v("stack", row, "worst %") }
function fell(row) { return text_of("stack", row, "status") == "unconverged" }
function share(scene, stage) { return v("stages", scene, stage " %") }

# Runs that end as `completed` in the table of solids on cloth, of columns with such a suffix; "" for both floors.
function laden(floor, suffix,    f, d, h, k, n, floors, density, fall, method)
{
    split("mesh plane", floors, " "); split("50 500 2000 8000", density, " "); split("0.9 23", fall, " ")
    split("xpbd vbd implicit_euler", method, " ")
    for (f = 1; f <= 2; ++f)
        for (d = 1; d <= 4; ++d)
            for (h = 1; h <= 2; ++h)
                for (k = 1; k <= 3; ++k)
                    if (floor == "" || floor == floors[f])
                        n += v("laden", floors[f] " " density[d] " " fall[h], method[k] suffix)
    return n
}

function led(row, column) { return v("led", row, column) }

# Whether a column says `word` in all rows of some speeds.
function led_all(speeds, column, word,    i, m, n, k, good, speed, mesh, method)
{
    n = split(speeds, speed, " "); split("plate ball", mesh, " "); split("xpbd vbd implicit_euler", method, " ")
    good = 1
    for (i = 1; i <= n; ++i)
        for (m = 1; m <= 2; ++m)
            for (k = 1; k <= 3; ++k)
                good = good && text_of("led", mesh[m] " " speed[i] " " method[k], column) == word
    return good
}

function claims()
{
    claim("press exactly with the default of 2 sweeps (0.0026 % at the worst layer)", about(worst("4 20 2"), "0.0026"))
    claim("are 4.1 % off at the plate with 2 sweeps in each of 20 substeps, and 0.074 % with 8",
          about(lowest("16 20 2"), "4.1") && about(lowest("16 20 8"), "0.074"))
    claim("less than that, 1 sweep or 10 substeps, they fall through each other, and the run is `unconverged`",
          fell("16 20 1") && fell("16 10 2") && fell("16 5 2") && !fell("16 20 2"))
    claim("Fifty do so with up to 2 sweeps, are 26 % off with 8, 5 % with 16 and 0.091 % with 32",
          fell("50 20 1") && fell("50 20 2") && !fell("50 20 4") && about(lowest("50 20 8"), "26") \
          && about(lowest("50 20 16"), "5") && about(lowest("50 20 32"), "0.091"))
    claim("as the 8.7 % with 4 sweeps", about(lowest("50 20 4"), "8.7"))
    claim("with 80 of them and 2 sweeps sixteen layers are 0.95 % off, so sweeps do more for their time",
          about(lowest("16 80 2"), "0.95") && lowest("16 80 2") > 10 * lowest("16 20 8") \
          && v("stack", "16 80 2", "step ms") > 0.8 * v("stack", "16 20 8", "step ms"))
    claim("fifty 2.1 %, less than with 16 sweeps",
          about(lowest("50 80 2"), "2.1") && lowest("50 80 2") < lowest("50 20 16"))
    claim("less than 0.003 mm in these 20 s with 2 sweeps as with 32",
          v("creep", "2", "creep mm") < 0.003 && v("creep", "4", "creep mm") < 0.003 && v("creep", "8", "creep mm") < 0.003 \
          && v("creep", "16", "creep mm") < 0.003 && v("creep", "24", "creep mm") < 0.003 && v("creep", "32", "creep mm") < 0.003)
    claim("With default settings 133 of 144 runs end as `completed`", laden("", "") == 133)
    claim("all but those of 23 cm onto the mesh with 8,000 kg/m³, and two of three with 2,000 kg/m³ under `implicit_euler`",
          v("laden", "mesh 8000 23", "xpbd") + v("laden", "mesh 8000 23", "vbd") \
          + v("laden", "mesh 8000 23", "implicit_euler") == 0 && v("laden", "mesh 2000 23", "implicit_euler") == 1)
    claim("With 8 sweeps 83 do", laden("", " 8") == 83)
    claim("of those on the mesh only those of 50 kg/m³",
          laden("mesh", " 8") == v("laden", "mesh 50 0.9", "xpbd 8") + v("laden", "mesh 50 0.9", "vbd 8") \
          + v("laden", "mesh 50 0.9", "implicit_euler 8") + v("laden", "mesh 50 23", "xpbd 8") \
          + v("laden", "mesh 50 23", "vbd 8") + v("laden", "mesh 50 23", "implicit_euler 8"))
    claim("98 to 99 % in stacks, bowls and sheets on a ball", among(share("05_stack", "contact"), 97.5, 99.5) \
          && among(share("14_bowl", "contact"), 97.5, 99.5) && among(share("57_limited", "contact"), 97.5, 99.5))
    claim("81 % where two rings", about(share("31_hooked_rings", "contact"), "81"))
    claim("The guarantee takes 13 % of the scene that asks for it", about(share("16_through_layers", "guarantee"), "13"))
    claim("With the guarantee all 24 runs end as `completed`, nothing pinched and nothing crossed; without it all from 10 m/s on are `unconverged`",
          led_all("1 10 50 100", "status", "completed") && led_all("1 10 50 100", "pinched", "0") \
          && led_all("10 50 100", "without", "unconverged"))
    claim("At 1 m/s no step is done in parts", led_all("1", "steps in parts", "0"))
    claim("From 10 m/s on some are", !led_all("10", "steps in parts", "0") && !led_all("50", "steps in parts", "0"))
    claim("take up to some hundred times as long as a step at 1 m/s",
          among(led("plate 100 vbd", "95th percentile ms") / led("plate 1 vbd", "median step ms"), 200, 900))
}
