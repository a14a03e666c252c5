#!/usr/bin/env bash
# What binders bear of the reactions is said: of two columns side by side, pulled
# apart, one of springs and one of open grains with a binder of a part of them;
# all of it where there are grains alone; nothing where they are pressed, or where
# the binder is weak.
# usage: binders.sh SIGNOTON
set -eu
signoton=$1
. "$(dirname "$0")/../tools/shell_test.sh"

cat >columns.prm <<'SCENE'
subsection Geometry
  set Generator = subdivided_hyper_rectangle
  set Arguments = 2, 2 : 0, 0 : 2, 1 : true
  set Material ids = 1: x > 1
end
subsection Materials
  subsection grains
    set Rheology = elastic granular
    set Admissible set = no tension
    set Young modulus = 1
    set Poisson ratio = 0
    set Binder = proportional
    set Binder ratio = 0.1
  end
  subsection rock
    set Material id = 1
    set Young modulus = 1
    set Poisson ratio = 0
    set Rheology = elastic
  end
end
subsection Boundaries
  subsection bottom
    set Displacement y = 0
  end
  subsection top
    set Displacement y = 0.01*t
  end
  subsection left
    set Symmetry = true
  end
  subsection right
    set Symmetry = true
  end
end
SCENE
sed 's/= 2, 2 : 0, 0 : 2, 1 :/= 2, 1, 2 : 0, 0, 0 : 2, 1, 1 :/
  s/Displacement y/Displacement z/
  s/^  subsection left/  subsection front\n    set Symmetry = true\n  end\n&/
  1i set Dimension = 3' columns.prm >solid.prm

# says RANKS FILE PERCENT ...: of both ends; nothing at all if it is 'nothing'
says() {
  local ranks=$1 file=$2 percent=$3
  shift 3
  rm -rf results
  mpirun -np "$ranks" "$signoton" "$file" --output results "$@" >out 2>&1 ||
    complain "failed with $*"
  if [ "$percent" = nothing ]; then
    ! grep -q 'binders bear' out || complain "expected nothing of $file $*"
    return
  fi
  for end in bottom top; do
    grep -q "binders bear $percent % of the reaction of '$end'" out ||
      complain "expected $percent % of $end, of $file $*"
  done
}

# k/(1 + k) with k the ratio
for ranks in 1 2 4; do
  says $ranks columns.prm 9.09
done
says 2 solid.prm 9.09
says 1 columns.prm nothing --set 'Boundaries/top/Displacement y=-0.01*t'
says 1 columns.prm nothing --set 'Materials/grains/Binder ratio=0.03'
says 1 columns.prm 3.38 --set 'Materials/grains/Binder ratio=0.035'
# grains alone, and such that yield in both ways
sed '/subsection rock/,/^  end/d; /Material ids/d' columns.prm >grains.prm
says 1 grains.prm 100
for flow in series conditional; do
  says 1 grains.prm 100 --set 'Materials/grains/Rheology=elastic plastic granular' \
    --set "Materials/grains/Plastic flow=$flow" \
    --set 'Materials/grains/Admissible set=mises schleicher' \
    --set 'Materials/grains/Friction parameter=0.5' \
    --set 'Materials/grains/Shear strength=1e-4'
done
[ "$problems" = 0 ]
