# What docs/results/contact.md concludes (docs/claims.awk).

function lowest(row) { return v("stack", row, "lowest %") }
function worst(row) { return v("stack", row, "worst %") }
function fell(row) { return text_of("stack", row, "status") == "unconverged" }
function share(scene, stage) { return v("stages", scene, stage " %") }

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
    claim("press exactly with the default of 2 sweeps (0.0052 % at the worst layer)", about(worst("4 20 2"), "0.0052"))
    claim("are 2.6 % off at the plate with 2 sweeps in each of 20 substeps, and 0.25 % with 8",
          about(lowest("16 20 2"), "2.6") && about(lowest("16 20 8"), "0.25"))
    claim("less than that, 1 sweep or 10 substeps, they fall through each other, and the run is `unconverged`",
          fell("16 20 1") && fell("16 10 2") && fell("16 5 2") && !fell("16 20 2"))
    claim("Fifty do so with up to 4 sweeps, are 28 % off with 8 and 8.9 % with 32",
          fell("50 20 1") && fell("50 20 2") && fell("50 20 4") && !fell("50 20 8") \
          && about(lowest("50 20 8"), "28") && about(lowest("50 20 32"), "8.9"))
    claim("(39 % with 16 sweeps)", about(lowest("50 20 16"), "39"))
    claim("with 80 of them and 2 sweeps sixteen layers are 0.81 % off and fifty 17 %",
          about(lowest("16 80 2"), "0.81") && about(lowest("50 80 2"), "17") \
          && v("stack", "16 80 2", "step ms") < 1.2 * v("stack", "16 20 8", "step ms"))
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
