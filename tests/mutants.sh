#!/usr/bin/env bash
# Breaks one kernel or one decision of the host at a time and writes down which tests notice.
#   tests/mutants.sh [--kernels GLOB] [--kinds LIST] [--suites LIST] [--sample N] [--budget SECONDS]
#                    [--first TESTS] [--limit SECONDS] [--out FILE] [--again] [--survivors] [--report] [--stale]
# --kernels: 'vbd_*'. --kinds: of nothing,sign,drop,host (all). --suites: of
# conformance,unit,physics,golden,hard (all), in this order. --sample: every Nth mutant only. --budget: no new
# mutant after so long. --limit: of one run of one suite, 1,800 s; a suite that takes longer has noticed.
# --first: tests, as Catch2 names them ("[#contact_test]": of a file), that each program runs before all.
# --again: runs mutants that the table has. --survivors: no further suite for a mutant that one has noticed.
# --report: the table in Markdown, runs nothing. --stale: names the rows that are out of date, and runs nothing:
# of lines and kernels that are no more, and kernels that have none; exit status 1 if there are any.
#
# A run goes on where the last one stopped: a suite that a row of the table answers is not run again, but where the
# line of a row is no more. Kinds:
#   nothing  the kernel returns at once
#   sign     its first sum becomes a difference, or the other way about
#   drop     its first sum loses its last term
#   host     a line of tests/mutants_host.txt
# The native executor alone: TAUT_BUILD (build/release) must hold the tests, built with Ninja. Nothing is
# built there: the object of a mutant is compiled beside it and linked before, or in place of, the right one.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=${TAUT_BUILD:-$root/build/release}
kernels='*' kinds=nothing,sign,drop,host suites=conformance,unit,physics,golden,hard
sample=1 budget=1000000 limit=1800 first="" out=$root/tests/mutants.csv again="" survivors="" report="" stale=""
while [ $# -gt 0 ]; do
    case $1 in
    --again | --survivors | --report | --stale) declare "${1#--}=1" && shift ;;
    --kernels | --kinds | --suites | --sample | --budget | --first | --limit | --out)
        declare "${1#--}=$2" && shift 2 ;;
    *) sed -n '2,20p' "$0" | sed 's/^# \{0,1\}//' && exit 2 ;;
    esac
done
[ -z "$again" ] || [ -z "$survivors" ] || {
    echo "--again runs everything, --survivors what nothing has noticed: one of the two" >&2
    exit 2
}
work=$build/mutants
mkdir -p "$work"
head=mutant,kind,what,conformance,unit,physics,golden,hard
[ -s "$out" ] || echo "$head" > "$out"

# program_of SUITE: the test programs of a suite.
programs_of() {
    case $1 in
    unit) echo test_base test_runtime test_scene test_plan test_linear test_judge test_world test_report ;;
    hard) echo test_linear_hard test_hard ;;
    *) echo "test_$1" ;;
    esac
}

# field MUTANT SUITE: what the table says; empty if nothing.
field() {
    awk -F, -v mutant="$1" -v suite="$2" '
        NR == 1 { for (k = 1; k <= NF; ++k) if ($k == suite) column = k }
        $1 == mutant { print $column }' "$out"
}

# note MUTANT KIND WHAT SUITE ANSWER: into the table, by rename.
note() {
    awk -F, -v OFS=, -v mutant="$1" -v kind="$2" -v what="$3" -v suite="$4" -v answer="$5" '
        NR == 1 { n = NF; for (k = 1; k <= n; ++k) if ($k == suite) column = k }
        $1 == mutant { $column = answer; $3 = what; found = 1 }
        { print }
        END {
            if (found) exit
            for (k = 4; k <= n; ++k) row[k] = k == column ? answer : ""
            printf "%s,%s,%s", mutant, kind, what
            for (k = 4; k <= n; ++k) printf ",%s", row[k]
            printf "\n"
        }' "$out" > "$out.new"
    mv "$out.new" "$out"
}

# compile OBJECT SOURCE RESULT [FLAG...]: as the build compiles OBJECT, another source.
compile() {
    local object=$1 source=$2 result=$3 command
    shift 3
    command=$(ninja -C "$build" -t commands "$object" | tail -1)
    command=${command%% -MD*}
    (cd "$build" && $command "$@" -o "$result" -c "$source")
}

# link PROGRAM RESULT (ORIGINAL MUTATED)...: as the build links it, with other objects. Those of the
# library come out of an archive, or stand on the line themselves. Status 3: the program has none of them.
link() {
    local program=$1 result=$2 command found=""
    shift 2
    rm -f "$result"
    command=$(ninja -C "$build" -t commands "tests/$program" | tail -1)
    command=${command//"-o tests/$program"/"-o $result"}
    while [ $# -gt 0 ]; do
        if [[ $command == *" $1 "* ]]; then
            command=${command//" $1 "/" $2 "} found=1
        elif [[ $command == *" libtaut.a "* ]]; then
            command=${command/" -o $result"/" $2 -o $result"} found=1
        fi
        shift 2
    done
    [ -n "$found" ] || return 3
    (cd "$build" && eval "$command") || { echo "$program cannot be linked" >&2; exit 1; }
}

# mutated KIND KERNEL N: the text of the kernel with a sum turned or shortened, the first after N others,
# and on descriptor 3 the line that it was; fails if there is none. A sum stands in a statement, beyond the
# bindings.
mutated() {
    awk -v kind="$1" -v before="$3" '
        # The line without its comment and what stands in brackets: sums there are places, not values.
        function values(line) {
            sub(/\/\/.*/, "", line)
            while (match(line, /\[[^][]*\]/)) {
                blank = sprintf("%" RLENGTH "s", ""); gsub(/ /, "#", blank)
                line = substr(line, 1, RSTART - 1) blank substr(line, RSTART + RLENGTH)
            }
            return line
        }
        {
            line = values($0)
            if (line ~ /^[A-Z_]*KERNEL|^INLINE .*\(|^[a-z].*\(/) inside = 1
            sum = kind == "sign" ? " [-+]=? " : " [-+] [A-Za-z0-9_.*#/ ]+;| [-+]= "
            usable = inside && !done && line ~ /;[ \t]*$/ && line !~ /^#|for \(|uint / && match(line, sum)
            if (!usable || before-- > 0) { print; next }
            done = 1
            print $0 > "/dev/fd/3"
            if (kind == "sign") {
                turned = substr(line, RSTART + 1, 1) == "+" ? "-" : "+"
                print substr($0, 1, RSTART) turned substr($0, RSTART + 2)
            } else if (substr(line, RSTART + 2, 1) == "=") print ""
            else print substr($0, 1, RSTART - 1) ";"
        }
        END { exit !done }' "$2"
}

# unit_of SOURCE CHANGED RESULT: RESULT becomes what the build compiles SOURCE in, itself or its batch, with
# CHANGED in its place; sets `object`, which it makes.
unit_of() {
    local batch
    batch=$(find "$build/CMakeFiles" "$build/generated/taut/kernels" \( -path '*/Unity/*.cxx' -o -name 'batch_*.cpp' \) \
        -exec grep -lF "\"$1\"" {} + | head -1) || true # none has it
    case $batch in
    "") object=$(ninja -C "$build" -t query "$1" | sed -n 's/^ *\(.*\.o\)$/\1/p' | head -1) ;;
    *.cxx) object=${batch#"$build"/}.o ;;
    *) object=CMakeFiles/taut_kernels.dir/${batch#"$build"/}.o ;;
    esac
    if [ -z "$batch" ]; then cp "$2" "$3"; else sed "s|\"$1\"|\"$2\"|" "$batch" > "$3"; fi
}

# make_kernel KIND STEM TEXT N: objects of the mutant, with another TEXT (below kernels/); sets `pairs` and
# `what`. Status 1: no such sum, 2: does not compile.
make_kernel() {
    local kind=$1 stem=$2 text=$3 generated=$build/generated/taut/kernels/$2 object source changed
    pairs=() what=
    if [ "$kind" = nothing ]; then
        what='returns at once'
        unit_of "$generated.native.cpp" "$generated.native.cpp" "$work/unit.cpp" # for `object`
        { echo '#include <cstdint>'
          echo "namespace taut::kernels::$stem {"
          nm -C "$build/$object" | sed -n "s/.* T taut::kernels::$stem::\\(native_[a-z0-9_]*\\)(.*/\\1/p" |
              sed 's/.*/void &(const void*, void* const*, std::uint32_t, std::uint32_t) {}/'
          echo '}'; } > "$work/$stem.cpp"
        unit_of "$generated.native.cpp" "$work/$stem.cpp" "$work/unit.cpp"
        compile "$object" "$work/unit.cpp" "$work/$stem.o"
        pairs=("$object" "$work/$stem.o")
        return
    fi
    changed=$work/$stem.${text##*.}
    mutated "$kind" "$root/kernels/$text" "$4" 3> "$work/line" > "$changed" || return 1
    what=$(as_field "$work/line")
    for source in native lanes; do
        [ -f "$generated.$source.cpp" ] || continue
        sed "s|\"$text\"|\"$changed\"|" "$generated.$source.cpp" > "$work/$stem.$source.cpp"
        unit_of "$generated.$source.cpp" "$work/$stem.$source.cpp" "$work/unit.cpp"
        [ -f "$build/$object" ] || continue
        compile "$object" "$work/unit.cpp" "$work/$stem.$source.o" \
            -I "$(dirname "$root/kernels/$text")" 2> "$work/errors" || return 2
        pairs+=("$object" "$work/$stem.$source.o")
    done
}

# texts_of NATIVE: the kernel, and its element or shape, that a generated source was made from; below kernels/.
texts_of() {
    sed -n 's/^#include "\(.*\.comp\)"$/\1/p; s/^#define TAUT_[EC][A-Z]* "\(.*\)"$/\1/p' "$1" | sort -u
}

# make_host FILE EXPRESSION: the object of a source changed by sed, alone or in its batch; sets `pairs`.
make_host() {
    local file=$1 object
    sed "$2" "$root/$file" > "$work/host.cpp"
    ! cmp -s "$root/$file" "$work/host.cpp" || {
        echo "$file: the expression changes nothing: $2" >&2
        exit 1
    }
    unit_of "$root/$file" "$work/host.cpp" "$work/host.cxx"
    compile "$object" "$work/host.cxx" "$work/host.o" -I "$(dirname "$root/$file")"
    pairs=("$object" "$work/host.o")
}

# passes SUITE PROGRAM [TESTS]: with what it prints in a log. Status 77 is "passed, and left something out".
passes() {
    local log=$work/${2##*/}.log status=0
    [ "$1" != hard ] || local -x TAUT_HARD_SHORT=1 TAUT_MAP_FIRST=1
    TAUT_TEST_DEVICES=cpu:serial TAUT_PIPELINE_CACHE=off TAUT_DEVICE_COSTS=off timeout "$limit" nice \
        "$2" --abort --filenames-as-tags "${@:3}" > "$log" 2>&1 || status=$?
    [ $status -eq 0 ] || [ $status -eq 77 ]
}

# has_tests PROGRAM TESTS: of a name that nothing has Catch2 makes a failure.
has_tests() { [ -n "$("$1" --filenames-as-tags --list-tests --verbosity quiet "$2" 2> /dev/null)" ]; }

# run_suite SUITE MUTANT: "killed" or "lives". The tests of --first and those of the file that has the kernel's
# name run before the others: they are the likeliest to notice.
run_suite() {
    local program linked stem=${2%%[.:]*} likely
    for program in $(programs_of "$1"); do
        linked=0
        link "$program" "$work/$program" "${pairs[@]}" || linked=$?
        [ $linked -ne 3 ] || continue
        for likely in "$first" "[#${stem}_test]"; do
            if [ -n "$likely" ] && has_tests "$work/$program" "$likely"; then
                passes "$1" "$work/$program" "$likely" || { echo killed; return; }
            fi
        done
        passes "$1" "$work/$program" || { echo killed; return; }
    done
    echo lives
}

# require_sound SUITE: once a suite. One that fails without any mutant would seem to notice each of them.
declare -A sound=()
require_sound() {
    local program
    [ -z "${sound[$1]:-}" ] || return 0
    for program in $(programs_of "$1"); do
        passes "$1" "$build/tests/$program" || {
            echo "$program fails without any mutant, see $work/$program.log: cure that first" >&2
            exit 1
        }
    done
    sound[$1]=1
}

# spared MUTANT: --survivors, and a suite has noticed it.
spared() { [ -n "$survivors" ] && grep -q "^$1,.*,killed" "$out"; }

# judge MUTANT KIND: the suites that the table does not answer.
judge() {
    local suite
    for suite in ${suites//,/ }; do
        ! spared "$1" || break
        [ -n "$again" ] || [ -z "$(field "$1" "$suite")" ] || continue
        require_sound "$suite"
        note "$1" "$2" "$what" "$suite" "$(run_suite "$suite" "$1")"
    done
    grep "^$1," "$out" >&2
}

# wanted MUTANT: within the sample and the budget, and not answered.
count=0
wanted() {
    local suite
    count=$((count + 1))
    [ $((count % sample)) -eq 0 ] || return 1
    [ "$SECONDS" -lt "$budget" ] || return 1
    ! spared "$1" || return 1
    [ -z "$again" ] || return 0
    for suite in ${suites//,/ }; do
        [ -n "$(field "$1" "$suite")" ] || return 0
    done
    return 1
}

table() {
    awk -F, '
        NR == 1 { n = NF; for (k = 4; k <= n; ++k) name[k] = $k; next }
        {
            killed = 0; ran = 0
            ++mutants[$2]
            for (k = 4; k <= n; ++k) {
                if ($k != "") { ran = 1; ++seen[$2, k] }
                if ($k == "killed") { ++kills[$2, k]; killed = 1 }
            }
            if (killed) ++dead[$2]
            else survivors = survivors "| " $1 " | " $3 " |\n"
        }
        END {
            printf "| kind | mutants | killed |"; for (k = 4; k <= n; ++k) printf " %s |", name[k]
            printf "\n|---|---:|---:|"; for (k = 4; k <= n; ++k) printf "---:|"
            printf "\n"
            split("nothing sign drop host", kinds, " ")
            for (i = 1; i <= 4; ++i) {
                kind = kinds[i]
                printf "| %s | %d | %d |", kind, mutants[kind], dead[kind]
                for (k = 4; k <= n; ++k) printf " %d of %d |", kills[kind, k], seen[kind, k]
                printf "\n"
            }
            printf "\n| lives | what was changed |\n|---|---|\n%s", survivors
        }' "$out"
}

[ -z "$report" ] || { table; exit; }

# as_field LINE...: as the table has a line of a kernel.
as_field() { sed 's/\/\/.*//; s/^[ \t]*//; s/[ \t]*$//; s/,/;/g' "$@"; }

# is_stale MUTANT TEXT: the table has the mutant by a line that the text no longer has.
is_stale() {
    local line
    line=$(awk -F, -v mutant="$1" '$1 == mutant { print $3 }' "$out")
    [ -n "$line" ] && [ "$line" != 'returns at once' ] && ! as_field "$root/kernels/$2" | grep -xF -- "$line" > /dev/null
}

# run_mutant MUTANT KIND STEM TEXT: judged, where it is wanted.
run_mutant() {
    local made=2 n
    if is_stale "$1" "$4"; then
        grep -v "^$1," "$out" > "$out.new" && mv "$out.new" "$out"
    fi
    wanted "$1" || return 0
    for ((n = 0; made == 2; ++n)); do # an index without its sum does not compile: the next one
        made=0
        make_kernel "$2" "$3" "$4" $n || made=$?
    done
    if [ $made -eq 0 ]; then
        judge "$1" "$2"
    else
        echo "$1: no sum that can be changed" >&2
    fi
}

# name_stale MUTANT KIND STEM TEXT: printed if it is out of date. A kernel that returns at once is always one.
name_stale() {
    echo "$1" >> "$work/mutants"
    if is_stale "$1" "$4"; then
        echo "$1: its line is no more in kernels/$4"
    elif [ "$2" = nothing ] && ! grep -q "^$1," "$out"; then
        echo "$1: has no row"
    fi
}

# each_kernel ACTION: called with every mutant of a kernel: MUTANT KIND STEM TEXT.
each_kernel() {
    local kind native stem text name
    for kind in nothing sign drop; do
        case ,$kinds, in *,$kind,*) ;; *) continue ;; esac
        for native in "$build"/generated/taut/kernels/*.native.cpp; do
            stem=$(basename "$native" .native.cpp)
            # shellcheck disable=SC2053 # a pattern
            [[ $stem == $kernels ]] || continue
            for text in $(texts_of "$native"); do
                name=$stem:$kind
                # What its element adds to a method's kernel, or a shape to that of contact.
                [[ $text == *.comp ]] || name=$stem.element:$kind
                [[ $text == *.comp || $kind != nothing ]] || continue
                "$1" "$name" "$kind" "$stem" "$text"
            done
        done
    done
}

if [ -n "$stale" ]; then
    : > "$work/mutants"
    each_kernel name_stale > "$work/stale"
    awk -F, 'NR == FNR { made[$1] = 1; next } FNR > 1 && $2 != "host" && !($1 in made) { print $1 ": its kernel is no more" }' \
        "$work/mutants" "$out" >> "$work/stale"
    cat "$work/stale"
    [ ! -s "$work/stale" ]
    exit
fi
each_kernel run_mutant
case ,$kinds, in
*,host,*)
    while IFS='|' read -r name file expression; do
        case $name in '' | '#'*) continue ;; esac
        wanted "$name:host" || continue
        what=$file
        make_host "$file" "$expression"
        judge "$name:host" host
    done < "$root/tests/mutants_host.txt"
    ;;
esac
