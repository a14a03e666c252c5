#!/usr/bin/env bash
# Time and memory of the shipped scenes and where the time went, as a table.
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

printf '| %-28s | %8s | %7s | %6s | %4s | %4s | %6s | %6s | %6s | %6s | %6s |\n' \
  scene unknowns seconds MB Newton linear law assembly precond. solve output
echo '|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|'
for scene in "$@"; do
  name=${scene%.prm}
  mpirun -np "$ranks" "$build/signoton" "$prm/$name.prm" \
    --output "$dir/$name" >"$dir/log" 2>&1 || { cat "$dir/log"; exit 1; }
  awk -F, -v name="$name" '
    NR == 1 { for (i = 1; i <= NF; ++i) { gsub(/"/, "", $i); column[$i] = i } next }
    {
      n = $column["most newton iterations of a solve"]
      l = $column["most linear iterations"]
      if (n > newton) newton = n
      if (l > linear) linear = l
      all = $column["seconds"]
      unknowns = $column["unknowns"]
      memory = $column["peak memory in MB"]
      law = $column["seconds of constitutive update"]
      assembly = $column["seconds of assembly"]
      amg = $column["seconds of preconditioner"]
      solve = $column["seconds of linear solve"]
      output = $column["seconds of output"]
    }
    END {
      printf "| %-28s | %8d | %7.1f | %6d | %4d | %4d |", \
        "`" name ".prm`", unknowns, all, memory, newton, linear
      printf " %.0f %% | %.0f %% | %.0f %% | %.0f %% | %.0f %% |\n", \
        100 * law / all, 100 * assembly / all, 100 * amg / all, \
        100 * solve / all, 100 * output / all
    }' "$dir/$name/statistics.csv"
done
