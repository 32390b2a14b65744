#!/usr/bin/env bash
# Builds Taut and simulates a scene; installs what is missing first (Debian, Ubuntu).
#   examples/run.sh                          the default scene: cloth over a sphere
#   examples/run.sh SCENE.json [OPTION...]   another scene; options go to `taut run`
# Meshes, report and picture are written to out/<scene> unless --out says otherwise.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
# shellcheck source-path=SCRIPTDIR source=packages.sh
source "$root/examples/packages.sh"
build=$root/build/release

scene=$root/examples/scenes/drape.json
if [[ $# -gt 0 && $1 != -* ]]; then
    scene=$1
    shift
fi
if [[ ! -f $scene ]]; then
    say "taut: there is no scene file $scene."
    exit 2
fi
name=$(basename "$scene" .json)
out=$root/out/$name
for argument in "$@"; do
    if [[ $argument == --out || $argument == --out=* ]]; then out=""; fi
done

ensure_packages "${taut_packages_build[@]}" "${taut_packages_run[@]}" || say "Going on with what is there."
check_cmake
# Only the program, so that a first look takes the shortest way. The log goes to standard error: what
# `taut run --json` prints must stay one JSON object.
configure "$root" "$build" >&2
cmake --build "$build" --target taut-cli --parallel "$(job_count)" >&2

if [[ -n $out ]]; then set -- --out "$out" "$@"; fi
exec "$build/taut" run "$scene" "$@"
