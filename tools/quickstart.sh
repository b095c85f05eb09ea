#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From a fresh checkout to a first result: says how long it will take, installs missing packages, builds the program with its manual, runs
# scenarios/toy-top.json, and prints where the picture of its drift is. A second call builds nothing. Extended precision, a sixth of the
# work, is left for later, unless it has been built.
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/release/tools/earthtop/earthtop
extended=OFF
if grep -qs '^EARTHTOP_EXTENDED_PRECISION:BOOL=ON$' build/release/CMakeCache.txt; then extended=ON; fi

# Measured on an Intel Xeon, November 2026: the processor time of the build, and of it what no other core can take over: the precompiled
# header, the longest source of the core, the longest of the workbench, which waits for the core, and linking.
processor_s=335
one_after_another_s=45
if [[ ! -x $program ]]; then
  if [[ $extended == ON ]]; then processor_s=$((processor_s * 6 / 5)); fi
  cores=$(nproc)
  seconds=$(((processor_s + one_after_another_s * (cores - 1)) / cores))
  takes=$(LC_ALL=C awk "BEGIN { if ($seconds < 90) printf \"%d seconds\", int($seconds / 10 + 0.5) * 10
                       else printf \"%g minutes\", int($seconds / 30 + 0.5) / 2 }")
  echo "This takes about $takes, most of it to compile earthtop: $processor_s s of processor time, number of cores here: $cores."
fi

tools/install-dependencies.sh --program
begin=$SECONDS
cmake --preset release -DEARTHTOP_BUILD_TESTS=OFF -DEARTHTOP_PRECOMPILE_HEADERS=ON -DEARTHTOP_EXTENDED_PRECISION=$extended >/dev/null
# The build shows its progress in one line: percentage done, seconds since the beginning.
NINJA_STATUS='[%p after %e s] ' cmake --build --preset release --parallel "$(nproc)" --target component-program
echo "Built in $((SECONDS - begin)) s."
out=out/toy-top

echo
echo "\$ $program run scenarios/toy-top.json --out $out --force"
"$program" run scenarios/toy-top.json --out "$out" --force
echo
echo "The files are in $PWD/$out: $(cd "$out" && echo *)"
echo "The picture of the drift: $PWD/$out/drift.svg"
echo "To install the program: sudo cmake --install build/release; to remove it again: sudo cmake --build build/release --target uninstall"
