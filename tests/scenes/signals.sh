#!/usr/bin/env bash
# Signals end a run at its next step, with a checkpoint and status 7: to all
# ranks by way of mpirun, to one of them, to the only one. It then goes on, on
# another number of ranks, as if nothing had been. A material point keeps its
# table.
# usage: signals.sh SIGNOTON DIRECTORY_OF_SCENES
set -eum # job control: background jobs do not ignore SIGINT
signoton=$1
scenes=$2
tools=$(dirname "$0")/../tools
. "$tools/shell_test.sh"
cat >statics.prm <<'END'
subsection Geometry
  set Generator = subdivided_hyper_rectangle
  set Arguments = 8, 8 : 0, 0 : 1, 1 : true
  set Boundary names = plate: y > 0.999 && x < 0.5
end
subsection Materials
  subsection metal
    set Rheology = elastic plastic
    set Admissible set = von mises
    set Bulk modulus = 1
    set Shear modulus = 0.6
    set Shear strength = 0.01
    set Isotropic hardening modulus = 0.05
  end
end
subsection Boundaries
  subsection left
    set Symmetry = true
  end
  subsection bottom
    set Symmetry = true
  end
  subsection plate
    set Pressure = 0.03 * if(t < 0.8, t, 1.6 - t)
  end
end
subsection Load steps
  set Step size = 0.01
end
subsection Newton
  set Tolerance = 1e-12
end
subsection Output
  set Fields every = 0
end
END

# interrupted NAME SIGNAL TARGET RUN...: start a run, wait until it has taken
# some steps, send the signal, and see how it ends
interrupted() {
  local name=$1 signal=$2 target=$3 status=0 pid
  shift 3
  rm -rf "$name"
  "$@" --output "$name" >out 2>&1 &
  pid=$!
  while kill -0 "$pid" 2>/dev/null; do
    [ "$(cat "$name/statistics.csv" 2>/dev/null | wc -l)" -gt 5 ] && break
    sleep 0.02
  done
  if [ "$target" = one ]; then
    kill -"$signal" "$(pgrep -P "$pid" -f "$name" | head -1)" || true
  else
    kill -"$signal" "$pid" || true
  fi
  wait "$pid" || status=$?
  [ "$status" = 7 ] || complain "$name: status $status after SIG$signal"
  grep -q "SIG$signal ends the run" out ||
    complain "$name: SIG$signal is not named"
}

# whole NAME RUN...; same_end NAME: the run that was interrupted, resumed
whole() {
  local name=$1
  shift
  "$@" --output "$name.whole" >out 2>&1 || complain "$name fails"
}
same_end() {
  mpirun -np "$2" "$signoton" --resume "$1" >out 2>&1 ||
    complain "$1 cannot be resumed"
  "$tools/same_end.sh" "$1.whole/statistics.csv" "$1/statistics.csv" ||
    complain "$1 ends otherwise"
}

whole statics "$signoton" statics.prm
interrupted statics USR1 all mpirun -np 2 "$signoton" statics.prm
same_end statics 1

explicit=("$signoton" "$scenes/moving_mesh.prm" --set 'Time integration/Statistics every=1'
  --set 'Time integration/Snapshots=0' --set 'Output/Probe points='
  --set 'Output/Probe surfaces=')
whole explicit "${explicit[@]}"
interrupted explicit USR1 one mpirun -np 2 "${explicit[@]}"
same_end explicit 2
interrupted explicit TERM all "${explicit[@]}"

implicit=("$signoton" "$scenes/implicit_dynamics.prm" --set 'Time integration/Statistics every=1'
  --set 'Time integration/Snapshots=0' --set 'Time integration/Time step=0.02'
  --set 'Geometry/Initial refinement=1')
whole implicit "${implicit[@]}"
interrupted implicit INT all "${implicit[@]}"
same_end implicit 2

# one material point: no checkpoint, but its table
rm out
"$signoton" --template point >point.prm
"$signoton" point point.prm --set 'Time steps/Tolerance=0' \
  --set 'Time steps/Largest step=1e-6' --output point >out 2>&1 &
pid=$!
while kill -0 "$pid" 2>/dev/null && [ ! -s out ]; do sleep 0.02; done
sleep 0.2
kill -TERM "$pid" || true
status=0
wait "$pid" || status=$?
[ "$status" = 7 ] && [ "$(wc -l <point/point.csv)" -gt 2 ] ||
  complain "point: status $status"
[ "$problems" = 0 ]
