#!/usr/bin/env bash
# A run that is killed on its way, waves in the middle of the body, and resumed
# on another number of ranks ends with the numbers of an undisturbed run.
# usage: restart.sh SIGNOTON SCENE
set -eu
signoton=$1
scene=$2
tools=$(dirname "$0")/../tools
. "$tools/shell_test.sh"

mpirun -np 2 "$signoton" "$scene" --output whole >whole.log

steps() { sed -n 's/^\([0-9]*\) accepted steps$/\1/p' "$1/numbers" 2>/dev/null || true; }
total=$(tail -1 whole/statistics.csv | cut -d, -f1)
half=$(((total + 1) / 2))
# a machine that is slow to look may find the run over: then again
for attempt in 1 2 3 4 5; do
  rm -rf killed
  "$signoton" "$scene" --output killed \
    --set 'Output/Checkpoint every=1' >killed.log 2>&1 &
  pid=$!
  while kill -0 "$pid" 2>/dev/null; do
    n=$(steps killed/checkpoint)
    [ "${n:-0}" -ge "$half" ] && break
    sleep 0.02
  done
  kill -9 "$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || true
  n=$(steps killed/checkpoint)
  echo "killed after step ${n:-0} of $total"
  [ "${n:-0}" -ge "$half" ] && [ "$n" -lt "$total" ] && break
done
[ "${n:-0}" -ge "$half" ] && [ "$n" -lt "$total" ] ||
  { cat killed.log; exit 1; }

mpirun -np 4 "$signoton" --resume killed >resumed.log ||
  { cat resumed.log; exit 1; }

"$tools/same_end.sh" whole/statistics.csv killed/statistics.csv
