#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Measures the table of speeds: the processor time of whole runs, of one motion against odeint's rkf78 of the same form in the
# same process, and of a study. The scenarios are in tools/bench/scenarios.
#   tools/bench/table.sh [--repetitions N] [--most SECONDS] PROGRAM...
# With several programs they take turns, so that both meet the same machine; of each the median is printed.
#   --repetitions N   how often each is run; default 5
#   --most SECONDS    a run that takes longer is not repeated, and is stopped after ten times as long; default 5
set -euo pipefail

repetitions=5 most=5
while [[ ${1:-} == --* ]]; do
  case $1 in
    --repetitions) repetitions=$2 ;;
    --most) most=$2 ;;
    *) echo "table.sh: unknown option $1" >&2 && exit 2 ;;
  esac
  shift 2
done
(($# > 0)) || { echo "table.sh: no program given" >&2 && exit 2; }
scenarios=$(cd "$(dirname "$0")/scenarios" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# seconds COMMAND...: its processor time (s), or "stopped"
seconds() {
  local TIMEFORMAT='%U %S' times
  rm -rf "$work/out"
  times=$({ time timeout "$((most * 10))" "$@" >/dev/null 2>"$work/err" || echo stopped; } 2>&1)
  case $times in
    *stopped*) echo stopped ;;
    *) awk '{printf "%.3f\n", $1 + $2}' <<<"$times" ;;
  esac
}
# row NAME COMMAND...: prints the medians; PROGRAM in the command stands for each program
row() {
  local name=$1 program i n=0
  shift
  printf '%-28s' "$name"
  for ((i = 0; i < repetitions; ++i)); do
    n=0
    for program in "${programs[@]}"; do
      n=$((n + 1))
      [[ -e $work/slow.$n ]] || seconds "${@/PROGRAM/$program}" >>"$work/times.$n"
      if ! awk -v most="$most" '$1 == "stopped" || $1 > most {exit 1}' "$work/times.$n"; then touch "$work/slow.$n"; fi
    done
  done
  for ((i = 1; i <= n; ++i)); do
    printf '%12s' "$(sort -g "$work/times.$i" | awk '{a[NR] = $1} END {print a[int((NR + 1) / 2)]}')"
  done
  printf '\n'
  rm -f "$work"/times.* "$work"/slow.*
}

programs=("$@")
echo "Processor time of whole runs (s)"
for scenario in toy-top toy-top-viscous toy-top-tide toy-top-gradient toy-top-coulomb toy-top-platform damped-gyrocompass \
  unbalanced-gyro-600s unbalanced-gyro-hour fast-gyro-20s fast-gyro-40s fast-gyro-60s fast-gyro-day \
  pivot-of-table table-frictionless table-rolling table-viscous table-contensou table-coulomb; do
  row "$scenario" PROGRAM run "$scenarios/$scenario.json" --out "$work/out"
done
echo "Processor time of a study of 1,000 toy tops, on one thread (s)"
row thousand-toy-tops PROGRAM study "$scenarios/thousand-toy-tops.json" --out "$work/out" --jobs 1
for program in "${programs[@]}"; do
  echo "One motion, $program"
  for scenario in asymmetric-10s toy-top; do
    echo " $scenario"
    "$program" bench "$scenarios/$scenario.json" --workload motion --error axis --methods taylor,rkf78 --repetitions 11 --limit 0.2 |
      sed -n -e 's/^Milliseconds/  &/p' -e '/^Milliseconds/,$ {/^   .* double /p}' -e '/ 1e-\(09\|12\) /p'
  done
done
