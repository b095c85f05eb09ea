#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs jobs of the program while memory, threads or system calls fail under them, or while they are killed, and prints the matrix
# of jobs, faults and outcomes. It fails if a job ends by a signal or with a status that does not fit, if files are left, if
# results are neither the old nor the new ones, or if the same job does not succeed afterwards.
#   tools/faults.sh [BUILD] [--long | --brief] [--seed N] [--only JOB,...] [--kinds KIND,...] [--verbose]
#     BUILD: the build directory (build/release)   --long: hours   --brief: seconds   --seed: other random faults
set -euo pipefail
cd "$(dirname "$0")/.."

build=build/release
if [[ $# -gt 0 && $1 != --* ]]; then
  build=$1
  shift
fi
cmake --build "$build" --target earthtop-tool earthtop-faults >/dev/null
exec python3 tests/faults/faults.py "$build/tools/earthtop/earthtop" "$build/tests/libearthtop-faults.so" "$@"
