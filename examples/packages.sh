# shellcheck shell=bash
# Shared by examples/run.sh and tests/run.sh: the names of the packages that Taut uses (the only place
# where they are written), and the steps that both scripts take before they differ. Sourced, not run.
#
# Tried on Debian 12. Newer Debian and Ubuntu 24.04 or later have the same names, or the second one
# after a "|". ("libvolk-dev" is another project's library: it does not help.)

# shellcheck disable=SC2034  # used by the scripts that source this file
{
taut_packages_build=(g++ cmake ninja-build pkg-config libvulkan-dev libvulkan-volk-dev glslang-dev
    "spirv-tools-dev|spirv-tools" spirv-headers libglm-dev libeigen3-dev catch2 nlohmann-json3-dev
    libcli11-dev libassimp-dev libegl-dev libgl-dev libstb-dev
    libexpat1-dev libgmp-dev)
taut_packages_run=(libvulkan1 libegl1 mesa-vulkan-drivers libegl-mesa0 libgl1-mesa-dri)
taut_packages_test=(vulkan-validationlayers libvalijson-dev)
taut_packages_bench=(libviennacl-dev libbullet-dev) # rivals of taut_linear_bench and taut_bullet_bench; no script installs them
}

# A command that is already there will do, wherever it came from.
declare -A taut_command_of=([g++]=c++ [cmake]=cmake [ninja-build]=ninja [pkg-config]=pkg-config)

taut_cmake_at_least=3.22

say() { printf '%s\n' "$*" >&2; }

have_command() { command -v "$1" >/dev/null 2>&1; }

is_installed()
{
    local status
    status=$(dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null) && grep -qx installed <<<"$status"
}

# First name of "a|b" that apt could install; nothing if it knows none of them.
first_known()
{
    local name policy
    for name in ${1//|/ }; do
        policy=$(LC_ALL=C apt-cache policy "$name" 2>/dev/null) || policy=""
        if grep -q 'Candidate: [^(]' <<<"$policy"; then
            printf '%s\n' "$name"
            return 0
        fi
    done
    return 1
}

# Of the names given, those of which no alternative is installed.
missing_packages()
{
    local group name found
    for group in "$@"; do
        found=""
        if [[ -n ${taut_command_of[$group]:-} ]] && have_command "${taut_command_of[$group]}"; then
            continue
        fi
        for name in ${group//|/ }; do
            if is_installed "$name"; then found=yes; fi
        done
        if [[ -z $found ]]; then printf '%s\n' "$group"; fi
    done
}

as_root()
{
    if [[ $(id -u) -eq 0 ]]; then "$@"; else sudo "$@"; fi
}

# Installs those of the groups that apt knows; status 1 if it knows not all of them or one fails.
apt_install()
{
    local group name names=() all_known=0
    for group in "$@"; do
        if name=$(first_known "$group"); then names+=("$name"); else all_known=1; fi
    done
    if [[ ${#names[@]} -eq 0 ]]; then return 1; fi
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${names[@]}" >&2 || return 1
    return "$all_known"
}

say_what_to_install()
{
    local group names=()
    for group in "$@"; do names+=("$(first_known "$group" || printf '%s' "${group%%|*}")"); done
    say "Taut needs: CMake $taut_cmake_at_least or newer, a C++20 compiler (g++ 12, clang 14 or newer) and, as Debian names them:"
    say "    apt-get install -y --no-install-recommends ${names[*]}"
}

# ensure_packages GROUP...: installs what is missing and nothing else; without anything missing it
# touches neither apt nor the network. Status 1 (after saying what to install) where it cannot.
ensure_packages()
{
    if ! have_command dpkg-query || ! have_command apt-get; then
        say_what_to_install "$@"
        return 1
    fi
    local missing
    mapfile -t missing < <(missing_packages "$@")
    if [[ ${#missing[@]} -eq 0 ]]; then return 0; fi
    if [[ $(id -u) -ne 0 ]] && ! have_command sudo; then
        say "Some packages are missing, and installing them needs root or sudo."
        say_what_to_install "${missing[@]}"
        return 1
    fi
    say "Installing: ${missing[*]//|/ or }"
    # Missing or old package lists are the usual reason for a failure, so one is worth a fresh look.
    if apt_install "${missing[@]}"; then return 0; fi
    if as_root apt-get update >&2 && apt_install "${missing[@]}"; then return 0; fi
    mapfile -t missing < <(missing_packages "$@")
    say "These packages could not be installed: ${missing[*]//|/ or }"
    return 1
}

check_cmake()
{
    local version
    if ! have_command cmake; then
        say "taut: cmake was not found; install CMake $taut_cmake_at_least or newer."
        return 1
    fi
    version=$(cmake --version | sed -n '1s/^[^0-9]*\([0-9][0-9.]*\).*/\1/p')
    if [[ $(printf '%s\n' "$taut_cmake_at_least" "$version" | sort -V | head -n 1) != "$taut_cmake_at_least" ]]; then
        say "taut: CMake is $version, but $taut_cmake_at_least or newer is needed."
        return 1
    fi
}

job_count() { printf '%s\n' "${TAUT_JOBS:-$(nproc 2>/dev/null || echo 2)}"; }

# configure SOURCE BUILD [CMAKE ARGUMENT...]: release by default, Ninja and ccache where they are there.
configure()
{
    local source=$1 build=$2 launcher="" generator=()
    shift 2
    # A tree that was moved or copied keeps paths of its old place.
    if [[ -f $build/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$source" "$build/CMakeCache.txt"; then
        rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"
    fi
    if [[ ! -f $build/CMakeCache.txt ]] && have_command ninja; then generator=(-G Ninja); fi
    if have_command ccache; then launcher=ccache; fi
    cmake -S "$source" -B "$build" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" "$@"
}
