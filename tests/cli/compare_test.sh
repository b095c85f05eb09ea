#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# earthtop compare as users call it. It is also the project's regression test: every shipped scenario, run with its defaults, is
# compared with references computed by another method in extended precision.
#   tests/cli/compare_test.sh PATH-TO-EARTHTOP
set -u
here=$(cd "$(dirname "$0")" && pwd)
. "$here/expect.sh"
scenarios=$here/../../scenarios
references=$here/../data/references

for file in "$scenarios"/*.json; do
  expect 0 run "$file" --out "runs/$(basename "$file" .json)" --quiet
done
expect 0 compare "$references" runs --allow-change /numerics --junit regression.xml --json
on_stdout '"verdict": "same"'
grep -q '<testsuites name="earthtop compare" tests="[0-9]*" failures="0" errors="0">' regression.xml || fault "not all passed in regression.xml"
[ "$(grep -c '<testsuite name' regression.xml)" -eq "$(ls "$scenarios"/*.json | wc -l)" ] || fault "a scenario has no reference"

# Each reference states its generator, precision, digits and history.
for file in "$references"/*.json; do
  for key in generator precision digits history; do
    head -n 10 "$file" | grep -q "\"$key\"" || fault "$file does not say its $key"
  done
done

# Another method counts as another scenario unless that is allowed; a program without the Earth's rotation is detected.
expect 1 compare "$references" runs
on_stdout 'other scenario: /numerics'
expect 0 run "$scenarios/toy-top.json" --set /earth/rotation_rate_rad_s=0 --out flat --quiet
expect 1 compare runs/toy-top flat --allow-change /
on_stdout 'FAILED  drift_axis_rad'
on_stdout 'above both errors'

# The sentence about the changes is true, if only a key differs and if a figure is missing.
cp -r runs/toy-top keyless
without_checksum() { python3 -c 'import json, sys; d = json.load(sys.stdin); del d["checksum"]; json.dump(d, sys.stdout, indent=1)'; }
sed 's/"tilt_max_rad": [0-9.e-]*,/"tilt_max_rad": null,/' runs/toy-top/summary.json | without_checksum >keyless/summary.json
expect 1 compare runs/toy-top keyless
on_stdout 'FAILED  drift.tilt_max_rad'
on_stdout "^No quantity's number has changed by a bit; what else differs is named below.$"
expect 0 run "$scenarios/toy-top.json" --set /motion/duration_s=2 --out short --quiet
expect 0 run "$scenarios/toy-top.json" --set /motion/duration_s=2 --set /numerics/relative_tolerance=1e-9 --out loose --quiet
expect 1 compare short loose
on_stdout 'other scenario: /numerics/relative_tolerance'
grep -q 'has no error bounds' out.txt && fault "a key that differs is taken for a number without bounds"
says 'is within.*; what else differs is named below\.'
expect 1 compare short loose --allow-change / --max-steps-ratio 0.1 --junit loose.xml
grep -q 'name="cost: steps">$' loose.xml || fault "no test case of the steps in loose.xml"
grep -Eq 'message="[0-9]+ where the reference has [0-9]+, limit 0.1 times"' loose.xml || fault "loose.xml does not say by what the steps fail"
expect 1 compare runs/toy-top flat --allow-change / --junit flat.xml
grep -Eq 'name="drift_axis_rad">$' flat.xml || fault "no failure of the drift in flat.xml"
grep -Eq 'differs by [0-9.e-]+ at t = [0-9.]+ s, tolerance [0-9.e-]+ from .*, first beyond it at t = 0.1 s"' flat.xml ||
  fault "flat.xml does not say where the drift is beyond its tolerance first"

# Runs of unlike lengths, where that is allowed, are compared up to the end of the shorter one, whichever that is.
for pair in "runs/toy-top short" "short runs/toy-top"; do
  expect 0 compare $pair --allow-change /motion --allow-missing --junit lengths.xml
  says 'Both were compared up to t = 2 s, where the .* ends; the .* goes on to t = 60 s\. What does not belong to that time is left out: [0-9]* figures\.'
  grep -q '<skipped message="a figure of a whole run has no common meaning for runs of unlike lengths"/>' lengths.xml || fault "no word in lengths.xml"
  expect 0 compare $pair --allow-change /motion --allow-missing --all
  says 'note: not compared: outcome.reached_s, .*: a figure of a whole run has no common meaning for runs of unlike lengths'
  says 'ok drift.axis_final_rad '
  expect 0 compare $pair --allow-change /motion --allow-missing --json
  on_stdout '"common_end_s": 2.0'
  cp out.txt lengths.json
  expect 0 report lengths.json
  grep -q 'Both were compared up to t = 2 s' lengths.html || fault "the page does not say up to when"
  grep -q 'a figure of a whole run has no common meaning' lengths.html || fault "the page does not say what is left out"
  expect 1 compare $pair --allow-missing
  on_stdout 'FAILED  outcome.reached_s'
done
expect 1 compare runs/toy-top short --allow-change /motion
on_stdout 'FAILED  missing rows'

# Exit statuses and what is written.
expect 0 compare runs/toy-top runs/toy-top
on_stdout '^All [0-9]* quantities agree to the last bit.$'
on_stdout '^Not a bit has changed.$'
expect 0 compare runs/toy-top runs/toy-top --quiet --svg new/differences.svg --junit new/j.xml
nothing_on_stdout
grep -q '</svg>' new/differences.svg || fault "no picture"
expect 0 compare runs/toy-top "$here/../data/simbody/toy-top.csv" --mapping "$here/../data/simbody/mapping.json" \
  --profile physics --allow-missing
expect 1 compare runs/toy-top "$here/../data/simbody/toy-top.csv" --mapping "$here/../data/simbody/mapping.json" --profile physics
on_stdout 'missing rows'
expect 2 compare runs/toy-top
expect 2 compare runs/toy-top nowhere --json
on_stdout '"errors"'
expect 2 compare runs/toy-top runs
on_stderr 'different kinds'
expect 2 compare runs/toy-top runs/toy-top --mapping "$here/../data/simbody/mapping.json"
expect 0 compare runs/toy-top runs/toy-top --allow-change numerics
expect 2 compare runs/toy-top runs/toy-top --allow-change numeric
expect 2 compare runs/toy-top runs/toy-top --tolerances "$scenarios/toy-top.json"
expect 2 compare runs/toy-top runs/toy-top --reason "none"
mkfifo pipe.csv
expect 2 compare runs/toy-top pipe.csv
on_stderr 'is a FIFO'
mkdir empty
expect 2 compare runs/toy-top empty
head -c 1000 runs/toy-top/trajectory.csv >cut.csv
expect 2 compare runs/toy-top/trajectory.csv cut.csv
on_stderr 'cut.csv:[0-9]*:1: error: the last line is incomplete'

# A measurement: the azimuth of every tenth row, exact to twelve digits, with a claimed standard error of a thousandth of a
# radian.
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; print "t_s,azimuth_rad,azimuth_se_rad" }
         NR % 10 == 2 { printf "%s,%.12f,0.001\n", $1, atan2($at["axis_L_x"], $at["axis_L_y"]) }' runs/toy-top/trajectory.csv >measured.csv
expect 0 compare "$scenarios/toy-top.json" measured.csv --estimate omega_sin_latitude_rad_s --json
on_stdout '"converged"'
cp out.txt fit.json
expect 0 report fit.json
for word in 'they <strong>agree' omega_sin_latitude_rad_s 'chi-squared after the fit' '<svg'; do
  grep -q "$word" fit.html || fault "no '$word' on the page of a measurement"
done
expect 0 compare "$scenarios/toy-top.json" measured.csv --estimate omega_sin_latitude_rad_s
on_stdout 'omega_sin_latitude_rad_s  5.1'
sed 's/,0.001$/,0.000001/' measured.csv >finer.csv
expect 0 compare "$scenarios/toy-top.json" finer.csv
expect 1 compare "$scenarios/toy-top.json" finer.csv --set /earth/rotation_rate_rad_s=0
on_stdout 'Agreement   no'
expect 2 compare "$scenarios/toy-top.json" measured.csv --profile physics
expect 2 compare "$scenarios/toy-top.json" measured.csv --estimate nonsense
sed 's/,0.001$/,0/' measured.csv >no-errors.csv
expect 2 compare "$scenarios/toy-top.json" no-errors.csv
on_stderr 'no-errors.csv:2:'
expect 2 compare runs/toy-top measured.csv --estimate omega_sin_latitude_rad_s
on_stderr 'belong to a measurement'

# Its picture and its page, from a document of any name and from a pipe; the page says what the terminal says.
expect 0 compare "$scenarios/toy-top.json" measured.csv --svg measured.svg --quiet
grep -q 'measured</text>' measured.svg || fault "no measured values in the picture"
cp fit.json fit.txt
expect 0 report fit.txt --out fit2.html --quiet
cmp fit.html fit2.html || fault "a document's name changes its page"
"$tool" report - --out fit3.html --quiet <fit.json || fault "no page of a document on standard input"
cmp fit.html fit3.html || fault "a page from standard input is another one"
expect 0 compare "$scenarios/toy-top.json" measured.csv --estimate omega_sin_latitude_rad_s
says "the Earth's rate times sin(latitude) is 5.1.*: seen, zero is excluded at "
grep -q 'rate times sin(latitude) is 5.1.*: seen, zero is excluded at' fit.html || fault "the page does not say what was seen"

# The scenario with the estimate put in: the same chi-squared, bit by bit; nothing is overwritten, nor written without a fit.
expect 0 compare "$scenarios/toy-top.json" measured.csv --estimate spin_rad_s --write-scenario fitted.json --json
sed -n '/"fitted": {/,/}/s/.*"value": //p' out.txt >chi-fitted.txt
expect 0 check fitted.json
expect 0 compare fitted.json measured.csv --json
sed -n '/"as_given": {/,/}/s/.*"value": //p' out.txt >chi-again.txt
cmp chi-fitted.txt chi-again.txt || fault "the fitted scenario has another chi-squared"
expect 2 compare "$scenarios/toy-top.json" measured.csv --estimate spin_rad_s --write-scenario fitted.json
on_stderr 'fitted.json: error: already exists'
expect 0 compare "$scenarios/toy-top.json" measured.csv --estimate spin_rad_s --write-scenario fitted.json --force --quiet
expect 2 compare fitted.json measured.csv --estimate spin_rad_s --write-scenario fitted.json --force
expect 2 compare "$scenarios/toy-top.json" measured.csv --write-scenario other.json
expect 1 compare "$scenarios/toy-top.json" measured.csv --estimate /release/spin_angle_deg --write-scenario other.json
on_stderr 'is not written: there is no fit'
[ ! -e other.json ] || fault "a scenario was written without a fit"

# Priors, correlation, and what spreadsheets write.
expect 0 compare "$scenarios/toy-top.json" measured.csv --estimate spin_rad_s --priors --set '/uncertainty={"spin_rad_s": 1, "tilt_deg": 1}'
on_stdout 'known beforehand as'
on_stdout 'tilt_deg did not enter'
expect 2 compare "$scenarios/toy-top.json" measured.csv --estimate spin_rad_s --priors
on_stderr 'has no uncertainty block'
expect 0 compare "$scenarios/toy-top.json" measured.csv --correlation-time 0.001
on_stdout 'correlated over 0.001 s'
expect 2 compare "$scenarios/toy-top.json" measured.csv --correlation-time 0
expect 2 compare runs/toy-top runs/toy-top --priors
tr ',' ';' <measured.csv >semicolons.csv
expect 0 compare "$scenarios/toy-top.json" semicolons.csv
tr ',' '\t' <measured.csv >tabs.csv
expect 0 compare "$scenarios/toy-top.json" tabs.csv
tr '.' ',' <tabs.csv >decimal.csv
expect 0 compare "$scenarios/toy-top.json" decimal.csv
{ cat decimal.csv; printf '7.5\t0\t1\n'; } >mixed.csv
expect 2 compare "$scenarios/toy-top.json" mixed.csv
on_stderr 'write all with the same sign'

# A new reference needs a reason.
expect 2 compare reference runs/toy-top --update
on_stderr 'needs a reason'
[ ! -e reference ] || fault "a reference was written without a reason"
expect 0 compare reference runs/toy-top --update --reason "a better tide"
grep -q 'a better tide' reference/reference.json || fault "the reason is not kept"
expect 0 compare reference runs/toy-top --profile bitwise

# Two hundred results take a second of processor time.
mkdir many more
for i in $(seq 1 200); do
  mkdir "many/$i" "more/$i"
  ln runs/toy-top/* "many/$i"
  ln runs/toy-top/* "more/$i"
done
take_processor_time
before_s=$used_s
expect 0 compare many more
on_stdout '200 results: 200 same'
take_processor_time
[ $((used_s - before_s)) -lt 10 ] || fault "200 results took $((used_s - before_s)) s of processor time"

exit "$((faults > 0))"
