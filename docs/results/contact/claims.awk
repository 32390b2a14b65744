# What docs/results/contact.md concludes (docs/claims.awk).

function lowest(row) { return v("stack", row, "lowest %") }
function worst(row) { return v("stack", row, "worst %") }
function fell(row) { return text_of("stack", row, "status") == "unconverged" }
function share(scene, stage) { return v("stages", scene, stage " %") }

# Runs of the table of solids on cloth that a column of which `floor` says is of `word`; "" for both floors.
function laden(floor, suffix, word,    f, d, h, k, n, floors, density, fall, method)
{
    split("mesh plane", floors, " "); split("50 500 2000 8000", density, " "); split("0.9 23", fall, " ")
    split("xpbd vbd implicit_euler", method, " ")
    for (f = 1; f <= 2; ++f)
        for (d = 1; d <= 4; ++d)
            for (h = 1; h <= 2; ++h)
                for (k = 1; k <= 3; ++k)
                    n += (floor == "" || floor == floors[f]) \
                         && text_of("laden", floors[f] " " density[d] " " fall[h], method[k] suffix) == word
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
    claim("press exactly with the default of 2 sweeps (0.0053 % at the worst layer)", about(worst("4 20 2"), "0.0053"))
    claim("are 3.2 % off at the plate with 2 sweeps in each of 20 substeps, and 0.068 % with 8",
          about(lowest("16 20 2"), "3.2") && about(lowest("16 20 8"), "0.068"))
    claim("less than that, 1 sweep or 10 substeps, they fall through each other, and the run is `unconverged`",
          fell("16 20 1") && fell("16 10 2") && fell("16 5 2") && !fell("16 20 2"))
    claim("Fifty do so with up to 2 sweeps, are 41 % off with 8, 4.6 % with 16 and 0.093 % with 32",
          fell("50 20 1") && fell("50 20 2") && !fell("50 20 4") && about(lowest("50 20 8"), "41") \
          && about(lowest("50 20 16"), "4.6") && about(lowest("50 20 32"), "0.093"))
    claim("as the 11 % with 4 sweeps", about(lowest("50 20 4"), "11"))
    claim("Substeps instead of sweeps do less for their time: with 80 of them and 2 sweeps sixteen layers are 0.89 % off and fifty 17 %",
          about(lowest("16 80 2"), "0.89") && about(lowest("50 80 2"), "17") \
          && lowest("16 80 2") > 10 * lowest("16 20 8") \
          && among(v("stack", "16 80 2", "step ms") / v("stack", "16 20 8", "step ms"), 0.8, 1.2))
    claim("creep by 3.6 to 9.1 mm in these 20 s with up to 16 sweeps", about(v("creep", "4", "creep mm"), "3.6") \
          && about(v("creep", "8", "creep mm"), "9.1") && among(v("creep", "2", "creep mm"), 3.6, 9.1) \
          && among(v("creep", "16", "creep mm"), 3.6, 9.1))
    claim("by less than 0.001 mm with 24 and 32", v("creep", "24", "creep mm") < 0.001 && v("creep", "32", "creep mm") < 0.001)
    claim("With default settings 45 of 48 runs end as `completed`, all but that of 8,000 kg/m³ that fall 23 cm onto the mesh",
          laden("", "", "completed") == 45 && text_of("laden", "mesh 8000 23", "xpbd") == "unconverged" \
          && text_of("laden", "mesh 8000 23", "vbd") == "unconverged" \
          && text_of("laden", "mesh 8000 23", "implicit_euler") == "unconverged")
    claim("With 8 sweeps 20 are `unconverged`, 19 of them on the mesh",
          laden("", " 8", "unconverged") == 20 && laden("mesh", " 8", "unconverged") == 19)
    claim("on a plane only 2,000 kg/m³ that fall 23 cm under `xpbd`",
          text_of("laden", "plane 2000 23", "xpbd 8") == "unconverged")
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
