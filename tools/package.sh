#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes Debian packages of the program and of the library, in build/packages: earthtop and libearthtop-dev.
#   tools/package.sh [BUILD]
# BUILD: a release build of this checkout, whose objects are used, with its choice of MPI and SUNDIALS. If it is not given, one
# is made in build/packages/objects, without MPI and SUNDIALS: a program that runs on one machine should not need them.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=build/packages
objects=${1:-}
tools/install-dependencies.sh

# Debian packages put some files in other places than an installation below /usr/local.
places=(-DCMAKE_INSTALL_LIBDIR="lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)" -DEARTHTOP_ZSH_DIR=share/zsh/vendor-completions)
if [[ -n $objects ]]; then
  cmake -S . -B "$objects" "${places[@]}"
else
  objects=$packages/objects
  cmake --preset release -B "$objects" -DEARTHTOP_BUILD_TESTS=OFF -DEARTHTOP_MPI=OFF -DEARTHTOP_SUNDIALS=OFF "${places[@]}"
fi
cmake --build "$objects" --parallel "$(nproc)" --target packaged

rm -f "$packages"/*.deb
if SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null); then export SOURCE_DATE_EPOCH; fi # same commit, same package
cpack --config "$objects/CPackConfig.cmake" -B "$packages"
rm -rf "$packages/_CPack_Packages"
ls -l "$packages"/*.deb
