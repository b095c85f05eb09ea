#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `earthtop bench` as a shell sees it: exit statuses, tables, files.
# usage: bench_test.sh PATH_OF_EARTHTOP
set -u
# shellcheck source=tests/cli/expect.sh
. "$(dirname "$0")/expect.sh"

cat >top.json <<'END'
{ "name": "bench-top", "site": { "latitude_deg": 45, "gravity_m_s2": 9.8 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
            "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 0.05 } }
END
sed 's/bench-top/other-top/; s/"latitude_deg": 45/"latitude_deg": -90/; s/"spin_rad_s"/"rates_relative_to": "inertial", "spin_rad_s"/' \
  top.json >other.json
sed 's/"tilt_deg"/"tilt_degrees"/' top.json >faulty.json
few="--methods auto,rkf78,gsl_rk8pd --repetitions 1 --limit 0.03 --reference-limit 1e-3 --duration 0.05"

# Refused: nothing is computed, printed or written.
for arguments in "" "missing.json" "top.json faulty.json --out written" "top.json --methods euler" "top.json --workload spin" \
  "top.json --duration -1" "top.json --duration nan" "top.json --repetitions 0" "top.json --limit 0" \
  "top.json --workload motion --error drift" "top.json --workload axis --error attitude" "top.json top.json" "- -" \
  "top.json --methods closed_form" "top.json --out top.json" "top.json --set nonsense"; do
  # shellcheck disable=SC2086
  expect 2 bench $arguments
  nothing_on_stdout
  on_stderr 'error: '
done
[ ! -e written ] || fault "a refused bench left a directory"
expect 2 bench faulty.json --json
on_stdout '"pointer": "/release/tilt_degrees"'
nothing_on_stderr
expect 2 bench top.json --methods closed_form
on_stderr 'none of these fits "bench-top"'
table='/contact={"tip_radius_m": 0.002, "law": "rolling"}'
expect 2 bench top.json --set "$table" --workload motion
on_stderr 'error: --workload motion: of a top on a table both motions are integrated together; take the drift$'
nothing_on_stdout
# shellcheck disable=SC2086
expect 0 bench top.json --set "$table" $few --brief
on_stdout ': both motions and the drift'

# Two scenarios: tables, files.
# shellcheck disable=SC2086
expect 0 bench top.json other.json $few --out files
nothing_on_stderr
on_stdout '^bench-top, 0.05 s: both motions and the drift'
on_stdout '^other-top, 0.05 s'
on_stdout '^Processor  [^ ]'
on_stdout '^Peers      GSL [0-9]'
on_stdout '^auto       taylor 1e-12, reduced, laboratory$'
on_stdout '^auto       closed_form'
on_stdout '^[* ]a taylor  *reduced, laboratory double  *1e-12 '
on_stdout '^\*'
on_stdout '^   gsl_rk8pd .*difference of two'
on_stdout 'Milliseconds at equal drift error'
for name in bench-top other-top; do
  head -n 1 "files/$name.csv" | grep -q '^method,equations,precision,.*,drift_error_rad,.*,on_front,auto,processor$' || fault "no table"
  [ "$(wc -l <"files/$name.csv")" -gt 8 ] || fault "no rows in $name.csv"
  if grep -qi -e nan -e ',inf' "files/$name.csv"; then fault "what is no number was written"; fi
  grep -q 'Pareto front' "files/$name.svg" || fault "no picture"
done
cp files/bench-top.csv before.csv
# shellcheck disable=SC2086
expect 2 bench top.json $few --out files
on_stderr 'bench-top.csv: error: already exists'
nothing_on_stdout
cmp -s before.csv files/bench-top.csv || fault "refused, and yet overwritten"
# shellcheck disable=SC2086
expect 0 bench top.json $few --out files --force --quiet
nothing_on_stdout
nothing_on_stderr
cmp -s before.csv files/bench-top.csv && fault "--force did not overwrite"

# One document, from standard input; other workloads and errors.
# shellcheck disable=SC2086
"$tool" bench - $few --json <top.json >out.txt 2>err.txt || fault "standard input"
nothing_on_stderr
for key in processor peers scenarios reference entries equal_error on_front auto outcome seconds_most; do on_stdout "\"$key\""; done
[ "$(grep -c '"auto": true' out.txt)" -eq 1 ] || fault "not one row is what auto takes"
# shellcheck disable=SC2086
expect 0 bench top.json $few --workload motion --brief
on_stdout ': one motion$'
on_stdout 'equal attitude error'
# shellcheck disable=SC2086
expect 0 bench top.json $few --error axis --set /motion/duration_s=0.02
on_stdout '^bench-top, 0.02 s'
on_stdout 'equal axis error'

# A contender that is too slow says so.
expect 0 bench top.json --methods rkf78 --repetitions 1 --limit 0.001 --set /motion/duration_s=0.02
on_stdout 'too_slow$'
on_stdout 'not_tried$'
says 'stopped after 0.001 s'

# Without the Earth's rotation there is no drift, so the error of the attitude is used; a scene that is too long for a reference
# is shortened, and a message says so.
# shellcheck disable=SC2086
expect 0 bench top.json $few --set /earth/rotation_rate_rad_s=0 --brief
on_stdout 'equal attitude error'
expect 0 bench top.json --methods auto --repetitions 1 --reference-limit 0.001 --set /motion/duration_s=50
on_stderr 'the first [0-9.]* s of 50 s'

if [ -w /dev/full ]; then
  # shellcheck disable=SC2086
  "$tool" bench top.json $few >/dev/full 2>err.txt
  [ $? -eq 4 ] || fault "full standard output: not exit status 4"
fi

[ "$faults" -eq 0 ] && echo "all as expected"
[ "$faults" -eq 0 ]
