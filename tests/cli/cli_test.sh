#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The program as seen from a shell: exit statuses, what goes to which stream, what is left on disk.
# usage: cli_test.sh PATH_OF_EARTHTOP
set -u
# shellcheck source=tests/cli/expect.sh
. "$(dirname "$0")/expect.sh"

cat >top.json <<'END'
{ "name": "cli-top", "title": "A top for the shell", "site": { "latitude_deg": 45, "gravity_m_s2": 9.8 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
            "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 1 } }
END
sed 's/"duration_s": 1 /"duration_s": 500000, "output_step_s": 10000 /' top.json >long.json
sed 's/"tilt_deg"/"tilt_degrees"/; s/"mass_kg": 0.1/"mass_kg": -1/' top.json >faulty.json

# What is 0 reads so, and times have no rounding of their last digits.
"$tool" example equator >equator.json
expect 0 run equator.json --long --out equator --set /motion/duration_s=20
says 'first-order theory: 0 ± [0-9.]*e-0[0-9] rad/s'
"$tool" example dzhanibekov >dzhanibekov.json
for step in 0.1 0.3 0.7; do
  expect 0 run dzhanibekov.json --long --force --out dzhanibekov --set /motion/duration_s=2.1 --set "/motion/output_step_s=$step"
  on_stdout '^Drift after [0-9]\{1,2\}\(\.[0-9]\{1,2\}\)\{0,1\} s$'
done
cat >compass.json <<'END'
{ "site": { "latitude_deg": 48 },
  "body": { "solids": [ { "shape": "ring", "radius_m": 0.05, "inner_radius_m": 0.05, "mass_kg": 0.4 } ] },
  "release": { "tilt_deg": 90, "azimuth_deg": 10, "spin_rpm": 6000 }, "effects": { "gimbal": true },
  "motion": { "duration_s": 9.7000000000000011, "output_step_s": 0.1 } }
END
expect 0 run compass.json --long --out compass
says 'Drift after 9.7 s'
says 'tilt 0 rad within [0-9.]*e-1[0-9] (+ is farther from Up)'
says 'Trend not determined: the axis is released at rest in its gimbal: it swings to and fro, and its azimuth has no secular rate'

# Usage.
for arguments in "" frobnicate run "run top.json --frobnicate" "run top.json --out" "run top.json other.json" \
  "run top.json --set nonsense"; do
  # shellcheck disable=SC2086
  expect 2 $arguments
  nothing_on_stdout
  on_stderr "error: "
done
expect 0 --help
on_stdout 'run'
expect 0 run --help
on_stdout '--force'
expect 0 version
on_stdout '^earthtop [0-9]'
expect 0 --version
on_stdout '^earthtop [0-9]'
[ "$(wc -l <out.txt)" -eq 1 ] || fault "--version prints more than a line"
expect 0 version --json
on_stdout '"commit"'
nothing_on_stderr

# Refused input.
expect 2 run missing.json
nothing_on_stdout
on_stderr 'missing.json'
expect 2 run faulty.json
nothing_on_stdout
on_stderr 'faulty.json:[0-9]*:[0-9]*: error: /release/tilt_degrees'
on_stderr 'faulty.json:[0-9]*:[0-9]*: error: /body/mass_kg'
expect 2 run faulty.json --json
nothing_on_stderr
for key in errors file line column pointer message; do on_stdout "\"$key\""; done
on_stdout '"pointer": "/release/tilt_degrees"'
[ ! -e out ] || fault "a refused scenario left a directory"

# check: all files, all errors, nothing run.
expect 0 check top.json
on_stdout 'top.json: ok, "cli-top", 1001 rows'
on_stdout 'Your top'
on_stdout '  mass  *0.1 kg'
on_stdout '  slow precession'
nothing_on_stderr
expect 0 check top.json --quiet
nothing_on_stdout
expect 0 check top.json --json
on_stdout '"slow_precession_rad_s": '
expect 0 check top.json --set /release/spin_rpm=1800
on_stdout '  spin  *188.496 rad/s (1800 rpm)'
expect 1 check top.json --set /release/spin_rps=30
on_stderr 'error: /release/spin_rps: give spin_rad_s; 1 rps = 6.28318530717959 rad/s, or spin_rpm; 1 rps = 60 rpm'
expect 1 check top.json faulty.json
on_stdout 'top.json: ok'
if grep -q 'Your top' out.txt; then fault "several files at once fill the screen with figures"; fi
on_stdout 'faulty.json: 2 errors'
on_stderr 'faulty.json:[0-9]*:[0-9]*: error: /release/tilt_degrees: .*did you mean "tilt_deg"'
on_stderr 'faulty.json:[0-9]*:[0-9]*: error: /body/mass_kg'
expect 2 check missing.json faulty.json
on_stderr 'missing.json: error: '
on_stderr 'faulty.json:[0-9]*:[0-9]*: error: '
escape=$(printf 'e\033[2Jf.json')
cp faulty.json "$escape"
expect 1 check "$escape"
if grep -q "$(printf '\033')" out.txt err.txt; then fault "a file's name steers the terminal"; fi
if [ -r /proc/self/mem ]; then
  expect 4 check top.json /proc/self/mem faulty.json
  on_stdout 'top.json: ok'
  on_stdout 'faulty.json: 2 errors'
fi
expect 1 check faulty.json top.json --json
nothing_on_stderr
on_stdout '"valid": false'
on_stdout '"pointer": "/release/tilt_degrees"'
expect 0 check top.json --set /site/gravity_m_s2=9.9
on_stdout 'ok, .*, 1 warning'
on_stderr 'top.json: warning: /site/gravity_m_s2: '
expect 0 check top.json --set /site/gravity_m_s2=9.9 --quiet
nothing_on_stdout
nothing_on_stderr
platform='{"motion":"harmonic","amplitude_rad":1e6,"frequency_hz":10,"pivot_offset_m":[0.3,0,0]}'
expect 1 check top.json --set "/platform=$platform" --set /motion/duration_s=100
on_stderr ' of computing; at most '
expect 1 check top.json --set /motion/duration_s=1e8 --set /numerics/method=taylor
on_stderr ' of computing; at most '
"$tool" check - <faulty.json >out.txt 2>err.txt
[ $? -eq 1 ] || fault "check of standard input: not exit status 1"
on_stderr '<stdin>:[0-9]*:[0-9]*: error: '
[ ! -e out ] || fault "check left a directory"
expect 2 check

# What is generated from the program's own tables.
expect 0 schema
on_stdout 'json-schema.org'
expect 0 schema --markdown
on_stdout '`site/latitude_deg`'
expect 0 example --list
on_stdout '^toy-top '
cut -d' ' -f1 out.txt >names.txt
while read -r name; do
  for option in "" --annotated; do
    # shellcheck disable=SC2086
    "$tool" example "$name" $option >example.json || fault "example $name $option"
    expect 0 check example.json
    nothing_on_stderr
    on_stdout "\"$name\""
  done
done <names.txt
expect 0 example
cp out.txt example.json
expect 0 check example.json
expect 2 example --list toy-top
expect 2 example no-such-top
on_stderr 'there is no example "no-such-top"; there are: .*toy-top'
expect 2 completion csh
for shell in bash zsh fish; do
  expect 0 completion $shell
  on_stdout '/site/latitude_deg='
  cp out.txt "completion.$shell"
  if command -v $shell >/dev/null; then $shell -n "completion.$shell" || fault "completion for $shell is no script"; fi
done
completed() { # WORDS...: what bash offers for the last of them
  bash -c '. ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _earthtop; printf "%s\n" "${COMPREPLY[@]}"' - "$@"
}
completed earthtop ru | grep -qx run || fault "bash does not complete a verb"
completed earthtop run --fo | grep -qx -- --force || fault "bash does not complete an option"
completed earthtop run to | grep -qx top.json || fault "bash does not complete a scenario"
completed earthtop run --set /site/lat | grep -qx /site/latitude_deg= || fault "bash does not complete a pointer"
completed earthtop example toy | grep -qx toy-top || fault "bash does not complete an example"

# A run.
expect 0 run top.json
on_stdout 'A top for the shell'
on_stdout '± .*rad'
nothing_on_stderr
for file in trajectory.csv summary.json timing.json drift.svg; do
  [ -s "out/cli-top/$file" ] || fault "no $file"
done
if grep -q "$(printf '\033')" out.txt; then fault "colours in a file"; fi
expect 0 run top.json --json --out again
nothing_on_stderr
cmp -s out.txt again/summary.json || fault "--json is not the summary"
cmp -s again/summary.json out/cli-top/summary.json || fault "two runs, two summaries"
cmp -s again/trajectory.csv out/cli-top/trajectory.csv || fault "two runs, two trajectories"
expect 0 run top.json --quiet
nothing_on_stdout
"$tool" run - --out piped --quiet <top.json || fault "standard input"
cmp -s piped/summary.json again/summary.json || fault "standard input gives another summary"

# The headline figure: met; no news where the scenario was changed; a warning where it was not.
"$tool" example dzhanibekov >headline.json || fault "example dzhanibekov"
expect 0 run headline.json --long --out headline
says ' Headline drift_axis_rad at 1.6 s = [^:]*: met, off by'
expect 0 run headline.json --long --out headline --force --set /earth/rotation_rate_rad_s=0
says ' Headline [^:]*: differs, as the scenario was changed'
expect 0 run headline.json --long --out headline --force --set /numerics/method=dopri5 --set /numerics/relative_tolerance=1e-5 \
  --set /numerics/ledger=body --set /name=other
says ' Headline [^:]*: NOT MET'
expect 0 run headline.json --long --out headline --force --set /motion/duration_s=1
says ' Headline [^:]*: not compared, this run has no such number'
on_stderr 'warning: /headline/at_s'
expect 3 run headline.json --long --out headline --force --set /numerics/method=abm8 --set /numerics/step_s=100 \
  --set /motion/output_step_s=0.4
says ' Headline [^:]*: not compared, the run stopped at'
sed 's/"value": 1/"value": 2/' headline.json >wrong.json
expect 0 run wrong.json --long --out wrong
says ' Headline [^:]*: NOT MET'
expect 0 run top.json --out bare
grep -q Headline out.txt && fault "a headline where the scenario has none"

# The torque ledger: written when asked, gone with the results it belonged to.
expect 0 run top.json --long --out ledger --set /numerics/ledger=laboratory
says 'torques.csv, as the laboratory observer'
head -n 1 ledger/torques.csv | grep -q '^t_s,tau_phys_x_N_m,.*,residual_z_N_m$' || fault "no ledger"
[ "$(wc -l <ledger/torques.csv)" -eq "$(wc -l <ledger/trajectory.csv)" ] || fault "the ledger has not the trajectory's rows"
grep -q '"residual_over_largest_torque"' ledger/summary.json || fault "no ledger in the summary"
expect 0 run top.json --out ledger --force
[ ! -e ledger/torques.csv ] || fault "an old ledger was left"

# Extended precision by one key: 34 digits in the file, the same in the summary, another identity.
expect 0 run top.json --long --out quad --set /numerics/precision=float128 --set /motion/duration_s=0.05
on_stdout '^  in full     [0-9]\.[0-9]\{31,33\}e-[0-9]* rad$'
on_stdout '^Computed .*float128'
grep -q '"axis_final_rad": "[0-9.]*e-[0-9]*"' quad/summary.json || fault "no digits in the summary"
tail -n 1 quad/trajectory.csv | grep -q '^0.05,0\.[0-9]\{30,\}' || fault "no 34 digits, or too many for the time"
expect 2 run top.json --out quad --set /numerics/precision=float128 --set /numerics/method=dopri5
on_stderr '/numerics/method: "dopri5" is not built for float128; must be "auto", "rkf78", "extrapolation"'

# Results of another scenario in the way.
expect 2 run top.json --set spin_rad_s=210 --out out/cli-top
on_stderr 'holds the results of another scenario; .*; for example: earthtop run top.json --set spin_rad_s=210 --out out/cli-top-2$'
expect 0 run top.json --set spin_rad_s=210
says 'Written out/cli-top-2, as out/cli-top holds other results'
tail -n 1 out.txt | grep -qx ' *earthtop report out/cli-top-2' || fault "the last line is no command that makes the page"
expect 0 run top.json --set spin_rad_s=220 --quiet
on_stderr 'note: the results are in out/cli-top-3, as out/cli-top holds other results'
expect 0 run top.json --set release.spin_rad_s=210 --quiet
[ ! -s err.txt ] || grep -q cli-top-2 err.txt || fault "the same results are not in the same place"
cmp -s again/summary.json out/cli-top/summary.json || fault "refused, and yet overwritten"
expect 0 run top.json --set /release/spin_rad_s=210 --force --quiet
cmp -s again/summary.json out/cli-top/summary.json && fault "--force did not overwrite"
expect 2 run top.json --out top.json
on_stderr 'not a directory'

# Writing fails.
if [ -w /dev/full ]; then
  "$tool" run top.json --out full >/dev/full 2>err.txt
  [ $? -eq 4 ] || fault "full standard output: not exit status 4"
  on_stderr 'the results are whole, in full$'
  [ "$(find full -type f | wc -l)" -eq 4 ] || fault "full standard output: the results are not whole"
fi
# A reader that closes the pipe early is no error: there is no message, and the status is the verb's own, or that of SIGPIPE.
gone() {
  wanted=$1
  shift
  { "$tool" "$@" 2>err.txt; echo $? >status.txt; } | true
  case " $wanted " in *" $(cat status.txt) "*) ;; *) fault "$*, reader gone: exit status $(cat status.txt), not $wanted" ;; esac
  nothing_on_stderr
}
sleep_and_say() { sleep 0.2; cat top.json; }
gone "0" example --list
gone "0" schema
gone "0" run top.json --out gone
[ -s gone/summary.json ] || fault "a reader that had gone cost the results"
sleep_and_say | gone "0 141" check - top.json
gone "0 141" verify --list
"$tool" run top.json --out closed >&- 2>err.txt
[ $? -eq 4 ] || fault "closed standard output: not exit status 4"
grep -q '^Written' closed/* && fault "the summary went into a result file"
(
  ulimit -f 1
  "$tool" run top.json --out limited --quiet >/dev/null 2>limited.txt
  [ $? -eq 4 ]
) || fault "file size limit: not exit status 4"
[ -z "$(ls -A limited 2>/dev/null)" ] || fault "file size limit: files were left"

# The effect budget, and an accuracy that cannot be reached.
expect 0 explain top.json
on_stdout 'coriolis  *modelled'
on_stdout 'gravity_gradient  *left out'
says 'run would use'
expect 0 explain top.json --json
on_stdout '"name": "gravity_gradient"'
expect 2 explain faulty.json --json
on_stdout '"pointer": "/body/mass_kg"'
expect 0 run top.json --out chosen --set '/effects={"select":"auto"}' --set /accuracy/drift_rad=1e-6 --json
on_stdout '"left_out_drift_rad"'
expect 3 run top.json --out chosen --force --set /accuracy/drift_rad=1e-18
on_stderr 'was not reached'

# What a run takes is said beforehand; stiff friction is refused with the reason, before anything is written; slow is not stiff.
expect 0 check top.json
on_stdout 'steps, less than 0.1 s'
expect 0 explain top.json
says 'steps, less than 0.1 s'
expect 0 check top.json --set /motion/duration_s=60 --set /effects/viscous_torque_N_m_s=1
on_stdout 'steps, about [0-9.]* s'
expect 2 run top.json --out stiff --set /motion/duration_s=60 --set /effects/viscous_torque_N_m_s=2e8
on_stderr '/effects/viscous_torque_N_m_s: this friction is too stiff'
[ ! -e stiff ] || fault "something was written of a scene that was refused"
expect 0 run top.json --out unlimited --no-step-limit --quiet

# Numerical failure: a fixed step of three turns of the top. The rows up to it are kept.
failing="run top.json --set /motion/duration_s=60 --set /numerics/method=abm8 --set /numerics/step_s=0.1 --out failed"
# shellcheck disable=SC2086
expect 3 $failing --quiet
on_stderr 'numerical failure'
grep -q '"status": "not_finite"' failed/summary.json || fault "the outcome is not in summary.json"
[ "$(wc -l <failed/trajectory.csv)" -gt 2 ] || fault "the rows were not kept"
if grep -qi -e nan -e inf failed/trajectory.csv; then fault "what is no number was written"; fi
# shellcheck disable=SC2086
expect 3 $failing --json
on_stdout '"status": "not_finite"'

# Interrupted.
for pair in INT:130 TERM:143; do
  # A background job of a shell ignores SIGINT, so the signal comes from timeout; --foreground: once, not to its group as well.
  timeout --foreground --preserve-status -s "${pair%:*}" 1 "$tool" run long.json --set method=taylor --out stopped >out.txt 2>err.txt
  status=$?
  [ "$status" -eq "${pair#*:}" ] || fault "SIG${pair%:*}: exit status $status"
  on_stderr 'interrupted at'
  [ ! -e stopped ] || fault "an interrupted run wrote results"
done

[ "$faults" -eq 0 ] && echo "all as expected"
[ "$faults" -eq 0 ]
