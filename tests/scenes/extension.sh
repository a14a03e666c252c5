#!/usr/bin/env bash
# A run to half of the time, resumed to the whole on another number of ranks,
# ends with the numbers of a run to the whole: steps, mesh, snapshots, lines and
# receipt. The sizes of the steps have to fit into both halves.
# usage: extension.sh SIGNOTON SCENE SECTION HALF WHOLE [--set ...]
set -eu
signoton=$1 scene=$2 section=$3 half=$4 whole=$5
shift 5
tools=$(dirname "$0")/../tools
. "$tools/shell_test.sh"
fail() {
  echo "$1"
  cat log
  exit 1
}
dynamics=()
[ "$section" = 'Time integration' ] &&
  dynamics=(--set 'Time integration/Snapshots=4' --set 'Output/Probe line samples=4')

mpirun -np 2 "$signoton" "$scene" "$@" --output whole "${dynamics[@]}" \
  --set "$section/End time=$whole" --set 'Output/Probe lines=0.1, 0.1 : 0.4, 0.4 : 3' >log
"$signoton" "$scene" "$@" --output half "${dynamics[@]}" \
  --set "$section/End time=$half" --set 'Output/Probe lines=0.1, 0.1 : 0.4, 0.4 : 3' \
  --set 'Output/Checkpoint every=1000000' >log

# the end is reached: nothing is done, and how to go on is said
cp half/statistics.csv before.csv
mpirun -np 2 "$signoton" --resume half >log 2>&1 ||
  fail 'a run that is finished cannot be resumed'
grep -q 'The run is finished' log &&
  grep -qF -e "--set '$section/End time=" log ||
  fail 'a run that is finished does not say so'
cmp half/statistics.csv before.csv

mpirun -np 2 "$signoton" --resume half --set "$section/End time=$whole" \
  >log 2>&1 || fail 'the run cannot be extended'
"$tools/same_end.sh" whole/statistics.csv half/statistics.csv

# the second half has what the run to the whole has there
later() { awk -F, -v t="$half" '$1 + 0 > t * 1.0001 { ++n } END { print n + 0 }' "$1"; }
[ "$(later whole/line-1.csv)" -gt 0 ] &&
  [ "$(later whole/line-1.csv)" = "$(later half/line-1.csv)" ] ||
  fail 'the lines miss samples after the restart'
snapshots() {
  { sed -n 's/.*timestep="\([^"]*\)".*/\1/p' "$1/fields.pvd" 2>/dev/null || true; } |
    awk -v t="$half" '$1 > t * 1.0001 { ++n } END { print n + 0 }'
}
[ "$(snapshots whole)" = "$(snapshots half)" ] ||
  fail 'snapshots are missing after the restart'
