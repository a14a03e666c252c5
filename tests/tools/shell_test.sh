# What shell tests begin with: the environment of MPI, a directory of their own,
# in which they are from here on, and a count of problems,
# which the last line of a test asks for.

. "$(dirname "${BASH_SOURCE[0]}")/mpi_environment.sh"
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
problems=0

# complain WHAT: counts it, with what was printed last
complain() {
  echo "$1, but:"
  if [ -e out ]; then cat out; fi
  problems=$((problems + 1))
}

# check WHAT COMMAND...: the command has to succeed
check() {
  "${@:2}" >/dev/null 2>&1 || complain "$1"
}

# expect STATUS 'WORDS' COMMAND...: how it has to end, and what to print
expect() {
  local status=$1 words=$2 found=0
  shift 2
  timeout 300 "$@" >out 2>&1 || found=$?
  [ "$found" = "$status" ] && grep -qF -e "$words" out ||
    complain "$*: status $found, expected $status with '$words'"
}
