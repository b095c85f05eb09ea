#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From a fresh checkout to a first result: installs missing packages, builds only the program, runs scenarios/toy-top.json, and
# prints where the picture of its drift is. A second call builds nothing. Extended precision, a fifth of the work, is left for later, unless
# it has been built.
set -euo pipefail
cd "$(dirname "$0")/.."

tools/install-dependencies.sh --program
begin=$SECONDS
extended=OFF
if grep -qs '^EARTHTOP_EXTENDED_PRECISION:BOOL=ON$' build/release/CMakeCache.txt; then extended=ON; fi
cmake --preset release -DEARTHTOP_BUILD_TESTS=OFF -DEARTHTOP_PRECOMPILE_HEADERS=ON -DEARTHTOP_EXTENDED_PRECISION=$extended >/dev/null
echo "Building earthtop; the first time takes some minutes."
# The build shows its progress in one line: percentage done, seconds since the beginning.
NINJA_STATUS='[%p after %e s] ' cmake --build --preset release --parallel "$(nproc)" --target earthtop-tool
echo "Built in $((SECONDS - begin)) s."
program=build/release/tools/earthtop/earthtop
out=out/toy-top

echo
echo "\$ $program run scenarios/toy-top.json --out $out --force"
"$program" run scenarios/toy-top.json --out "$out" --force
echo
echo "The files are in $PWD/$out: $(cd "$out" && echo *)"
echo "The picture of the drift: $PWD/$out/drift.svg"
