# What docs/tune.md concludes of the examples, held against its table (docs/claims.awk).
function longest(    i, most)
{
    for (i = 1; i <= rows["tune"]; ++i)
        if (v("tune", row_name["tune", i], "s") > most)
            most = v("tune", row_name["tune", i], "s")
    return most
}
function is(scene, answer) { return text_of("tune", scene, "method") == answer }

# Examples with a setting, within a bound or any.
function answered(bound,    i, count)
{
    for (i = 1; i <= rows["tune"]; ++i)
        count += (bound == "" || v("tune", row_name["tune", i], "within %") == bound) \
                 && v("tune", row_name["tune", i], "substeps") > 0
    return count + 0
}

function claims()
{
    claim("56 of 57 examples have a setting", rows["tune"] == 57 && answered("") == 56)
    claim("48 of them within 1 %, 3 within 2 %, 4 within 5 % and 1 within 10 % alone",
          answered(1) == 48 && answered(2) == 3 && answered(5) == 4 && answered(10) == 1)
    claim("every search ends within a minute.", longest() <= 60)
    claim("the material of `acad_compress` does not carry its load", is("acad_compress", "unsound_reference"))
}
