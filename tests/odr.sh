#!/usr/bin/env bash
# Types that two files define differently, as the compiler sees them when it has the whole program: undefined behaviour that no
# linker reports. Compiles the host code of the library and of the program without optimisation for link-time optimisation, and
# joins the objects; kernels, whose files are generated one like the other, are left out.
#   tests/odr.sh FOLDER      to build in. Status 77 without g++ or Ninja.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
[ $# -eq 1 ] || { sed -n '2,5p' "$0" | sed 's/^# \{0,1\}//' >&2; exit 2; }
folder=$1
command -v ninja > /dev/null || { echo "Ninja is not installed"; exit 77; }
LC_ALL=C "${CXX:-g++}" --version | grep 'Free Software' > /dev/null || { echo "${CXX:-g++} is not g++"; exit 77; }

cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None -DTAUT_BUILD_TESTS=OFF -DTAUT_BUILD_EXAMPLES=OFF \
    -DCMAKE_CXX_COMPILER="${CXX:-g++}" -DCMAKE_CXX_FLAGS="-O0 -flto=1 -Wodr -Werror=odr" > "$folder.log" ||
    { cat "$folder.log" && exit 1; }
cd "$folder"
mapfile -t objects < <(ninja -t targets all | sed -n 's/^\(CMakeFiles\/.*\.cpp\.o\|CMakeFiles\/.*\.cxx\.o\): .*/\1/p' |
    grep -v -e taut_kernels -e kernelc -e shaderc)
[ ${#objects[@]} -gt 50 ] || { echo "only ${#objects[@]} objects were found"; exit 1; }
ninja -j "${TAUT_JOBS:-$(nproc)}" "${objects[@]}"
join() { "${CXX:-g++}" -O0 -flto=1 -r -flinker-output=rel -Wodr -Werror=odr "$@"; }
join "${objects[@]}" -o whole.o

# That nothing was found says something only where something would have been.
for type in int double; do
    echo "struct Probe { $type a; }; $type of(Probe p) { return p.a; }" | sed "s/of(/of_$type(/" > "probe_$type.cpp"
    "${CXX:-g++}" -O0 -flto=1 -c "probe_$type.cpp" -o "probe_$type.o"
done
if join probe_int.o probe_double.o -o probe.o 2> probe.log || ! grep -q odr probe.log; then
    echo "two types of one name are not seen" && exit 1
fi
echo "${#objects[@]} objects have no type that differs"
