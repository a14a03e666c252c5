#!/usr/bin/env bash
# Names and texts of any characters, in every section, in lists, in columns, in
# paths and on the command line; what they are written to is read again. None is
# ever executed.
# usage: names.sh SIGNOTON
set -eu
signoton=$1
. "$(dirname "$0")/../tools/shell_test.sh"

says() { grep -qF -e "$1" out; }

# scene WALL GROUND GRAIN POINT FLOOR CEILING TITLE: names as they stand in a scene
scene() {
  cat <<END
set Title = $7
subsection Geometry
  set Generator = subdivided_hyper_rectangle
  set Arguments = 4, 4 : 0, 0 : 1, 1 : true
  set Boundary names = $1: x < 0.001; $5: 2; $6: 3
end
subsection Schemes
  set $3 = spring(bulk = 1, shear = 1)
end
subsection Materials
  subsection $2
    set Rheology = parallel(spring(bulk = 1, shear = 1), series($3, contact(mises schleicher, friction = 0.5)))
    set Density = 1
  end
end
subsection Boundaries
  subsection $1
    set Symmetry = true
  end
  subsection $5
    set Displacement x = 0
    set Displacement y = 0
  end
  subsection $6
    set Pressure = 1e-3*t
  end
end
subsection Point forces
  subsection $4
    set Point = 0.5, 1
    set Force = 0; -1e-3*t
  end
end
subsection Output
  set Probe surfaces = $6, $1
  set Probe quantities = displacement
  set Checkpoint every = 1
end
END
}

# the last row of the statistics, but for seconds and memory
numbers() {
  local n
  n=$(head -1 "$1/statistics.csv" | sed 's/,"seconds".*//' | grep -o '","' | wc -l)
  tail -1 "$1/statistics.csv" | cut -d, -f "1-$((n + 1))"
}

names=(left_wall '_a_b' 'left wall' '"a # b"' '"a: b; c, d = e"' 'grüße_Δ'
  $'wei\xdf' '"say ""no"""' '"back\"' "it's" 'value' '100%' '"a/b (c)"' '"$(touch x)"')
n=${#names[@]}
for ((i = 0; i < n; ++i)); do
  at() { echo "${names[$(((i + $1) % n))]}"; }
  scene "$(at 0)" "$(at 1)" "$(at 2)" "$(at 3)" "$(at 4)" "$(at 5)" "$(at 6)" >scene.prm
  place="results of $i; #, ü_ab \$(touch x) it's"
  expect 0 'Statistics by step' "$signoton" scene.prm --output "$place"
  # the resolved scene is the same one
  expect 0 'Statistics by step' "$signoton" "$place/resolved.prm" --output again
  check "resolved.prm of names $i has other numbers" \
    [ "$(numbers "$place")" = "$(numbers again)" ]
  for k in 0 5; do # columns have the names, quotes doubled as everywhere
    plain=$(at $k | sed 's/^"\(.*\)"$/\1/')
    check "no column of $plain" grep -qF -e "displacement x at $plain\"" "$place/statistics.csv"
  done
done
check 'a name was executed' [ ! -e x ]

# quotes on the command line; a constant of several
scene '"top / left = a"' sand grain here bottom top plain >scene.prm
"$signoton" --validate scene.prm --set 'Boundaries/"top / left = a"/Symmetry=nonsense' >out 2>&1 || true
check 'quotes of --set are not read' says "'nonsense'"
"$signoton" --validate scene.prm --set 'Title=a # b' >out 2>&1 || true
check "'#' in --set is not answered" says 'double quotes'
sed -i '1i subsection Loads\n set Constants = a = 1, b = 2, c = 3\n set Gravity = 0; -1e-4*(a + 10*b + 100*c)\nend' scene.prm
"$signoton" scene.prm --output whole --set 'Loads/Constants=a = 4, b = 5, c = 3' >out 2>&1
"$signoton" scene.prm --output merged --set 'Loads/Constants=b = 5, a = 4' >out 2>&1
"$signoton" scene.prm --output single --set 'Loads/Constants/a=4' --set 'Loads/Constants/b=5' >out 2>&1
check 'merged constants' [ "$(numbers whole)" = "$(numbers merged)" ]
check 'single constants' [ "$(numbers whole)" = "$(numbers single)" ]

# how a file may begin and end, and what it may not have
scene left_wall sand grain here bottom top plain >scene.prm
{ printf '\xef\xbb\xbf'; cat scene.prm; } >bom.prm
sed 's/$/\r/' scene.prm >windows.prm
tr '\n' '\r' <scene.prm >old_mac.prm
for file in bom windows old_mac; do
  "$signoton" --validate $file.prm >out 2>&1 || true
  check "$file is not read" says 'The scene is valid'
done
{ cat scene.prm; printf 'set Embedding = \0plane strain\n'; } >nul.prm
status=0
"$signoton" nul.prm >out 2>&1 || status=$?
check 'NUL' [ $status = 2 ]
check 'NUL' says 'a NUL byte'
check 'NUL' says ", line $(wc -l <nul.prm)"

# a title with commands for gnuplot and the shell, and a line of samples
cat >point.prm <<'END'
set Title = ' ; system "touch x" # `touch x`
subsection Materials
  subsection sand
    set Rheology = elastic
    set Bulk modulus = 1
    set Shear modulus = 1
  end
end
subsection Program
  set Kind = oedometer
  set Strain = -1e-3*t
end
END
for title in $'a\nsystem "touch x"' $'\'\n!touch x\n' '`touch x`' "'; system('touch x') #"; do
  "$signoton" point point.prm --output "point ' results" --set "Title=${title//#/}" >out 2>&1 || cat out
  check 'a title was executed' [ ! -e x ]
  if command -v gnuplot >/dev/null; then
    check "no diagram with title $title" [ -s "point ' results/point.svg" ]
  fi
  rm -rf "point ' results"
done
status=0
"$signoton" point point.prm --output $'a\nb' >out 2>&1 || status=$?
check 'a line break in a directory' [ $status = 2 ]
check 'a line break in a directory' says 'a line break'

# a scene that only the first rank has, and one that no rank has
mpirun -np 2 "$signoton" --validate /dev/stdin <scene.prm >out 2>&1 || true
check 'a scene from standard input, two ranks' says 'The scene is valid'
mkdir empty
# as_ranks COMMAND OTHER: the first rank runs COMMAND, the second OTHER; the
# mpirun of Open MPI 5.0.7 has a segmentation fault when it is given two programs
as_ranks() {
  status=0
  timeout 60 mpirun -np 2 bash -c \
    'if [ "$OMPI_COMM_WORLD_RANK" = 0 ]; then eval "$1"; else eval "$2"; fi' \
    - "$1" "$2" >out 2>&1 || status=$?
}
validate="exec '$signoton' --validate scene.prm"
as_ranks "$validate" "cd empty; $validate"
check 'a scene that the second rank has not' [ $status = 0 ]
as_ranks "cd empty; $validate" "$validate"
check 'a scene that the first rank has not' [ $status = 2 ]
check 'one message' [ "$(grep -c where: out)" = 1 ]

# an error that one rank has alone ends all, soon
run="exec '$signoton' scene.prm --output lone"
as_ranks "$run" "$run --set Nonsense=1"
check 'an error of the second rank' [ $status = 2 ]
check 'an error of the second rank' says 'On rank 1 alone'
check 'one message' [ "$(grep -c where: out)" = 1 ]
[ "$problems" = 0 ]
