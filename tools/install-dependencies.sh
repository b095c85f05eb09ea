#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the packages needed to build earthtop, on Debian 12, Debian 13 or their relatives. Only missing ones are installed, so that a
# second call costs nothing.
#   tools/install-dependencies.sh [--program] [MORE_PACKAGES...]     --program: without what only tests and benchmarks need
#   tools/install-dependencies.sh --list                             prints the libraries' packages, installs nothing
set -euo pipefail

tests=(libgtest-dev libbenchmark-dev)
if [[ ${1:-} == --program ]]; then
  tests=()
  shift
fi

tools=(g++ cmake ninja-build pkg-config git)
libraries=( # zlib1g-dev: Debian's sqlite3.pc asks for it, but its package does not
  libeigen3-dev libgsl-dev nlohmann-json3-dev libcli11-dev libfmt-dev libgeographiclib-dev liberfa-dev libsleef-dev libmd-dev libsqlite3-dev zlib1g-dev libxxhash-dev
  "${tests[@]}"
)
if [[ ${1:-} == --list ]]; then
  printf '%s\n' "${libraries[@]}" libboost-dev
  exit 0
fi
packages=("${tools[@]}" "${libraries[@]}" "$@")

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "No apt-get here. earthtop needs the equivalents of these Debian packages; CMake will name what it does not find:" >&2
  echo "  ${packages[*]} libboost-dev" >&2
  exit 0
fi

is_installed() { dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
# Any Boost from 1.74 on is suitable. The -dev packages of two versions exclude each other, so an installed one is kept.
if ! is_installed 'libboost[0-9]*-dev'; then missing+=(libboost-dev); fi

if [[ ${#missing[@]} -eq 0 ]]; then exit 0; fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Packages are missing, and neither are you root nor is there sudo. Please have this run:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"

# Another process may hold a lock of the package manager: for installing, which apt-get itself waits for, or for the lists, for which
# it does not. Both are waited for, 10 minutes at most.
wait_s=${EARTHTOP_LOCK_WAIT_S:-600}
echo "If another process is using the package manager, this waits until that has ended, ${wait_s} s at most."
update() { LC_ALL=C "${as_root[@]}" apt-get -o DPkg::Lock::Timeout="$wait_s" update -q 2>&1; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
waited=0
until update >"$log"; do
  if ! grep -q 'Could not get lock' "$log" || ((waited >= wait_s)); then
    cat "$log" >&2
    exit 1
  fi
  if ((waited == 0)); then echo "Waiting: another process holds the lock of the package lists"; fi
  sleep 2
  waited=$((waited + 2))
done
cat "$log"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout="$wait_s" install -q -y --no-install-recommends "${missing[@]}"
