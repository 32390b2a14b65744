# A line of docs/tune/tune.csv of what `taut tune --json` printed: awk -v scene=NAME -v seconds=S -f row.awk FILE.
# Members of the outermost object stand two blanks in, those of its "method" four.
function member(line) { sub(/^ *"[a-z_]+": /, "", line); gsub(/[",]/, "", line); return line }
function percent(name) { return sprintf("%.3g", 100 * of[name]) }
/^  "method": \{/ { within = 1 }
/^  \}/ { within = 0 }
/^  "[a-z_]+": [^\[{]/ || (within && /^    "[a-z_]+":/) {
    name = $1
    gsub(/[":]/, "", name)
    if (!(name in of))
        of[name] = member($0)
}
END {
    if (of["found"] != "true") {
        printf "%s,%s,,,,,%s,,,%d\n", scene, of["answer"], percent("error_bound"), seconds
        exit
    }
    at = of["kind"] == "static" ? "rest" : of["frames"]
    printf "%s,%s,%s,%s,%s,%s,%s,%s,%s,%d\n", scene, of["type"], of["substeps"], of["iterations"], of["precision"],
           percent("confirmed_error"), percent("error_bound"), at, of["starts"], seconds
}
