#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds earthtop for arm64 on a machine of another kind, in build/arm64, and runs it there in qemu's emulator of that processor.
#   tools/arm64.sh           compiles the program and the gate's tests
#   tools/arm64.sh test      and runs these, but for those that take minutes in the emulator (tests/slow-in-emulator.txt)
#   tools/arm64.sh digits    and compares digits with those of build/release, as tools/determinism.sh does
# Debian's libraries for arm64 are put into build/arm64/root: nothing is installed but the compiler and the emulator.
set -euo pipefail
cd "$(dirname "$0")/.."

tools/install-dependencies.sh g++-aarch64-linux-gnu qemu-user mmdebstrap python3
build=build/arm64
root=$PWD/$build/root
if [[ ! -d $root/usr/include/eigen3 ]]; then
  mkdir -p "$build"
  libraries=$(tools/install-dependencies.sh --list | paste -sd,)
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  mmdebstrap --quiet --variant=extract --architectures=arm64 --include="libc6-dev,$libraries" "$suite" "$root"
fi

cmake --preset release -B "$build" -DCMAKE_TOOLCHAIN_FILE=tools/arm64.cmake -DEARTHTOP_ARM64_ROOT="$root" -DEARTHTOP_MPI=OFF \
  -DEARTHTOP_SUNDIALS=OFF -DEARTHTOP_PYTHON=OFF -DEARTHTOP_NIGHTLY_TESTS=OFF -DEARTHTOP_SLOW_TESTS=OFF
cmake --build "$build" --parallel "$(nproc)"

case ${1:-} in
  "") ;;
  test)
    slow=$(sed 's/#.*//; s/ *$//; /^$/d; s/[].[+*?^$()|]/\\&/g' tests/slow-in-emulator.txt | paste -sd'|')
    ctest --test-dir "$build" -L '^gate$' -E "^($slow)\$" --parallel "$(nproc)" --output-on-failure
    ;;
  digits) tools/determinism.sh --short build/release/tools/earthtop/earthtop "$build/emulated/earthtop" ;;
  *)
    echo "tools/arm64.sh: \"$1\" is neither test nor digits" >&2
    exit 2
    ;;
esac
