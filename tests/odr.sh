#!/usr/bin/env bash
# Types that two files define differently, as the compiler sees them when it has the whole program: undefined behaviour that no
# linker reports. Compiles the host code of the library and of the program without optimisation for link-time optimisation, by
# the commands of a build that is done, whose generated headers it reads, and joins the objects; kernels, whose files are
# generated one like the other, are left out.
#   tests/odr.sh BUILD FOLDER      the build, and the folder for the objects. Status 77 without g++ or Ninja.
set -euo pipefail

[ $# -eq 2 ] || { sed -n '2,6p' "$0" | sed 's/^# \{0,1\}//' >&2; exit 2; }
build=$(cd "$1" && pwd -P)
mkdir -p "$2"
folder=$(cd "$2" && pwd -P)
[ -f "$build/build.ninja" ] || { echo "$build is no build by Ninja"; exit 77; }
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
LC_ALL=C "$compiler" --version | grep 'Free Software' > /dev/null || { echo "$compiler is not g++"; exit 77; }

# Lines "OBJECT<tab>COMMAND" of the targets in src and runtime; headers that are compiled beforehand come first, and objects
# include those that this script compiled, not the build's, which are of other options.
ninja -C "$build" -t compdb | awk -v folder="$folder" '
    /^    "command": / {
        command = substr($0, 17, length($0) - 18)
        gsub(/\\"/, "\"", command)
    }
    /^    "output": / {
        object = substr($0, 16, length($0) - 16)
        if (object !~ /^CMakeFiles\/taut[^\/]*\.dir\/.*\.(o|gch)$/ || object ~ /taut_kernels|kernelc|shaderc/) next
        sub(/-MD .* -o [^ ]+ /, "", command)
        gsub(/[^ ]*CMakeFiles\/[^ ]*cmake_pch\.hxx /, folder "/&", command)
        print object "\t" command
    }' | sed "s#$folder/$build/#$folder/#" > "$folder/commands"
grep -c '\.o	' "$folder/commands" > /dev/null || { echo "no object was found in $build"; exit 1; }

compile() { # one line of the list
    local object=$folder/${1%%$'\t'*} command=${1#*$'\t'}
    mkdir -p "$(dirname "$object")"
    case $object in *.gch) cp "$build/${1%%.gch*}" "${object%.gch}" ;; esac
    (cd "$build" && eval "$command -O0 -flto=1 -w -Wodr -Werror=odr -o $object")
}
export -f compile
export folder build
for kind in gch o; do
    { grep "\.$kind	" "$folder/commands" || true; } | tr '\n' '\0' |
        xargs -0 -r -n 1 -P "${TAUT_JOBS:-$(nproc)}" bash -c 'set -e; compile "$1"' -
done
mapfile -t objects < <(sed -n "s#^\([^	]*\.o\)	.*#$folder/\1#p" "$folder/commands")
[ ${#objects[@]} -gt 50 ] || { echo "only ${#objects[@]} objects were found"; exit 1; }
cd "$folder"
join() { "$compiler" -O0 -flto=1 -r -flinker-output=rel -Wodr -Werror=odr "$@"; }
join "${objects[@]}" -o whole.o

# That nothing was found says something only where something would have been.
for type in int double; do
    echo "struct Probe { $type a; }; $type of(Probe p) { return p.a; }" | sed "s/of(/of_$type(/" > "probe_$type.cpp"
    "$compiler" -O0 -flto=1 -c "probe_$type.cpp" -o "probe_$type.o"
done
if join probe_int.o probe_double.o -o probe.o 2> probe.log || ! grep -q odr probe.log; then
    echo "two types of one name are not seen" && exit 1
fi
echo "${#objects[@]} objects have no type that differs"
