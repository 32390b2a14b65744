#!/bin/sh
# Writes the tables of the robustness map anew, and the page docs/results/robustness.md from them.
#   tests/hard/update_map.sh [short|full|search] [CASE]
# short: map_short.csv alone; full: map.csv and the page alone; CASE: the rows of that case alone ("G09").
# search: writes nothing, prints the cheapest settings at which cells pass that do not (TAUT_HARD_SHORT=1: those
# of the short table); for map_effort.cpp. TAUT_BUILD: the build folder, build/release by default. Say in the
# commit why rows changed.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd -P)
program=${TAUT_BUILD:-$root/build/release}/tests/test_hard
form=both
case "${1:-}" in short | full | search) form=$1; shift ;; esac
[ $# -eq 0 ] || export TAUT_MAP_ONLY="$1"
[ "$form" != search ] || exec "$program" "[.search]"
# The rows alone: the other executors and the rows that say FAIL are for the test itself.
export TAUT_MAP_UPDATE=1 TAUT_TEST_DEVICES=cpu:serial
[ "$form" = full ] || TAUT_HARD_SHORT=1 "$program" "F8: every cell*"
[ "$form" = short ] || { unset TAUT_HARD_SHORT; "$program" "F8: every cell*,F8: the page*"; }
