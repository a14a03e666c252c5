#!/usr/bin/env bash
# Time and memory of the shipped scenes and where the time went, as a table of
# those at rest and one of waves.
# usage: ledger.sh BUILD_DIRECTORY [RANKS [SCENE...]]
set -eu
build=$(cd "$1" && pwd)
ranks=${2:-2}
shift $(($# < 2 ? $# : 2))
prm=$(cd "$(dirname "$0")/../../prm" && pwd)
. "$(dirname "$0")/../tools/mpi_environment.sh"
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
[ $# -gt 0 ] || set -- $(cd "$prm" && ls *.prm)

# summary NAME 'COLUMN, ...': the last values of columns of the statistics, the
# largest ones of those that begin with "most"
summary() {
  awk -F, -v name="$1" -v wanted="$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) { gsub(/"/, "", $i); column[$i] = i }
              n = split(wanted, names, ", "); next }
    { for (i = 1; i <= n; ++i) {
        x = $column[names[i]]
        if (names[i] !~ /^most/ || x > value[i]) value[i] = x } }
    END { printf "`%s.prm`", name
          for (i = 1; i <= n; ++i) printf " %s", value[i]
          print "" }' "$dir/$1/statistics.csv"
}

touch "$dir/statics" "$dir/waves"
for scene in "$@"; do
  name=${scene%.prm}
  echo "$name" >&2
  mpirun -np "$ranks" "$build/signoton" "$prm/$name.prm" \
    --output "$dir/$name" >"$dir/log" 2>&1 || { cat "$dir/log"; exit 1; }
  if grep -q '"unknowns by steps"' "$dir/$name/statistics.csv"; then
    summary "$name" "unknowns, step, seconds, peak memory in MB, \
unknowns by steps, seconds of constitutive update, \
seconds of mesh and transfer, seconds of output" >>"$dir/waves"
  else
    summary "$name" "unknowns, seconds, peak memory in MB, \
most newton iterations of a solve, most linear iterations, \
seconds of constitutive update, seconds of assembly, \
seconds of preconditioner, seconds of linear solve, \
seconds of output" >>"$dir/statics"
  fi
done

if [ -s "$dir/statics" ]; then
  printf '| %-28s | %8s | %7s | %6s | %4s | %4s | %6s | %6s | %6s | %6s | %6s |\n' \
    scene unknowns seconds MB Newton linear law assembly precond. solve output
  echo '|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|'
  awk '{ printf "| %-28s | %8d | %7.1f | %6d | %4d | %4d |", \
                $1, $2, $3, $4, $5, $6
         for (i = 7; i <= 11; ++i) printf " %.0f %% |", 100 * $i / $3
         print "" }' "$dir/statics"
fi
if [ -s "$dir/waves" ]; then
  printf '| %-28s | %8s | %5s | %7s | %6s | %s | %6s | %6s | %6s |\n' \
    scene unknowns steps seconds MB 'million unknowns by steps' law mesh output
  echo '|---|--:|--:|--:|--:|--:|--:|--:|--:|'
  awk '{ printf "| %-28s | %8d | %5d | %7.1f | %6d | %.3g |", \
                $1, $2, $3, $4, $5, $6 * 1e-6
         for (i = 7; i <= 9; ++i) printf " %.0f %% |", 100 * $i / $4
         print "" }' "$dir/waves"
fi
