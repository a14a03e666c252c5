#!/usr/bin/env bash
# The BLAS that a machine chooses: --version names it, a factorization by the
# reference one says so once, and threads are not multiplied by ranks unless
# the environment asks for it.
# usage: blas.sh SIGNOTON
set -eu
signoton=$1
. "$(dirname "$0")/../tools/shell_test.sh"

# libraries that take the place of the machine's: the reference, which Debian
# has in any case, and one that tells what it is asked
for place in /usr/lib/*/blas /usr/lib64 /usr/lib; do
  reference=$place/libblas.so.3
  [ -e "$reference" ] && break
done
check "the reference BLAS is not at $reference" test -e "$reference"
cat >threads.c <<'EOF'
#include <stdio.h>
void openblas_set_num_threads(int n) { fprintf(stderr, "threads %d\n", n); }
EOF
gcc -shared -fPIC threads.c -o threads.so

cat >block.prm <<'EOF'
subsection Geometry
  set Generator = subdivided_hyper_rectangle
  set Arguments = 75, 75 : 0, 0 : 1, 1 : true
end
subsection Materials
  subsection rock
    set Rheology      = elastic
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
end
subsection Boundaries
  subsection bottom
    set Displacement x = 0
    set Displacement y = 0
  end
  subsection top
    set Pressure = 1e-3*t
  end
end
subsection Load steps
  set Step size = 0.5
end
EOF
LD_PRELOAD=$reference mpirun -np 2 "$signoton" block.prm --output slow_run >slow
check 'no warning, or many' test "$(grep -c 'reference BLAS' slow)" = 1
LD_PRELOAD=$reference "$signoton" --version >slow_version
check '--version is silent of the reference' grep -q 'reference BLAS' slow_version

"$signoton" --version >version
check '--version is silent of the BLAS' grep -q BLAS version
if ! grep -q 'reference' version; then
  "$signoton" block.prm --output fast_run >fast
  check 'a fast one is warned of' test "$(grep -c 'reference BLAS' fast)" = 0
fi

(
  unset OPENBLAS_NUM_THREADS GOTO_NUM_THREADS OMP_NUM_THREADS
  LD_PRELOAD=./threads.so "$signoton" --version 2>one >/dev/null
  OPENBLAS_NUM_THREADS=2 LD_PRELOAD=./threads.so "$signoton" --version 2>wish >/dev/null
)
check 'more than one thread' grep -qx 'threads 1' one
check 'a wish for threads was overridden' test ! -s wish
[ "$problems" = 0 ]
