#!/usr/bin/env bash
# Output directories: nothing of the user is deleted or overwritten, a run
# removes what runs have written and no more, and two runs do not share one.
# usage: output_directory.sh SIGNOTON SOURCE_DIRECTORY
set -eu
signoton=$1
scene=$2/tests/scenes/adaptive_granular.prm
point=$2/prm/point/triaxial.prm
. "$(dirname "$0")/../tools/shell_test.sh"
quick=(--set 'Refinement/Cycles in first step=0' --set 'Refinement/Cycles per step=0'
  --set 'Discretization/Degree=1' --set 'Output/Probe lines=0, 0.5 : 1, 0.5 : 3'
  --set 'Output/Fields every=1' --set 'Output/Checkpoint every=1')

# what only looks like results stays, run after run
mkdir -p mine/line-drawings mine/fields-of-rye mine/checkpoint.of-mine
for file in mine/line-drawings/a mine/fields-of-rye/b mine/checkpoint.of-mine/c \
  mine/line-7.txt mine/fields-notes.vtu mine/statistics.csv.bak; do
  echo 'of the user' >"$file"
done
list() { find mine -type f -exec grep -lx 'of the user' {} + | sort; }
list >before
for ranks in 2 1; do
  expect 0 'Statistics by step' mpirun -np "$ranks" "$signoton" "$scene" "${quick[@]}" --output mine
  expect 0 'Statistics by step' "$signoton" "$scene" "${quick[@]}" --output ./mine
  list >after
  check 'all files of the user are there' cmp before after
done
check 'the run on one rank has removed what two have written' \
  test ! -e mine/fields-0001.0001.vtu
check 'what a run wrote is listed' grep -qx fields-0001.vtu mine/signoton.files
expect 0 'point.csv' "$signoton" point "$point" --output mine
check 'another kind of run removes it' test ! -e mine/statistics.csv
check 'checkpoints as well' test ! -e mine/checkpoint

# a name that a run is going to use is refused
for name in statistics.csv resolved.prm fields-0003.vtu line-1.csv checkpoint; do
  mkdir other
  echo 'of the user' >"other/$name"
  expect 4 "'$name', which is not in its list" \
    mpirun -np 2 "$signoton" "$scene" "${quick[@]}" --output other
  check "$name is as it was" grep -qx 'of the user' "other/$name"
  check 'nothing else was written' test ! -e other/fields-0001.0000.vtu
  rm -r other
done
mkdir other
echo 'of the user' >other/point.csv
expect 4 "'point.csv', which is not in its list" "$signoton" point "$point" --output other

# lists may come from anywhere
echo 'of the user' >victim
mkdir tampered tampered/deep
printf '%s\n' '# a list' ../victim "$dir/victim" deep victim >tampered/signoton.files
echo 'of the user' >tampered/victim
expect 0 'Statistics by step' "$signoton" "$scene" "${quick[@]}" --output tampered
check 'no list removes what runs do not write' \
  test -e victim -a -e tampered/victim -a -d tampered/deep

mkdir strange
echo 'of the user' >strange/signoton.files
expect 4 'that no run has written' "$signoton" "$scene" "${quick[@]}" --output strange
check 'a file with the name of the list is as it was' \
  grep -qx 'of the user' strange/signoton.files

# what the user puts beside a checkpoint outlives it
echo 'of the user' >tampered/checkpoint/note
expect 2 'another end x of line 1 than before the restart' "$signoton" --resume tampered \
  --set 'Load steps/End time=1.5' --set 'Output/Probe lines=0, 0.5 : 0.9, 0.5 : 3'
# ... and numbers stay below their names where the columns are others
expect 0 "no longer 'displacement x at probe 2'" "$signoton" --resume tampered \
  --set 'Load steps/End time=1.5' --set 'Output/Probe points=0, 1' \
  --set 'Output/Probe quantities=displacement, stress'
check 'new columns are named' grep -q "new 'stress xx at probe 1'" out
check 'all lines have as many fields' \
  test "$(awk -F, '{ print NF }' tampered/statistics.csv | sort -u | wc -l)" = 1
check 'the last probe stands last, and is empty' \
  awk -F, 'NR == 1 && $NF !~ /probe 2"$/ || NR == 2 && $NF == "" { exit 1 }
           END { if ($NF != "") exit 1 }' tampered/statistics.csv
check 'the note is there after another checkpoint' test -e tampered/checkpoint/note
expect 0 'Statistics by step' "$signoton" "$scene" "${quick[@]}" --output tampered
check 'the note is there after another run' test -e tampered/checkpoint/note

# two at once
"$signoton" "$scene" --set 'Load steps/Step size=1e-3' --output shared >first 2>&1 &
pid=$!
while [ ! -s shared/statistics.csv ] && kill -0 "$pid"; do sleep 0.05; done
expect 4 "another run is writing there: process $pid on" \
  mpirun -np 2 "$signoton" "$scene" --output shared
check 'one message' test "$(grep -c 'where:' out)" = 1
expect 4 'another run is writing there' "$signoton" --resume shared
expect 4 'another run is writing there' "$signoton" point "$point" --output shared
check 'the first one goes on' kill -0 "$pid"
kill -9 "$pid"
wait "$pid" || true
expect 0 'Statistics by step' "$signoton" "$scene" "${quick[@]}" --output shared
check 'lines of one run' test "$(grep -c '^1,' shared/statistics.csv)" = 1
[ "$problems" = 0 ]
