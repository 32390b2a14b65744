# Lines of docs/continuum/meshes.csv of what `taut cost --continuum --json` printed, one a point:
# awk -v scene=NAME -f row.awk FILE. Members of a point stand six blanks in, those of "continuum" four.
function member(line) { sub(/^ *"[a-z_]+": /, "", line); gsub(/[",]/, "", line); return line }
function percent(value) { return value == "null" || value == "" ? "" : sprintf("%.3g", 100 * value) }
/^  "continuum": \{/ { within = 1 }
/^  \}/ { within = 0 }
/^  "vertices":/ { vertices = member($0) }
within && /^    "(order|error|mesh_error)":/ { name = $1; gsub(/[":]/, "", name); mesh[name] = member($0) }
/^      "[a-z_]+": [^\[{]/ {
    name = $1
    gsub(/[":]/, "", name)
    point[name] = member($0)
}
/^    \}/ && point["substeps"] != "" {
    line = scene "," vertices "," sprintf("%.2f", mesh["order"]) "," percent(mesh["error"]) "," percent(mesh["mesh_error"]) ","
    lines[++count] = line point["method"] "," point["substeps"] "," percent(point["error"]) "," percent(point["error_continuum"])
    split("", point)
}
/^  "cheapest":/ { exit }
END { for (i = 1; i <= count; ++i) print lines[i] }
