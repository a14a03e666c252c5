#!/usr/bin/env bash
# A run to half of the time, resumed to the whole on another number of ranks,
# ends with the numbers of a run to the whole: steps, mesh, snapshots, lines and
# receipt. The sizes of the steps have to fit into both halves.
# usage: extension.sh SIGNOTON SCENE SECTION HALF WHOLE [--set ...]
set -eu
signoton=$1 scene=$2 section=$3 half=$4 whole=$5
shift 5
tools=$(dirname "$0")/../tools
. "$tools/mpi_environment.sh"
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() {
  echo "$1"
  cat "$dir/log"
  exit 1
}
dynamics=()
[ "$section" = 'Time integration' ] &&
  dynamics=(--set 'Time integration/Snapshots=4' --set 'Output/Probe line samples=4')

mpirun -np 2 "$signoton" "$scene" "$@" --output "$dir/whole" "${dynamics[@]}" \
  --set "$section/End time=$whole" --set 'Output/Probe lines=0.1, 0.1 : 0.4, 0.4 : 3' >"$dir/log"
"$signoton" "$scene" "$@" --output "$dir/half" "${dynamics[@]}" \
  --set "$section/End time=$half" --set 'Output/Probe lines=0.1, 0.1 : 0.4, 0.4 : 3' \
  --set 'Output/Checkpoint every=1000000' >"$dir/log"

# the end is reached: nothing is done, and how to go on is said
cp "$dir/half/statistics.csv" "$dir/before.csv"
mpirun -np 2 "$signoton" --resume "$dir/half" >"$dir/log" 2>&1 ||
  fail 'a run that is finished cannot be resumed'
grep -q 'The run is finished' "$dir/log" &&
  grep -qF -e "--set '$section/End time=" "$dir/log" ||
  fail 'a run that is finished does not say so'
cmp "$dir/half/statistics.csv" "$dir/before.csv"

mpirun -np 2 "$signoton" --resume "$dir/half" --set "$section/End time=$whole" \
  >"$dir/log" 2>&1 || fail 'the run cannot be extended'
"$tools/same_end.sh" "$dir/whole/statistics.csv" "$dir/half/statistics.csv"

# the second half has what the run to the whole has there
later() { awk -F, -v t="$half" '$1 + 0 > t * 1.0001 { ++n } END { print n + 0 }' "$1"; }
[ "$(later "$dir/whole/line-1.csv")" -gt 0 ] &&
  [ "$(later "$dir/whole/line-1.csv")" = "$(later "$dir/half/line-1.csv")" ] ||
  fail 'the lines miss samples after the restart'
snapshots() {
  { sed -n 's/.*timestep="\([^"]*\)".*/\1/p' "$1/fields.pvd" 2>/dev/null || true; } |
    awk -v t="$half" '$1 > t * 1.0001 { ++n } END { print n + 0 }'
}
[ "$(snapshots "$dir/whole")" = "$(snapshots "$dir/half")" ] ||
  fail 'snapshots are missing after the restart'
