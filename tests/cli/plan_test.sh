#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# earthtop plan as users call it, and the round from a plan by simulated data to their fit.
#   tests/cli/plan_test.sh PATH-TO-EARTHTOP
set -u
# shellcheck source=tests/cli/expect.sh
scenarios=$(realpath "$(dirname "$0")/../../scenarios")
. "$(dirname "$0")/expect.sh"
top=$scenarios/free-gyro.json
azimuth="--measure azimuth_deg --sigma 0.01 --every 0.5"

# shellcheck disable=SC2086
{
  expect 0 plan "$top" $azimuth
  on_stdout 'omega_sin_latitude_rad_s  5.156304e-05 ± 4.5[0-9]*e-07 rad/s: 11[0-9] sigma'
  says 'To change first: measure 2 times as long, to 120 s: the standard error of omega_sin_latitude_rad_s would be 2.8[0-9]* times smaller'
  nothing_on_stderr
  expect 0 plan "$top" $azimuth --until 7.5
  on_stdout 'every 0.5 s to 7.5 s: 16 rows'
  expect 0 plan "$top" --measure tilt_deg --sigma 0.01 --every 0.5 --estimate latitude_deg
  says 'latitude_deg would be known to ± '
  expect 0 plan "$top" $azimuth --quiet
  nothing_on_stdout
  expect 0 plan "$top" $azimuth --json --svg p/plan.svg --write-data p/data.csv --seed 3
  on_stdout '"\$schema": "earthtop-plan-1.json"'
  grep -q '</svg>' p/plan.svg || fault "no picture"
  expect 0 compare "$top" p/data.csv --estimate omega_sin_latitude_rad_s
  on_stdout 'Agreement   yes'
  cp p/data.csv before.csv
  expect 0 plan "$top" $azimuth --write-data p/data.csv --seed 3 --quiet
  cmp -s p/data.csv before.csv || fault "the same seed gave other data"

  # A negative answer: what is not determined is named, with a remedy.
  expect 1 plan "$top" $azimuth --nuisance gravity_m_s2
  says 'these data would not determine gravity_m_s2'
  on_stdout '^Remedy '
  expect 1 plan "$top" $azimuth --nuisance gravity_m_s2 --json
  on_stdout '"outcome": "not_determined"'

  # What is refused: status 2, a remedy, nothing written.
  rm -r p
  refused() {
    words=$1
    shift
    expect 2 plan "$@" --svg p/plan.svg --write-data p/data.csv
    on_stderr "$words"
    nothing_on_stdout
    [ ! -e p ] || fault "plan $*: something was written"
  }
  refused 'measure' "$top" --sigma 1 --every 1
  refused 'sigma' "$top" --measure tilt_deg --every 1
  refused 'every' "$top" --measure tilt_deg --sigma 1
  refused 'did you mean azimuth_deg' "$top" --measure azimut_deg --sigma 1 --every 1
  refused 'give each --measure its own' "$top" --measure tilt_deg --measure azimuth_deg --sigma 1 --every 1
  refused 'is not a number' "$top" --measure tilt_deg --sigma 0,01 --every 1
  refused 'above 0' "$top" --measure tilt_deg --sigma 0 --every 1
  refused 'every' "$top" --measure tilt_deg --sigma 1 --every 0
  refused 'every' "$top" --measure tilt_deg --sigma 1 --every nan
  refused 'take a shorter one' "$top" --measure tilt_deg --sigma 1 --every 100
  refused 'take a longer one' "$top" --measure tilt_deg --sigma 1 --every 1e-6
  refused 'until' "$top" $azimuth --until -1
  refused 'correlation-time' "$top" $azimuth --correlation-time -1
  refused 'did you mean' "$top" $azimuth --estimate latitude
  refused 'allowed are omega_sin_latitude_rad_s' "$top" $azimuth --nuisance weather
  refused 'LOW:HIGH' "$top" $azimuth --optimise /release/tilt_deg
  refused 'a limit is not possible' "$top" $azimuth --optimise /release/tilt_deg=5:500
  refused 'seed' "$top" $azimuth --seed -1
  refused 'missing.json' missing.json $azimuth
  refused 'chaotic' "$scenarios/hard/h11-chaotic.json" --measure tilt_deg --sigma 1 --every 0.1 --estimate gravity_m_s2
  cp "$top" mine.json
  expect 2 plan mine.json $azimuth --write-data ./mine.json
  on_stderr 'is one of the inputs; write to another place'
  cmp -s "$top" mine.json || fault "the scenario was overwritten"
  expect 2 plan mine.json $azimuth --write-data same --svg ./same
  on_stderr 'name the same file'
}

exit "$((faults > 0))"
