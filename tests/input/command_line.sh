#!/usr/bin/env bash
# What the command line answers: each call with its status, errors said once
# whatever the number of ranks, and --explain and --validate of every scene.
# usage: command_line.sh SIGNOTON SOURCE_DIRECTORY
set -eu
signoton=$1
source=$2
. "$(dirname "$0")/../tools/shell_test.sh"
scene=$source/tests/scenes/adaptive_granular.prm

expect 0 'mpirun -np N signoton' "$signoton" --help
expect 0 'deal.II' "$signoton" --version
expect 0 'set Rheology' "$signoton" --template statics
expect 0 'subsection Program' "$signoton" --template point
expect 2 'statics' "$signoton" --template statistics
expect 2 'no scene file' "$signoton"
expect 2 "unknown option '--explian'" "$signoton" --explian "$scene"
expect 2 'one of them' "$signoton" "$scene" "$scene"
expect 2 'one of them' "$signoton" --explain --validate "$scene"
expect 2 'the directory alone' "$signoton" "$scene" --resume here
expect 2 'the directory alone' "$signoton" --resume here --output there
expect 2 'cannot be opened' "$signoton" "$source/prm"
expect 2 "'--set' at the end" "$signoton" "$scene" --set
expect 2 'absent.prm' "$signoton" absent.prm
expect 2 "unknown key 'Degre'" "$signoton" "$scene" --set 'Discretization/Degre=1'
expect 2 'Discretization / Degree' "$signoton" "$scene" --set 'Discretization/Degree=7'
expect 2 '--set' "$signoton" "$scene" --set 'Discretization/Degree'
expect 2 'absent/resolved.prm' "$signoton" --resume absent
"$signoton" --template statics >template.prm
expect 0 'The scene is valid' "$signoton" --validate template.prm
expect 0 'Statistics by step' "$signoton" template.prm
expect 0 'The scene is valid' "$signoton" --validate "$scene" --set 'Discretization/Degree=1'
expect 2 'Materials' "$signoton" --validate "$scene" --set 'Materials/sand/Bulk modulus=-1'
piston=$source/prm/signoton_piston.prm
expect 0 'central differences' "$signoton" --explain "$piston"
expect 0 'generalized alpha' "$signoton" --explain "$piston" \
  --set 'Time integration/Scheme=implicit'
expect 0 "'Newton' has no effect with Analysis = dynamics, Scheme = explicit" "$signoton" \
  --validate "$piston" --set 'Newton/Tolerance=1e-9'
expect 0 'The scene is valid' "$signoton" --validate "$piston" \
  --set 'Newton/Tolerance=1e-9' --set 'Time integration/Scheme=implicit'
expect 2 'folds along its curved boundary' "$signoton" --validate \
  "$source/tests/input/mesh_folds_when_refined.prm"
"$signoton" --template point >point_template.prm
expect 0 'point.csv' "$signoton" point point_template.prm
expect 2 "'signoton point " "$signoton" "$source/prm/point/triaxial.prm"
expect 2 "'signoton " "$signoton" point "$scene"
expect 0 'closed form' "$signoton" --explain point "$source/prm/point/triaxial.prm"

for shipped in "$source"/prm/*.prm; do
  coarse=()
  [ "$(basename "$shipped")" = pulse_octant_3d.prm ] && # a million unknowns
    coarse=(--set 'Geometry/Arguments=7, 7, 7 : 0, 0, 0 : 1, 1, 1 : true')
  expect 0 'Memory forecast' "$signoton" --explain "$shipped" "${coarse[@]}"
  inertia=no
  grep -q '^ *set Analysis *= dynamics' "$shipped" && inertia=yes
  check "$shipped: --explain does not say that inertia is on: $inertia" \
    grep -q "^inertia  *$inertia  *0 " out
  expect 0 'The scene is valid' "$signoton" --validate "$shipped" "${coarse[@]}"
done

# on more ranks, one message, and the same status
expect 2 'where:' mpirun -np 2 "$signoton" "$scene" --set 'Discretization/Degree=7'
check 'two ranks have more than one message' test "$(grep -c 'where:' out)" = 1
[ "$problems" = 0 ]
