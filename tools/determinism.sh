#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One hash of the numbers, whatever compiler, optimisation, instruction set and processor, and another one of those in float128. They
# cover trajectory.csv, torques.csv and summary.json (without what built it) of every shipped scenario, hard case, effect, platform,
# gimbal, observer, method and precision; points, statistics and fits of a study; and what run, explain, verify and compare print,
# without times.
#   tools/determinism.sh [--short] PROGRAM...  of these builds of earthtop; and of the first with a C library that takes the
#                                              processor for an older one, and its sine and exponential accordingly (GNU's does).
#                                              --short: without shipped scenarios and hard cases, and the others for 0.4 s
#   tools/determinism.sh [--quick]             builds the matrix first, in build/determinism: g++ and clang++, -O0 to -O3, without
#                                              and with -march=native; --quick: -O0 and -O3 only
# Status: 0 where all hashes are one, 1 where they are not.
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
  local base name method values utc='/motion/start_utc="2026-06-21T12:00:00Z"' east=/site/longitude_deg=11.6
  # Long enough for every branch of an effect, and no longer: ten rows.
  local brief="/motion/duration_s=2 /motion/output_step_s=0.2"
  if [[ $short == 1 ]]; then
    brief="/motion/duration_s=0.4 /motion/output_step_s=0.1"
  else
    for base in scenarios/*.json; do echo "$(basename "$base" .json) $base"; done
    for base in scenarios/hard/*.json; do
      # Two days take the same branches as thirty, in a hundredth of the time.
      [[ $base == *thirty-days.json ]] && values=/motion/duration_s=172800 || values=
      echo "hard-$(basename "$base" .json) $base $values"
    done
    # Full length, of what a result of a minute rests on.
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
viscous-by-axis /effects/viscous_torque_N_m_s=[2e-6,1e-6,4e-6]
unequal-support /effects/unequal_support={"kappa_N_m":0.01,"azimuth_deg":35}
given-torque /effects/given_torque={"axes":"laboratory","course":"harmonic","torque_N_m":[1e-3,-1e-3,5e-4],"frequency_hz":0.8}
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
  base="scenarios/toy-top-on-table.json /motion/duration_s=0.2 /motion/output_step_s=0.05"
  local contact='/contact={"tip_radius_m":0.002,"law":'
  echo "contact-contensou $base"
  echo "contact-frictionless $base $contact\"frictionless\"}"
  echo "contact-viscous $base $contact\"viscous\",\"sliding_viscosity_N_s_m\":0.05}"
  echo "contact-in-air $base" '/effects/viscous_torque_N_m_s=[2e-6,2e-6,1e-6]' '/effects/air_force={"linear_N_s_m":0.01,"quadratic_N_s2_m2":0.05}'
  echo "contact-viscous_load $base $contact\"viscous_load\",\"sliding_viscosity_s_m\":0.3}"
  echo "contact-coulomb $base $contact\"coulomb\",\"friction_coefficient\":0.2}"
  echo "contact-coulomb-regular $base $contact\"coulomb\",\"friction_coefficient\":0.2,\"regularisation_m_s\":0.02}"
  echo "contact-rolling $base $contact\"rolling\"}"
  echo "contact-slope $base /contact/table={\"tilt_deg\":2,\"tilt_azimuth_deg\":40} /effects/gravity_gradient=true"
  echo "contact-inertial $base /numerics/observer=\"inertial\""
  echo "contact-asymmetric $base /body/inertia/principal_kg_m2=[3e-5,2.5e-5,4e-5]"
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

# A study of eighteen points, with a fit. Its documents name its base, which must not depend on where this checkout is.
cp scenarios/toy-top.json "$work"
cat >"$work/study.json" <<JSON
{ "\$schema": "earthtop-study-1.json", "name": "latitudes", "base": "toy-top.json",
  "set": { "/motion/duration_s": 1, "/motion/output_step_s": 0.1, "/report/threshold_rad": 1e-6 },
  "axes": [ { "pointer": "/site/latitude_deg", "range": { "from": -80, "to": 80, "points": 9 } },
            { "pointer": "/release/spin_rad_s", "values": [150, 200] } ],
  "collect": ["drift.secular.azimuth_rate_rad_s", "drift.axis_final_rad", "drift.axis_bound_rad", "drift.verdict",
              "drift.threshold_time_s", { "name": "up", "path": "motion.axis_final_L.2" },
              "invariants.0.largest_change", "theory.0.predicted"],
  "fits": [ { "kind": "sin_latitude", "axis": "latitude_deg", "quantity": "drift.secular.azimuth_rate_rad_s" } ] }
JSON

# documents PROGRAM: what its other verbs print, in files beside the results
documents() {
  local program=$1 out=$work/results/documents scene
  mkdir -p "$out"
  "$program" study "$work/study.json" --out "$work/study" --force --quiet
  cp "$work/study/study.csv" "$work/study/study.json" "$out"
  for scene in toy-top asymmetric-top free-gyro; do "$program" explain "scenarios/$scene.json" --json >"$out/explain-$scene.json"; done
  "$program" explain scenarios/asymmetric-top.json >"$out/explain.txt"
  if "$program" plan --help >/dev/null 2>&1; then
    "$program" plan scenarios/toy-top.json --measure axis_deg --sigma 0.01 --every 0.1 --until 20 --nuisance spin_rad_s \
      --set /uncertainty/inertia_ratio=0.01 --write-data "$out/plan.csv" --seed 5 --json >"$out/plan.json"
  fi
  "$program" run scenarios/toy-top.json --set /motion/duration_s=2 --set /report/sensitivities=true --set '/numerics/ledger="body"' \
    --out "$work/told" --force | awk '/^[^ ]/ { timed = /^(Computed|Checked) / } !timed' >"$out/run.txt"
  local cases=(scenarios/hard/{h01,h03,h04,h08,h09,h10,h13,h15,h16,h22,h26,t01,t07}*.json)
  [[ $short == 1 ]] || "$program" verify "${cases[@]}" --json >"$out/verify.json" # takes minutes with sanitizers
  # A difference is an answer, too (status 1).
  "$program" compare "$work/results/method-taylor" "$work/results/method-dopri5" --allow-change / --json >"$out/compare.json" ||
    [[ $? -eq 1 ]]
  "$program" compare "$work/results/viscous-toy-top" "$work/results/uncertain-toy-top" --allow-change / --json --profile physics \
    >"$out/compare-physics.json" || [[ $? -eq 1 ]]
  if [[ $short == 0 ]]; then
    mkdir "$work/shipped"
    for scene in scenarios/*.json; do ln -s "$work/results/$(basename "$scene" .json)" "$work/shipped"; done
    "$program" compare tests/data/references "$work/shipped" --allow-change /numerics --json >"$out/compare-references.json" ||
      [[ $? -eq 1 ]]
    rm -r "$work/shipped"
  fi
}

# hash_of PROGRAM [NAME=VALUE]: of its results, in that environment: of those in double and long double, and of those in float128, whose
# digits belong to a version of libquadmath, too. The hashes of each file go to $list.
float128=' ./precision-float128/'
hash_of() {
  local program=$1 environment=${2:-} name file values
  rm -rf "$work/results"
  while read -r name file values; do
    local set=()
    for value in $values; do set+=(--set "$value"); done
    env $environment "$program" run "$file" --quiet --out "$work/results/$name" "${set[@]}" >/dev/null ||
      [[ $? -eq 3 ]] || { echo "$name: not run" >&2; exit 1; } # 3: numerical trouble, but with results
  done < <(scenes)
  export -f documents
  env $environment short=$short work="$work" bash -c 'set -euo pipefail; documents "$1"' bash "$program" ||
    { echo "its documents could not be made" >&2; exit 1; }
  python3 - "$work" <<'PYTHON'
import json, pathlib, re, sys
work = pathlib.Path(sys.argv[1])
TIMES = {"cpu_s", "seconds", "wall_seconds", "computed_utc"}  # numbers and dates that no two runs share
# What built it, and a document's own checksum, which covers that, too.
BUILT = {"version", "commit", "compiler", "flags", "libraries", "program", "earthtop", "checksum"}
COMPARED = ("drift.", "motion.", "invariants.", "growth_of_disturbances.")  # beside the measures of rows, without a point
def is_number(value):
    """Whether an entry of a list states what another run of the same program would state, too."""
    if not isinstance(value, dict) or not isinstance(value.get("name"), str): return True
    name = value["name"]
    return name != "seconds" and ("tolerance_origin" not in value or "." not in name or name.startswith(COMPARED))
def numbers(value):
    if isinstance(value, dict):
        return {k: numbers(v) for k, v in value.items() if k not in TIMES | BUILT}
    if isinstance(value, list):
        return [numbers(v) for v in value if is_number(v)]
    return value
for path in work.glob("results/*/*.*"):
    if path.suffix not in (".json", ".txt"): continue
    text = path.read_text().replace(str(work), ".")
    if path.name == "summary.json":
        summary = json.loads(text)
        summary["provenance"] = summary["provenance"]["constants"]
        del summary["checksum"]
        text = json.dumps(summary, indent=1)
    elif path.suffix == ".json" and path.name != "timing.json":
        text = json.dumps(numbers(json.loads(text)), indent=1)
    else:
        text = re.sub(r"(?m), [0-9.e+-]+ s$", "", text)
    path.write_text(text)
PYTHON
  (cd "$work/results" && find . -name '*.csv' -o -name summary.json -o -path '*/documents/*' | LC_ALL=C sort | xargs sha256sum) >"$list"
  grep -v "$float128" "$list" | sha256sum | cut -c1-16
  grep "$float128" "$list" | sha256sum | cut -c1-16
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
  hash=$(list=$work/list hash_of "${programs[$name]}" $environment | paste -sd' ')
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
