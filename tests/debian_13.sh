#!/usr/bin/env bash
# Builds and tests the last commit on Debian 13, with its deal.II, Open MPI and
# compiler, in a directory that mmdebstrap fills from the mirror of this
# machine's own apt. It needs root, 6 GB, and the time of all tests; a second
# call finds the packages and the compiler's cache of the first.
# usage: tests/debian_13.sh [DIRECTORY [ARGUMENTS OF quickstart]]
set -euo pipefail
source=$(cd "$(dirname "$0")/.." && pwd)
root=$(realpath -m "${1:-$source/build-debian-13}")
arguments=("${@:2}")
[ ${#arguments[@]} -gt 0 ] ||
  arguments=(test -DSIGNOTON_WARNINGS_AS_ERRORS=ON -DCMAKE_UNITY_BUILD=ON)

if [ ! -x "$root/usr/bin/apt-get" ]; then
  apt-get update -qq
  command -v mmdebstrap >/dev/null || apt-get install -y -qq mmdebstrap
  mirror=$(apt-get indextargets --format '$(REPO_URI)' \
    'Identifier: Packages' 'Label: Debian' | sort -u | head -1)
  options=$(mktemp)
  apt-config dump Acquire >"$options"
  mmdebstrap --variant=minbase --aptopt="$options" trixie "$root" "$mirror"
  rm "$options"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/signoton"
git clone -q "$source" "$root/signoton"

# the mounts end with the command
unshare --mount bash -c '
  mount --bind /dev "$1/dev" && mount -t proc proc "$1/proc" &&
    mount --rbind /sys "$1/sys" &&
    cd / && exec chroot "$1" env -i HOME=/root TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin \
      /signoton/quickstart "${@:2}"' - "$root" "${arguments[@]}"
