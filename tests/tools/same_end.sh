#!/usr/bin/env bash
# Whether two runs end alike: the last lines of their statistics, column by
# column, but for what is no physics.
# usage: same_end.sh STATISTICS STATISTICS [TOLERANCE]
set -eu
paste -d '\n' <(head -1 "$1") <(tail -1 "$1") <(head -1 "$2") <(tail -1 "$2") |
  awk -F, -v tolerance="${3:-1e-8}" '
    NR == 1 { for (i = 1; i <= NF; ++i) name[i] = $i; n = NF }
    NR == 2 { for (i = 1; i <= n; ++i) expected[name[i]] = $i }
    NR == 3 { for (i = 1; i <= NF; ++i) other[i] = $i; n_other = NF }
    NR == 4 {
      for (i = 1; i <= n_other; ++i) found[other[i]] = $i
      for (i = 1; i <= n; ++i) {
        if (name[i] ~ /iterations|seconds|memory|quiet|residual|drift|estimated|regularization/)
          continue
        a = expected[name[i]]; b = found[name[i]]
        scale = a < 0 ? -a : a
        if (scale < 1e-7) scale = 1e-7
        if (name[i] ~ /gap/) scale = 1 # relative already
        d = (b - a) / scale
        if (d < 0) d = -d
        ++compared
        if (b == "" || d > tolerance + 0) {
          print "differs:", name[i], a, b
          bad = 1
        }
      }
    }
    END { print compared + 0 " columns compared"; exit bad || compared < 10 }'
