#!/usr/bin/env bash
# What the screen says of steps: implicit ones that ripple, energy that steps
# gain or lose; and nothing where there is nothing to say.
# usage: dynamics_warnings.sh SIGNOTON
set -eu
signoton=$1
. "$(dirname "$0")/../tools/shell_test.sh"

# falls through a gap, a tenth of its height
cat >column.prm <<'SCENE'
set Analysis = dynamics
subsection Geometry
  set Generator = subdivided_hyper_rectangle
  set Arguments = 1, 10 : 0, 0 : 0.1, 1 : true
end
subsection Materials
  subsection grains
    set Rheology = elastic granular
    set Admissible set = no tension
    set Young modulus = 4e4
    set Poisson ratio = 0
    set Density = 1
  end
end
subsection Loads
  set Gravity = 0; -1
end
subsection Boundaries
  subsection left
    set Symmetry = true
  end
  subsection right
    set Symmetry = true
  end
  subsection bottom
    set Symmetry = true
  end
end
subsection Initial state
  set Strain = 0; (y < 0.1); 0; 0
end
subsection Time integration
  set End time = 0.6
  set Snapshots = 0
end
SCENE

# warns NUMBER 'WORDS' --set ...: so many warnings, with these words
warns() {
  local number=$1 words=$2
  shift 2
  rm -rf results
  mpirun -np 2 "$signoton" column.prm --output results "$@" >out 2>&1 ||
    complain "failed with $*"
  [ "$(grep -c '  warning: ' out)" = "$number" ] && grep -qF -e "$words" out ||
    complain "expected $number warnings, and '$words', of $*"
}

implicit=(--set 'Time integration/Scheme=implicit' --set 'Initial state/Strain='
  --set 'Time integration/End time=0.02')
warns 0 'Steps of' --set 'Time integration/Statistics every=100'
warns 1 'lost by time stepping' --set 'Initial state/Strain=0; 0.1; 0; 0' \
  --set 'Time integration/Linear shock viscosity=0' \
  --set 'Time integration/Quadratic shock viscosity=0' \
  --set 'Time integration/Statistics every=100'
warns 1 'at a spectral radius of 1' "${implicit[@]}" \
  --set 'Time integration/Spectral radius=1' --set 'Time integration/Time step=2e-3'
warns 0 'Steps of' "${implicit[@]}" \
  --set 'Time integration/Spectral radius=1' --set 'Time integration/Time step=2e-4'
warns 0 'Steps of' "${implicit[@]}" --set 'Time integration/Time step=2e-3'
[ "$problems" = 0 ]
