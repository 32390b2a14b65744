#!/usr/bin/env bash
# Runs tests/run.sh on another release of Debian, in a chroot: other compilers, Mesa, Eigen, volk, Catch2.
#   tests/chroot.sh SUITE [CTEST OPTION...]      SUITE: stable, testing, ...; for example: testing -R golden
# Needs root, debootstrap and a mirror of Debian (TAUT_MIRROR, http://deb.debian.org/debian); status 77 and the
# reason in the last line without. The chroot is kept in TAUT_CHROOT (build/chroot)/SUITE: 400 MB, then 3 GB
# with packages and a build. What git knows of is copied into it, so edits need no commit.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
[ $# -gt 0 ] || { sed -n '2,6p' "$0" | sed 's/^# \{0,1\}//' >&2; exit 2; }
suite=$1
shift
place=${TAUT_CHROOT:-$root/build/chroot}/$suite
mirror=${TAUT_MIRROR:-http://deb.debian.org/debian}
data=${TAUT_DATA:-$root/../shared/data}

cannot() { echo "$*" && exit 77; }

[ "$(id -u)" -eq 0 ] || cannot "a chroot needs root"
command -v debootstrap > /dev/null || cannot "debootstrap is not installed"
if [ ! -f "$place/taut/.complete" ]; then
    rm -rf --one-file-system "$place"
    mkdir -p "$place"
    debootstrap --variant=minbase "$suite" "$place" "$mirror" ||
        cannot "debootstrap could not make $suite from $mirror"
    mkdir -p "$place/taut/data"
    touch "$place/taut/.complete"
fi

mounted=()
leave() {
    for point in "${mounted[@]}"; do umount "$point" || true; done
}
trap leave EXIT
enter() { # enter OPTION... SOURCE FOLDER
    mount "${@:1:$#-1}" "$place/${!#}" || cannot "$place/${!#} cannot be mounted here"
    mounted=("$place/${!#}" "${mounted[@]}")
}
enter -t proc proc proc
enter --bind /dev dev
[ ! -d "$data" ] || enter --bind -o ro "$data" taut/data

# Only what differs is copied, with the time of now: a build there goes on where it was.
source=$place/taut/source
cd "$root"
while IFS= read -r -d '' file; do
    if [ ! -e "$file" ]; then
        rm -f "$source/$file"
    elif ! cmp -s "$file" "$source/$file"; then
        mkdir -p "$source/$(dirname "$file")"
        cp "$file" "$source/$file"
    fi
done < <(git ls-files -z --cached --others --exclude-standard)
chroot "$place" env TAUT_DATA=/taut/data TAUT_JOBS="${TAUT_JOBS:-$(nproc)}" /taut/source/tests/run.sh "$@"
