# Holds what a page concludes against the tables beside it. For docs/check.sh:
#
#   awk -f docs/claims.awk -f PAGE/claims.awk PAGE.md TABLE.csv...
#
# Conclusions are the paragraphs of a page that begin with "**What it shows.**". PAGE/claims.awk defines
# claims(), which calls claim(TEXT, TRUTH) for every conclusion: the text must stand in such a paragraph, and the
# truth, formed from the tables, must hold. No digit of the paragraphs may be left outside a text: a number that
# nothing is held against cannot be written. name(TEXT) is for digits that are none, as in a citation. `whole` (-v whole=1)
# takes every line of the page for a conclusion; `digits` is what counts as a number.
#
#   v(TABLE, ROW, COLUMN)   a number; the row by its first field, or by the first two or three with blanks between.
#                           The table is the file's name without .csv
#   text_of(...)            the same as text
#   about(A, B)             A is B but for the last digit that is given of B as text: about(3.46, "3.5")
#   among(X, LOW, HIGH)     LOW <= X <= HIGH
#   all_are(TABLE, COLUMN, TEXT)
# Exit status 1 with what does not hold.

function fail(text) { print page ": " text > "/dev/stderr"; failed = 1 }

# Fields of a line of CSV, quoted ones too, into `cell`; returns how many.
function cells(line,    n, field)
{
    n = 0
    while (line != "") {
        if (line ~ /^"/) {
            match(line, /^"([^"]|"")*"/)
            field = substr(line, 2, RLENGTH - 2)
            gsub(/""/, "\"", field)
            line = substr(line, RLENGTH + 1)
            if (line == ",") { cell[++n] = field; field = "" }
            sub(/^,/, "", line)
        } else if (match(line, /,/)) {
            field = substr(line, 1, RSTART - 1)
            line = substr(line, RSTART + 1)
            if (line == "") { cell[++n] = field; field = "" }
        } else {
            field = line
            line = ""
        }
        cell[++n] = field
    }
    return n
}

function text_of(table, row, column)
{
    if (!((table, row, column) in value)) fail("no \"" column "\" of \"" row "\" in " table ".csv")
    return value[table, row, column]
}
function v(table, row, column) { return text_of(table, row, column) + 0 }
function among(x, low, high) { return low <= x && x <= high }
function about(x, given,    part, unit, point)
{
    split(given, part, "e")
    point = index(part[1], ".")
    unit = (point ? 10 ^ (point - length(part[1])) : 1) * 10 ^ (part[2] + 0)
    return x - given <= 0.5001 * unit && given - x <= 0.5001 * unit
}
# Whether a number of a file is what a page shows: to the digits of the page or, of a number with a point, to the five that the file
# has at least.
function shows(kept, given,    most)
{
    kept += 0
    most = given !~ /\./ ? 0 : 5.01e-5 * (kept < 0 ? -kept : kept)
    return about(kept + 0, given) || (kept - given <= most && given - kept <= most)
}
function all_are(table, column, text,    i)
{
    for (i = 1; i <= rows[table]; ++i)
        if (text_of(table, row_name[table, i], column) != text) return 0
    return rows[table] > 0
}

function take(text,    at)
{
    at = index(shown, text)
    if (!at) { fail("no conclusion says \"" text "\""); return 0 }
    shown = substr(shown, 1, at - 1) "|" substr(shown, at + length(text))
    return 1
}
function name(text) { take(text) }
function claim(text, truth) { if (take(text) && !truth) fail("\"" text "\" is not what the tables say") }

FNR == 1 {
    files++
    table = FILENAME
    sub(/.*\//, "", table)
    if (files == 1) page = table
    sub(/\.csv$/, "", table)
}
files == 1 && /^\*\*What it shows\.\*\*/ { showing = 1 }
files == 1 && /^$/ { showing = 0 }
files == 1 { sub(/^ *(- )?/, ""); if (showing || whole) shown = shown " " $0; next } # lists too
/^#/ { next }
!(table in rows) { columns = cells($0); rows[table] = 0; for (i = 1; i <= columns; ++i) head[i] = cell[i]; next }
{
    n = cells($0)
    row_name[table, ++rows[table]] = cell[1]
    second[table, rows[table]] = cell[2]
    for (i = 1; i <= columns; ++i)
        value[table, cell[1], head[i]] = value[table, cell[1] " " cell[2], head[i]] = \
            value[table, cell[1] " " cell[2] " " cell[3], head[i]] = i <= n ? cell[i] : ""
}
END {
    claims()
    if (digits == "") digits = "[0-9]"
    while (match(shown, "[^|]*(" digits ")[^|]*")) {
        rest = substr(shown, RSTART, RLENGTH)
        match(rest, digits)
        fail("nothing is held against \"..." substr(rest, RSTART > 60 ? RSTART - 60 : 1, 100) "...\"")
        shown = substr(shown, 1, index(shown, rest) - 1)
    }
    exit failed
}
