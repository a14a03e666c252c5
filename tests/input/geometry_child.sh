#!/usr/bin/env bash
# A .geo file acts on nothing, however the program is called, unless it is
# told to trust it: hostile ones are answered with status 2 and one message.
# usage: geometry_child.sh SIGNOTON
set -eu
signoton=$1
. "$(dirname "$0")/../tools/shell_test.sh"

square='n = 2;
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = n + 1; Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("base") = {1}; Physical Surface("body", 1) = {1};'
hostile="SystemCall \"touch $dir/made\"; NonBlockingSystemCall \"touch $dir/made\";
Printf(\"x\") > \"$dir/made\"; Save \"made.msh\";"
cat >scene.prm <<END
subsection Geometry
  set Mesh file = try.geo
end
subsection Materials
  subsection stone
    set Material id   = 1
    set Rheology      = elastic
    set Young modulus = 1e6
  end
end
subsection Boundaries
  subsection base
    set Displacement x = 0
    set Displacement y = 0
  end
  subsection unnamed
    set Pressure = 1*t
  end
end
subsection Output
  set Checkpoint every = 1
end
END

nothing_made() {
  sleep 0.2 # whatever may run in the background
  check "$1: a geometry wrote a file" test ! -e made -a ! -e made.msh
  rm -f made made.msh
}

echo "$square" >try.geo
expect 0 "6 faces of the boundary belong to no group, they are called 'unnamed'" \
  "$signoton" scene.prm --output kept
{ echo "$hostile"; echo "$square"; } >try.geo
for action in --validate --explain ""; do
  expect 2 'try.geo' "$signoton" $action scene.prm
  nothing_made "signoton $action"
done
expect 2 'try.geo' "$signoton" --resume kept
nothing_made --resume
expect 2 'try.geo' mpirun -np 2 "$signoton" --validate scene.prm
check 'two ranks have more than one message' test "$(grep -c 'where:' out)" = 1
nothing_made 'two ranks'
{ echo "SystemCall \"touch $dir/made\";"; echo "$square"; } >try.geo
expect 0 'The scene is valid' "$signoton" --trust-geometry --validate scene.prm
check '--trust-geometry: the geometry executed nothing' test -e made
rm -f made

{ echo 'Exit;'; echo "$square"; } >try.geo
expect 2 'it ended without a result' mpirun -np 2 "$signoton" --validate scene.prm
printf 'For i In {0:1e15}\n x = i;\nEndFor\n' >try.geo
expect 2 'more than 0.5 s' "$signoton" --validate scene.prm \
  --set 'Geometry/Meshing time limit=0.5'
echo "${square/n = 2/n = 20000}" >try.geo
expect 2 'more than 0.1 GB' "$signoton" --validate scene.prm \
  --set 'Geometry/Meshing memory limit=0.1'
expect 2 'no such file' mpirun -np 2 "$signoton" --validate scene.prm \
  --set 'Geometry/Mesh file=nowhere.msh'
expect 2 'no file' "$signoton" --validate scene.prm --set 'Geometry/Mesh file=.'
expect 2 'no file' "$signoton" --validate scene.prm \
  --set 'Geometry/Mesh file=/dev/zero'
[ "$problems" = 0 ]
