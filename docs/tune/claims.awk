# What docs/tune.md concludes of the examples, held against its table (docs/claims.awk).
# Of rows of a table whose names begin with a word.
function longest(table, word,    i, most)
{
    for (i = 1; i <= rows[table]; ++i)
        if (index(row_name[table, i], word) == 1 && v(table, row_name[table, i], "s") > most)
            most = v(table, row_name[table, i], "s")
    return most
}
function ends(table, word, answer,    i, count)
{
    for (i = 1; i <= rows[table]; ++i)
        count += index(row_name[table, i], word) == 1 && (answer == "" || text_of(table, row_name[table, i], "method") == answer)
    return count + 0
}
function is(scene, answer) { return text_of("tune", scene, "method") == answer }

# Examples with a setting, within a bound or any.
function answered(bound, table, word,    i, count)
{
    if (table == "")
        table = "tune"
    for (i = 1; i <= rows[table]; ++i)
        count += index(row_name[table, i], word) == 1 \
                 && (bound == "" || v(table, row_name[table, i], "within %") == bound) \
                 && v(table, row_name[table, i], "substeps") > 0
    return count + 0
}

function claims()
{
    claim("56 of 57 examples have a setting", rows["tune"] == 57 && answered("") == 56)
    claim("48 of them within 1 %, 3 within 2 %, 4 within 5 % and 1 within 10 % alone",
          answered(1) == 48 && answered(2) == 3 && answered(5) == 4 && answered(10) == 1)
    claim("every search ends within a minute.", longest("tune", "") <= 60)
    claim("the material of `acad_compress` does not carry its load", is("acad_compress", "unsound_reference"))
    claim("All 17 scenes of accuracy have a setting within 1 %, in at most 15 s.",
          ends("suites", "accuracy/", "") == 17 && answered(1, "suites", "accuracy/") == 17 \
          && longest("suites", "accuracy/") == 15)
    claim("Of the 33 of the suite for contact 22 have one, 13 of them within 1 %, and every search",
          ends("suites", "contact/", "") == 33 && answered("", "suites", "contact/") == 22 \
          && answered(1, "suites", "contact/") == 13 && longest("suites", "contact/") <= 60)
    claim("(5 have no reference)", ends("suites", "contact/", "no_reference") == 5)
    claim("nothing that was tried keeps 10 % (4)", ends("suites", "contact/", "none_of_tried") == 4)
}
