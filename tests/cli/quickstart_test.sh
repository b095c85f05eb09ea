#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tools/quickstart.sh in a clean clone of this repository: a first result, without what integrates in extended precision, which is refused
# wherever it is asked for; results that are in extended precision are read all the same.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
git clone -q --no-hardlinks "$here/../.." "$clone"
before=$SECONDS
"$clone/tools/quickstart.sh"
echo "The quick start took $((SECONDS - before)) s of wall time."
[[ -s $clone/out/toy-top/drift.svg ]]
again=$SECONDS
"$clone/tools/quickstart.sh" >/dev/null
[[ $((SECONDS - again)) -lt 60 ]] # a second call builds nothing
set +e

. "$here/expect.sh" "$clone/build/release/tools/earthtop/earthtop"
trap 'rm -rf "$work" "$clone"' EXIT
top=$clone/scenarios/toy-top.json
refused='is left out of this build, which computes in double alone; build all of it with "cmake --preset release && cmake --build --preset release"'

expect 0 version
on_stdout '^precisions double$'
expect 0 run "$top" --out double --set /motion/duration_s=1 --set /motion/output_step_s=0.5
for precision in long_double float128; do
  expect 2 run "$top" --out extended --set /numerics/precision=$precision
  on_stderr "/numerics/precision: \"$precision\" $refused"
  [ ! -e extended ] || fault "a refused run leaves a directory"
  expect 1 check "$top" --set /numerics/precision=$precision
  on_stderr "/numerics/precision: \"$precision\" $refused"
done
expect 2 bench "$top" --methods taylor
on_stderr "a bench compares with a reference in extended precision: \"float128\" $refused"
expect 2 verify "$clone/scenarios/hard/h03-no-earth-rate.json" # one of its criteria runs in long double
on_stderr "/criteria/2/set: makes a scenario in which /numerics/precision \"long_double\" $refused"
expect 0 verify "$clone/scenarios/hard/h05-free-body.json"
# The shipped references are of runs in extended precision.
expect 0 compare double double
expect 0 compare "$clone/tests/data/references/toy-top.json" "$clone/tests/data/references/toy-top.json"

cmake -S "$clone" --preset release >out.txt 2>err.txt
grep -q '^EARTHTOP_EXTENDED_PRECISION:BOOL=ON$' "$clone/build/release/CMakeCache.txt" || fault "the preset leaves extended precision out"

[ "$faults" -eq 0 ] && echo "ok: the quick start gives a first result, and says how to get extended precision"
exit "$faults"
