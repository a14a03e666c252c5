#!/usr/bin/env bash
# What the screen says of the boundary: sizes of its parts, contradictions,
# loads that go straight into supports, facets, the axis; where elements lock;
# and nothing where there is nothing to say.
# usage: boundary_notes.sh SIGNOTON
set -eu
signoton=$1
. "$(dirname "$0")/../tools/shell_test.sh"

cat >block.prm <<'SCENE'
subsection Geometry
  set Generator = subdivided_hyper_rectangle
  set Arguments = 4, 2 : 0, 0 : 4, 3 : true
end
subsection Materials
  subsection rock
    set Rheology = elastic
    set Young modulus = 1e9
    set Poisson ratio = 0.3
    set Density = 1000
  end
end
subsection Boundaries
  subsection left
    set Symmetry = true
  end
  subsection bottom
    set Symmetry = true
  end
end
SCENE

# notes RANKS NUMBER 'WORDS'... -- --set ...: as many notes, with these words
notes() {
  local ranks=$1 number=$2 words=()
  shift 2
  while [ "$1" != -- ]; do
    words+=("$1")
    shift
  done
  shift
  mpirun -np "$ranks" "$signoton" --validate block.prm "$@" >out 2>&1 ||
    echo 'failed' >>out
  local good=1 word
  [ "$(grep -c '  note: ' out)" = "$number" ] || good=0
  ! grep -q '^failed' out || good=0
  for word in "${words[@]}"; do
    grep -qF -e "$word" out || good=0
  done
  [ $good = 1 ] || complain "expected $number notes, and '${words[*]}', of $*"
}

y='Boundaries/top/Displacement y'
notes 1 0 'boundary: bottom 4 m, left 3 m, right 3 m, top 4 m' --
notes 2 0 'bottom 4 m' -- --set "$y=0.1*y*t" --set 'Boundaries/right/Displacement y=0.3*t*(y>2.9)'
# the value that both want at t = 0 hides nothing; one line for many points
for ranks in 1 2; do
  notes $ranks 1 "'top'" "'right'" '(4, 3)' "'right' holds" -- \
    --set 'Boundaries/right/Displacement y=0' --set "$y=0.1*t"
done
notes 1 1 "'left' holds" '(0, 3)' -- --set 'Boundaries/top/Displacement x=t'
notes 1 1 "'top' holds" '(4, 3)' -- --set 'Analysis=dynamics' \
  --set "$y=0.1*t^2" --set 'Boundaries/right/Velocity y=0.1*t*y'
notes 1 0 -- --set 'Analysis=dynamics' \
  --set "$y=0.1*t^2" --set 'Boundaries/right/Velocity y=0.2*t*y/3'
# over the 3 m of the left side, at the end
notes 2 1 'left' 'Traction' 'along the normal, up to 900 of 1500 N per metre' -- \
  --set 'Boundaries/left/Traction=300*t;400'
notes 1 0 -- --set 'Boundaries/left/Traction=0;400*t'
notes 1 1 'Pressure' '2100 of 2100 N per metre' -- \
  --set 'Boundaries/right/Displacement x=0' --set 'Boundaries/right/Pressure=700*t'
notes 1 1 'left' 'the axis of revolution needs no support' "bottom 50.27 m^2" 'right 75.4 m^2' -- \
  --set 'Embedding=axisymmetric'

# locks WORDS -- --set ...: the warning that degree 1 is too stiff, or none if
# there are no words
locks() {
  local words=$1
  shift 2
  mpirun -np 2 "$signoton" --validate block.prm "$@" >out 2>&1 ||
    complain "failed with $*"
  if [ -z "$words" ]; then
    ! grep -q 'degree 1' out || complain "a warning of $*"
  else
    grep -qF "degree 1 is too stiff in 'rock', which $words" out ||
      complain "no warning '$words' of $*"
  fi
}

nu='Materials/rock/Poisson ratio'
clay=(--set 'Materials/rock/Rheology=elastic plastic'
  --set 'Materials/rock/Admissible set=tresca'
  --set 'Materials/rock/Shear strength=1e4')
locks '' -- --set "$nu=0.47"
locks 'is nearly incompressible' -- --set "$nu=0.48"
locks 'is nearly incompressible' -- --set "$nu=0.4999" --set 'Analysis=dynamics'
locks '' -- --set "$nu=0.4999" --set 'Discretization/Degree=2'
locks 'yields' -- "${clay[@]}"
locks '' -- "${clay[@]}" --set 'Discretization/Degree=2'
locks '' -- "${clay[@]}" --set 'Analysis=dynamics'
[ "$problems" = 0 ]
