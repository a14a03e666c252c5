#!/usr/bin/env bash
# What the command line answers: each call with its status, errors said once
# whatever the number of ranks, and --explain and --validate of every scene.
# usage: command_line.sh SIGNOTON SOURCE_DIRECTORY
set -eu
signoton=$1
source=$2
. "$(dirname "$0")/../tools/mpi_environment.sh"
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
scene=$source/tests/scenes/adaptive_granular.prm
problems=0

# expect STATUS 'WORDS OF THE MESSAGE' ARGUMENTS...
expect() {
  local status=$1 words=$2 found=0
  shift 2
  "$signoton" "$@" >out 2>&1 || found=$?
  if [ "$found" != "$status" ] || ! grep -qF -e "$words" out; then
    echo "signoton $*: status $found, expected $status with '$words', but:"
    cat out
    problems=$((problems + 1))
  fi
}

expect 0 'mpirun -np N signoton' --help
expect 0 'deal.II' --version
expect 0 'set Rheology' --template statics
expect 0 'subsection Program' --template point
expect 2 'statics' --template statistics
expect 2 'no scene file'
expect 2 "unknown option '--explian'" --explian "$scene"
expect 2 'one of them' "$scene" "$scene"
expect 2 'one of them' --explain --validate "$scene"
expect 2 'the directory alone' "$scene" --resume here
expect 2 'the directory alone' --resume here --output there
expect 2 'cannot be opened' "$source/prm"
expect 2 "'--set' at the end" "$scene" --set
expect 2 'absent.prm' absent.prm
expect 2 "unknown key 'Degre'" "$scene" --set 'Discretization/Degre=1'
expect 2 'Discretization / Degree' "$scene" --set 'Discretization/Degree=7'
expect 2 '--set' "$scene" --set 'Discretization/Degree'
expect 2 'absent/resolved.prm' --resume absent
"$signoton" --template statics >template.prm
expect 0 'The scene is valid' --validate template.prm
expect 0 'Statistics by step' template.prm
expect 0 'The scene is valid' --validate "$scene" --set 'Discretization/Degree=1'
expect 2 'Materials' --validate "$scene" --set 'Materials/sand/Bulk modulus=-1'
piston=$source/prm/signoton_piston.prm
expect 0 'central differences' --explain "$piston"
expect 0 'generalized alpha' --explain "$piston" \
  --set 'Time integration/Scheme=implicit'
expect 0 "'Newton' has no effect with Analysis = dynamics, Scheme = explicit" \
  --validate "$piston" --set 'Newton/Tolerance=1e-9'
expect 0 'The scene is valid' --validate "$piston" \
  --set 'Newton/Tolerance=1e-9' --set 'Time integration/Scheme=implicit'
expect 2 'folds along its curved boundary' --validate \
  "$source/tests/input/mesh_folds_when_refined.prm"
"$signoton" --template point >point_template.prm
expect 0 'point.csv' point point_template.prm
expect 2 "'signoton point " "$source/prm/point/triaxial.prm"
expect 2 "'signoton " point "$scene"
expect 0 'closed form' --explain point "$source/prm/point/triaxial.prm"

for shipped in "$source"/prm/*.prm; do
  coarse=()
  [ "$(basename "$shipped")" = pulse_octant_3d.prm ] && # a million unknowns
    coarse=(--set 'Geometry/Arguments=7, 7, 7 : 0, 0, 0 : 1, 1, 1 : true')
  expect 0 'Memory forecast' --explain "$shipped" "${coarse[@]}"
  inertia=no
  grep -q '^ *set Analysis *= dynamics' "$shipped" && inertia=yes
  grep -q "^inertia  *$inertia  *0 " out || {
    echo "$shipped: --explain does not say that inertia is on: $inertia"
    problems=$((problems + 1))
  }
  expect 0 'The scene is valid' --validate "$shipped" "${coarse[@]}"
done

# on more ranks, one message, and the same status
status=0
mpirun -np 2 "$signoton" "$scene" --set 'Discretization/Degree=7' >out 2>&1 ||
  status=$?
[ "$status" = 2 ] && [ "$(grep -c 'where:' out)" = 1 ] || {
  echo "two ranks: status $status and $(grep -c 'where:' out) messages"
  problems=$((problems + 1))
}
exit "$problems"
