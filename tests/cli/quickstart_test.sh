#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tools/quickstart.sh in a clean clone of this repository: a first result, without what integrates in extended precision, which is refused
# wherever it is asked for; results that are in extended precision are read all the same. It says how long it will take, and what it leaves can
# be installed and uninstalled.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
git clone -q --no-hardlinks "$here/../.." "$clone"

# It says how long it will take before it does anything else: at first packages would be installed, which is where this copy ends.
mkdir -p "$clone/copy/tools" "$clone/copy/bin"
cp "$clone/tools/quickstart.sh" "$clone/copy/tools"
printf '#!/bin/sh\nexit 7\n' >"$clone/copy/tools/install-dependencies.sh"
printf '#!/bin/sh\necho "$CORES"\n' >"$clone/copy/bin/nproc"
chmod +x "$clone"/copy/*/*
said_for() { # CORES: the seconds that it says
  local said status=0
  said=$(CORES=$1 PATH=$clone/copy/bin:$PATH "$clone/copy/tools/quickstart.sh") || status=$?
  [[ $status -eq 7 ]] || return
  [[ $said =~ ^This\ takes\ about\ ([0-9.]+)\ (seconds|minutes),\ most\ of\ it\ to\ compile\ earthtop:\ ([0-9]+)\ s\ of\ processor\ time,\ number\ of\ cores\ here:\ $1\.$ ]] ||
    { echo "FAULT: it begins with: $said" >&2 && return 1; }
  processor_s=${BASH_REMATCH[3]}
  said_s=$(LC_ALL=C awk "BEGIN { print int(${BASH_REMATCH[1]} * (\"${BASH_REMATCH[2]}\" == \"minutes\" ? 60 : 1)) }")
}
said_for 1
[[ $((said_s - processor_s)) -le 15 && $((processor_s - said_s)) -le 15 ]] # one core does all of the work
said_for 2
[[ $said_s -ge $((processor_s / 2 - 15)) && $said_s -lt $processor_s ]]
said_for 64
[[ $said_s -ge 20 && $said_s -lt $((processor_s / 4)) ]] # the longest source takes as long as on one

take_times() { # used_s: processor time of the commands so far
  times >"$clone/times"
  used_s=$(LC_ALL=C awk 'NR == 2 { split($1, u, "[ms]"); split($2, s, "[ms]"); print int(60 * (u[1] + s[1]) + u[2] + s[2]) }' "$clone/times")
}
before=$SECONDS
take_times
used_before_s=$used_s
"$clone/tools/quickstart.sh" >"$clone/said"
cat "$clone/said"
take_times
used_s=$((used_s - used_before_s))
echo "The quick start took $((SECONDS - before)) s of wall time, $used_s s of processor time; it says $processor_s s."
head -n 1 "$clone/said" | grep -q "^This takes about .* number of cores here: $(nproc)\.$"
[[ $used_s -lt $((3 * processor_s)) && $used_s -gt $((processor_s / 3)) ]] # processors differ
[[ -s $clone/out/toy-top/drift.svg ]]
tail -n 1 "$clone/said" |
  grep -qxF "To install the program: sudo cmake --install build/release; to remove it again: sudo cmake --build build/release --target uninstall"
again=$SECONDS
"$clone/tools/quickstart.sh" >"$clone/said"
[[ $((SECONDS - again)) -lt 60 ]] # a second call builds nothing
if grep -q 'This takes about' "$clone/said"; then exit 1; fi
"$here/../package/install_test.sh" "$clone/build/release"
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

[ "$faults" -eq 0 ] && echo "ok: the quick start gives a first result, can be installed, and says how to get extended precision"
exit "$faults"
