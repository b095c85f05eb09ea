#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian packages of the last commit twice: in directories of other names and lengths, one after the other, with another time zone,
# language, umask and number of cores. They must have the same bytes. It takes twice the time of a build.
#   tests/package/reproducible_test.sh [DIR]     DIR: keeps both; default: a temporary directory
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
work=${1:-}
if [[ -z $work ]]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
first=$work/first/earthtop
second=$work/the-second-place/with/a-longer-name

packages_in() { # DIRECTORY COMMAND...: the command runs tools/package.sh
  if [[ ! -e $1 ]]; then git clone -q --no-hardlinks "$source_dir" "$1"; fi
  (cd "$1" && "${@:2}" tools/package.sh) >"$1.log" 2>&1 || { tail -n 20 "$1.log" >&2 && exit 1; }
}
umask 022
packages_in "$first" env TZ=UTC LC_ALL=C
umask 077
packages_in "$second" env TZ=Asia/Kathmandu LC_ALL=C.UTF-8 HOME="$work" taskset -c 0

status=0
for deb in "$first"/build/packages/*.deb; do
  other=$second/build/packages/${deb##*/}
  if cmp "$deb" "$other"; then
    echo "${deb##*/}: the same $(stat -c %s "$deb") bytes, SHA-256 $(sha256sum <"$deb" | cut -d ' ' -f 1)"
  else
    status=1
    if command -v diffoscope >/dev/null; then
      diffoscope --max-report-size 20000 "$deb" "$other" || true
    else # what is in them, file by file
      diff <(dpkg-deb -c "$deb") <(dpkg-deb -c "$other") || true
      diff <(dpkg-deb --ctrl-tarfile "$deb" | tar -xO ./md5sums) <(dpkg-deb --ctrl-tarfile "$other" | tar -xO ./md5sums) || true
    fi
  fi
done
exit "$status"
