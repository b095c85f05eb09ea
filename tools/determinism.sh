#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that the results have the same digits whatever the compiler, optimisation, instruction set and processor. It compares
# one hash of trajectory.csv, torques.csv and summary.json (without the entries about the build), for every shipped scenario,
# effect, platform, gimbal, observer, method and precision.
#   tools/determinism.sh [--short] PROGRAM...  compares these builds of earthtop; also the first of them with a C library that
#                                              takes the processor for an older one and chooses its sine and exponential
#                                              accordingly (as GNU's does). --short: without the shipped scenarios, and only
#                                              0.4 s of the others
#   tools/determinism.sh [--quick]             first builds the matrix in build/determinism: g++ and clang++, -O0 to -O3,
#                                              without and with -march=native; --quick: only -O0 and -O3
# Exit status: 0 if all hashes are equal, 1 if they are not.
set -euo pipefail
cd "$(dirname "$0")/.."

older_processor=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
short=0
if [[ ${1:-} == --short ]]; then
  short=1
  shift
fi

cat >"$work/site-gravity.json" <<'JSON'
{ "$schema": "earthtop-scenario-1.json", "name": "site-gravity", "site": { "latitude_deg": 47.123, "height_m": 713 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": { "principal_kg_m2": [1.2e-4, 1.1e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 2, "output_step_s": 0.1 } }
JSON
cat >"$work/gyrocompass.json" <<'JSON'
{ "$schema": "earthtop-scenario-1.json", "name": "gyrocompass", "site": { "latitude_deg": 52, "gravity_m_s2": 9.81 },
  "body": { "mass_kg": 1, "center_of_mass_m": [0, 0, 0], "inertia": { "principal_kg_m2": [5e-4, 5e-4, 1e-3] } },
  "release": { "tilt_deg": 90, "azimuth_deg": 20, "spin_rad_s": 628 }, "effects": { "gimbal": true },
  "motion": { "duration_s": 2, "output_step_s": 0.1 } }
JSON
printf 't_s,angle_rad\n0,0\n0.7,0.05\n1.6,-0.1\n2.4,0.2\n3.5,0.1\n60,0.3\n100,0\n' >"$work/table.csv"

# scenes: prints one line for each run: its name, its file, then values to set
scenes() {
  local base name method utc='/motion/start_utc="2026-06-21T12:00:00Z"' east=/site/longitude_deg=11.6
  # Long enough to reach every branch of an effect, and no longer: ten rows.
  local brief="/motion/duration_s=2 /motion/output_step_s=0.2"
  if [[ $short == 1 ]]; then
    brief="/motion/duration_s=0.4 /motion/output_step_s=0.1"
  else
    for base in scenarios/*.json; do echo "$(basename "$base" .json) $base"; done
    # Runs of full length, for effects that matter for runs of a minute.
    echo "long-tide scenarios/toy-top.json /effects/tide=true $utc $east"
    echo "long-platform scenarios/asymmetric-top.json" \
      '/platform={"motion":"harmonic","axis":[0,1,0.2],"amplitude_rad":0.1,"frequency_hz":0.7,"pivot_offset_m":[0.2,0.1,0]}'
    echo "long-disc scenarios/toy-top.json" '/effects/air_drag={"disc_radius_m":0.05,"flow":"turbulent"}'
    echo "long-gyrocompass $work/gyrocompass.json /motion/duration_s=10" '/effects/gimbal={"damping_N_m_s":1e-4}'
  fi
  for name in toy-top asymmetric-top; do
    base=scenarios/$name.json
    while read -r effect values; do
      echo "$effect-$name $base $brief $values"
    done <<SETTINGS
viscous /effects/viscous_torque_N_m_s=2e-6
quadratic /effects/quadratic_torque_N_m_s2=1e-8
dry-friction /effects/coulomb_torque_N_m=1e-5
disc-laminar /effects/air_drag={"disc_radius_m":0.05,"flow":"laminar"}
disc-turbulent /effects/air_drag={"disc_radius_m":0.05,"flow":"turbulent"}
gradient /effects/gravity_gradient=true
gradient-normal /effects/gravity_gradient="normal" /site/height_m=1234.5
gradient-given /effects/gravity_gradient={"gm_over_r3_s2":1e-3}
tide /effects/tide=true $utc $east
tide-elastic /effects/tide={"gravimetric_factor":1.16,"tilt_factor":0.69} $utc /site/longitude_deg=-70.3
tide-harmonic /effects/tide={"amplitude_m_s2":[1e-3,2e-3,-1e-3],"frequency_hz":0.3,"phase_deg":20}
pole /effects/polar_motion=true $utc $east
pole-given /effects/polar_motion={"x_arcsec":0.1,"y_arcsec":0.35} $east
length-of-day /effects/excess_length_of_day_ms=1.7
deflection /effects/deflection_of_vertical={"north_arcsec":12.3,"east_arcsec":-4.5}
platform-constant /platform={"motion":"constant","axis":[0.1,0,1],"rate_rad_s":0.3,"pivot_offset_m":[0.3,0,0.1]}
platform-ramp /platform={"motion":"ramp","rate_rad_s":0.1,"acceleration_rad_s2":0.05}
platform-harmonic /platform={"motion":"harmonic","axis":[0,1,0.2],"amplitude_rad":0.1,"frequency_hz":0.7,"phase_deg":33}
platform-table /platform={"motion":"table","file":"$work/table.csv"}
selected /effects="auto" /accuracy/drift_rad=1e-9
uncertain /report/sensitivities=true /uncertainty/latitude_deg=0.01 /report/threshold_rad=1e-6
ledger /numerics/ledger="platform" /platform={"motion":"constant","rate_rad_s":0.3}
body /numerics/observer="body"
inertial /numerics/observer="inertial"
SETTINGS
  done
  echo "gimbal $work/gyrocompass.json $brief"
  echo "gimbal-damped $work/gyrocompass.json $brief" '/effects/gimbal={"damping_N_m_s":1e-4}' /effects/viscous_torque_N_m_s=1e-6
  echo "site-gravity $work/site-gravity.json $brief"
  brief="/motion/duration_s=0.5 /motion/output_step_s=0.05"
  for method in taylor dopri5 rkf78 bulirsch_stoer extrapolation dop853 gauss splitting long_horizon; do
    echo "method-$method scenarios/toy-top.json $brief /numerics/method=\"$method\""
  done
  echo "method-abm8 scenarios/toy-top.json $brief /numerics/method=\"abm8\" /numerics/step_s=1e-4"
  echo "method-closed_form scenarios/free-gyro.json $brief /numerics/method=\"closed_form\""
  brief="/motion/duration_s=0.2 /motion/output_step_s=0.05"
  for method in long_double float128; do
    echo "precision-$method scenarios/asymmetric-top.json $brief /numerics/precision=\"$method\""
  done
}

# hash_of PROGRAM [NAME=VALUE]: the hash of its results, with that environment variable; the hashes of the files go to $list
hash_of() {
  local program=$1 environment=${2:-} name file values
  rm -rf "$work/results"
  while read -r name file values; do
    local set=()
    for value in $values; do set+=(--set "$value"); done
    env $environment "$program" run "$file" --quiet --out "$work/results/$name" "${set[@]}" >/dev/null ||
      [[ $? -eq 3 ]] || { echo "$name: not run" >&2; exit 1; } # 3: numerical trouble, but with results
  done < <(scenes)
  python3 - "$work/results" <<'PYTHON'
import json, pathlib, sys
for path in pathlib.Path(sys.argv[1]).glob("*/summary.json"):
    summary = json.loads(path.read_text().replace(str(pathlib.Path(sys.argv[1]).parent), "."))
    summary["provenance"] = summary["provenance"]["constants"]
    path.write_text(json.dumps(summary, indent=1))
PYTHON
  (cd "$work/results" && find . -name '*.csv' -o -name summary.json | LC_ALL=C sort | xargs sha256sum) | tee "${list:-/dev/null}" |
    sha256sum | cut -c1-16
}

declare -A programs
names=()
if [[ $# -gt 0 && $1 != --quick ]]; then
  for program in "$@"; do
    names+=("$program")
    programs[$program]=$program
  done
else
  levels="0 1 2 3"
  [[ ${1:-} == --quick ]] && levels="0 3"
  for compiler in g++ clang++; do
    for level in $levels; do
      for native in "" "-march=native"; do
        name="$compiler -O$level${native:+ $native}"
        build=build/determinism/${name// /}
        cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" -DEARTHTOP_BUILD_TESTS=OFF \
          "-DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -O$level $native" -DEARTHTOP_UNITY=ON >/dev/null
        cmake --build "$build" --parallel "$(nproc)" --target earthtop-tool >/dev/null
        names+=("$name")
        programs[$name]=$build/tools/earthtop/earthtop
      done
    done
  done
fi

sine() { env "$@" python3 -c 'import math; print(hash(tuple(math.sin(i / 7) for i in range(100000))))'; }
if [[ $(sine LC_ALL=C) == "$(sine GLIBC_TUNABLES=$older_processor)" ]]; then
  echo "The C library of this machine takes the same sine for an older processor: nothing is seen of that here."
fi
older="${names[0]}, older processor"
names=("${names[0]}" "$older" "${names[@]:1}")
programs[$older]=${programs[${names[0]}]}

declare -A seen
for name in "${names[@]}"; do
  environment=
  [[ $name == "$older" ]] && environment=GLIBC_TUNABLES=$older_processor
  hash=$(list=$work/list hash_of "${programs[$name]}" $environment)
  printf '%-60s %s\n' "$name" "$hash"
  seen[$hash]=1
  if [[ ${#seen[@]} -gt 1 ]]; then
    printf 'differs in:\n'
    diff "$work/first" "$work/list" | sed -n 's/^> [0-9a-f]*  /  /p'
  else
    mv "$work/list" "$work/first"
  fi
done
[[ ${#seen[@]} -eq 1 ]]
