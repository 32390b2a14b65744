# For the update.sh of the pages: what stands between "<!-- PART -->" and "<!-- end -->" of a page becomes the
# text of a file. `scratch` is the caller's folder.
put() # PAGE PART FILE
{
    awk -v part="$2" -v table="$3" '
        $0 == "<!-- " part " -->" {
            print; print ""
            while ((getline line < table) > 0) print line
            print ""; skip = 1
        }
        $0 == "<!-- end -->" { skip = 0 }
        !skip && $0 != "<!-- " part " -->" { print }' "$1" > "$scratch/page.md"
    mv "$scratch/page.md" "$1"
}
