#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The quick start, the gate, the Debian packages and the Python package on Debian 13, as new users meet them there, and whether its
# program computes the digits of this one.
#   tests/package/debian13.sh           in a root of Debian 13 that mmdebstrap makes, in a clone of this repository. On Debian 13 itself:
#                                       here; then the digits are only hashed.
#   tests/package/debian13.sh --lacks   in a sentence what it needs and this machine has not; nothing if it can run
set -euo pipefail
cd "$(dirname "$0")/../.."
program=build/release/tools/earthtop/earthtop
mirror=http://deb.debian.org/debian

is_debian13() { [[ $(. /etc/os-release && echo "${ID:-} ${VERSION_CODENAME:-}") == "debian trixie" ]]; }

answers() { # whether the mirror does
  local release
  release=$(mktemp)
  /usr/lib/apt/apt-helper -o Acquire::Retries=0 -o Acquire::http::Timeout=30 download-file $mirror/dists/trixie/Release "$release" \
    >/dev/null 2>&1
  local status=$?
  rm -f "$release"
  return $status
}
lacks() {
  if is_debian13; then return; fi
  if ! [[ -x /usr/lib/apt/apt-helper ]]; then
    echo "Debian 13 is made here by mmdebstrap, which needs apt."
  elif [[ $(id -u) -ne 0 ]]; then
    echo "Debian 13 is made here by mmdebstrap, which needs root."
  elif ! unshare --mount true 2>/dev/null; then
    echo "Debian 13 is run here in a root of its own, which needs the right to mount."
  elif ! answers; then
    echo "Debian 13 is made here of packages from $mirror, which does not answer."
  fi
}

if [[ ${1:-} == --lacks ]]; then
  lacks
  exit
fi

if is_debian13; then
  tests/cli/quickstart_test.sh
  .ci/run gate packages python
  tools/determinism.sh --short $program | tee build/digits # which the nightly workflow compares with those of another system
  exit
fi

tools/install-dependencies.sh mmdebstrap
root=$(mktemp -d)
trap 'rm -rf --one-file-system "$root"' EXIT
chmod 755 "$root"
mmdebstrap --variant=minbase --dpkgopt=force-unsafe-io --include=ca-certificates,git trixie "$root" $mirror
git clone -q --no-hardlinks . "$root/root/earthtop"
unshare --mount --propagation private bash -euo pipefail -c '
  mount -t proc proc "$1/proc"
  mount -t sysfs sysfs "$1/sys"
  mount --rbind /dev "$1/dev"
  chroot "$1" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin /root/earthtop/tests/package/debian13.sh' bash "$root"

# The program of Debian 13 with the libraries of that, but for libquadmath, on whose version the digits of float128 depend.
tools/test.sh -N >/dev/null # builds what is not built of this system's
quadmath=$(ldd $program | awk '$1 ~ /^libquadmath/ { print $3 }')
cat >"$root/earthtop" <<END
#!/bin/sh
exec "$root/lib64/ld-linux-x86-64.so.2" --preload "$quadmath" --library-path "$root/usr/lib/x86_64-linux-gnu" \\
  "$root/root/earthtop/$program" "\$@"
END
chmod 755 "$root/earthtop"
tools/determinism.sh --short $program "$root/earthtop"
