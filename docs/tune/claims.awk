# What docs/tune.md concludes of the examples, held against its table (docs/claims.awk).
function with(column, text,    i, count)
{
    for (i = 1; i <= rows["tune"]; ++i)
        count += text_of("tune", row_name["tune", i], column) == text
    return count + 0
}
function longest(    i, most)
{
    for (i = 1; i <= rows["tune"]; ++i)
        if (v("tune", row_name["tune", i], "s") > most)
            most = v("tune", row_name["tune", i], "s")
    return most
}
function is(scene, answer) { return text_of("tune", scene, "method") == answer }

function unanswered()
{
    return with("method", "none_of_tried") + with("method", "no_reference") + with("method", "refused")
}

function answered(bound,    i, count)
{
    for (i = 1; i <= rows["tune"]; ++i)
        count += v("tune", row_name["tune", i], "within %") == bound && v("tune", row_name["tune", i], "substeps") > 0
    return count + 0
}

function claims()
{
    claim("52 of 57 examples have an answer", rows["tune"] == 57 && rows["tune"] - unanswered() == 52)
    claim("45 of them within 1 %, 3 within 2 % and 4 within 5 % alone",
          answered(1) == 45 && answered(2) == 3 && answered(5) == 4)
    claim("every search ends within a minute.", longest() <= 60)
    claim("Two have none because no setting tried keeps the loosest bound (`acad_compress`, `cloth_on_cloth`)",
          with("method", "none_of_tried") == 2 && is("acad_compress", "none_of_tried") &&
          is("cloth_on_cloth", "none_of_tried"))
    claim("three because their reference does not settle (`all_effects`, `contact/layers`, `fabric/overhang`)",
          with("method", "no_reference") == 3 && is("all_effects", "no_reference") &&
          is("contact/layers", "no_reference") && is("fabric/overhang", "no_reference"))
}
