#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# earthtop verify as a shell sees it.
# usage: verify_test.sh PATH_OF_EARTHTOP
set -u
# shellcheck source=tests/cli/expect.sh
. "$(dirname "$0")/expect.sh"

cat >known.json <<'END'
{ "name": "known", "site": { "latitude_deg": 45 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
            "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 1 },
  "criteria": [ { "kind": "invariant", "quantity": "jacobi_integral", "tolerance": 1e-12, "why": "exact" },
                { "kind": "refused", "set": ["/site/latitude_deg=91"], "slow": true, "why": "no such place" } ] }
END
sed 's/1e-12/1e-30/' known.json >wrong.json
sed 's/, *"criteria.*//; /"criteria"/,$d' known.json >plain.json
sed -i '$s/,$/ }/' plain.json
sed 's/"jacobi_integral"/"jacobi"/' known.json >misspelt.json
sed 's/"tolerance": 1e-12/"tolerance": 1e-12, "set": ["\/body\/mass_kg=-1"]/' known.json >unsound.json

expect 0 verify known.json
nothing_on_stderr
on_stdout '^case, criterion  *error  *bound  *cpu s$'
on_stdout '^known$'
on_stdout '^  invariant jacobi_integral .* pass$'
on_stdout 'slow: judged with --slow$'
on_stdout '^1 criteria met, 0 not met, 1 slow ones skipped'
expect 0 verify known.json --slow
on_stdout '^2 criteria met, 0 not met;'
expect 1 verify known.json wrong.json
on_stdout ' FAIL$'
on_stdout '^1 criteria met, 1 not met'
nothing_on_stderr
expect 1 verify --json wrong.json
on_stdout '"failed": 1'
on_stdout '"outcome": "fail"'
on_stdout '"outcome": "skipped"'
on_stdout '"why": "exact"'
python3 -m json.tool out.txt >/dev/null || fault "--json is no JSON"
mkdir pack empty
cp known.json pack
expect 0 verify pack
on_stdout '^known$'

# The hard cases are built into the program.
expect 0 verify --list
on_stdout '^h04-pole '
on_stdout 'invariant kovalevskaya'

# If any file is refused, nothing is run.
for arguments in missing.json "known.json plain.json" empty misspelt.json "known.json unsound.json"; do
  # shellcheck disable=SC2086
  expect 2 verify $arguments
  nothing_on_stdout
  on_stderr 'error: '
done
on_stderr '/criteria/0/set: makes a scenario in which /body/mass_kg'
expect 2 verify plain.json --json
on_stdout '"errors"'
nothing_on_stderr

# An interrupt ends it soon.
sed 's/"duration_s": 1 /"duration_s": 50000, "output_step_s": 1000 /; s/1e-12/1e-3/' known.json >long.json
sed -i 's/"motion"/"numerics": { "method": "rkf78" }, "motion"/' long.json
"$tool" verify long.json >out.txt 2>err.txt &
running=$!
sleep 1
kill -TERM "$running"
wait "$running"
status=$?
[ "$status" -eq 143 ] || fault "after SIGTERM exit status $status, not 143"
on_stderr 'interrupted'

[ "$faults" -eq 0 ] && echo "earthtop verify: all as expected"
exit "$faults"
