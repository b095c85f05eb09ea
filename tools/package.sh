#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes Debian packages of the program, the library and the Python package, in build/packages: earthtop, libearthtop-dev and
# python3-earthtop.
#   tools/package.sh [BUILD]
# BUILD: a release build of this checkout, whose objects are used, with its choice of MPI and SUNDIALS. If it is not given, one
# is made in build/packages/objects, without MPI and SUNDIALS: a program that runs on one machine should not need them.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=build/packages
objects=${1:-}
tools/install-dependencies.sh python3-dev pybind11-dev python3-numpy python3-setuptools python3-wheel

# Same commit, same libraries, same bytes, whenever, wherever and by whomever they are made: a package keeps times and permissions. Outside
# git the time is that of the newest release.
umask 022
if [[ -z ${SOURCE_DATE_EPOCH:-} ]]; then
  released=$(sed -n 's/^## \[[0-9.]*\] - //p' .github/CHANGELOG.md | head -n 1)
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || date --date="$released 12:00 UTC" +%s)
fi
export SOURCE_DATE_EPOCH

# Debian packages put some files in other places than an installation below /usr/local.
places=(-DCMAKE_INSTALL_LIBDIR="lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)" -DEARTHTOP_ZSH_DIR=share/zsh/vendor-completions)
places+=(-DEARTHTOP_PYTHON=ON)
if [[ -n $objects ]]; then
  cmake -S . -B "$objects" "${places[@]}"
else
  objects=$packages/objects
  cmake --preset release -B "$objects" -DEARTHTOP_BUILD_TESTS=OFF -DEARTHTOP_MPI=OFF -DEARTHTOP_SUNDIALS=OFF "${places[@]}"
fi
cmake --build "$objects" --parallel "$(nproc)" --target packaged

rm -f "$packages"/*.deb
cpack --config "$objects/CPackConfig.cmake" -B "$packages"
rm -rf "$packages/_CPack_Packages"
ls -l "$packages"/*.deb
