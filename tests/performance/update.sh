#!/usr/bin/env bash
# What an update of a material point costs, law by law: memory, time, and, if
# valgrind is there, instructions, which do not depend on a busy machine.
# usage: update.sh BUILD_DIRECTORY
set -eu
build=$(cd "$1" && pwd)
cmake --build "$build" --target update_benchmark >&2
program=$build/tests/update_benchmark
counts=$(mktemp)
trap 'rm -f "$counts"' EXIT

instructions()
{
  command -v valgrind >/dev/null || { echo "-"; return; }
  points=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null \
    --toggle-collect='*::update_points<*' "$program" "$1" "$2" 2>"$counts")
  awk -v n="$points" '/Collected/ { printf "%.0f", $NF / n }' "$counts"
}

echo "| scheme | bytes a point | ns: stress | with tangent | of elastic | with tangent | instructions: stress | with tangent |"
echo '|---|--:|--:|--:|--:|--:|--:|--:|'
"$program" | while IFS='|' read -r number name bytes stress tangent of_elastic of_elastic_tangent; do
  printf '| %s | %d | %.0f | %.0f | %.1f | %.1f | %s | %s |\n' \
    "$name" "$bytes" "$stress" "$tangent" "$of_elastic" "$of_elastic_tangent" \
    "$(instructions "$number" stress)" "$(instructions "$number" tangent)"
done
