#!/usr/bin/env bash
# One hash of the numerical columns, whatever compiler, optimisation and instruction set: trajectory.csv of every shipped scenario,
# every method, every precision.
#   tools/determinism.sh PROGRAM...     the hashes of these builds of earthtop
#   tools/determinism.sh [--quick]      builds the matrix first, in build/determinism: g++ and clang++, -O0 to -O3, without and with
#                                       -march=native; --quick: -O0 and -O3 only
# Status: 0 where all hashes are one, 1 where they are not.
set -euo pipefail
cd "$(dirname "$0")/.."

results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

# hash_of PROGRAM: of its trajectories; their own go to $list
hash_of() {
  local program=$1 scenario name method precision
  rm -rf "${results:?}"/*
  for scenario in scenarios/*.json; do
    name=$(basename "$scenario" .json)
    "$program" run "$scenario" --quiet --out "$results/$name" >/dev/null
  done
  for method in taylor dopri5 rkf78 bulirsch_stoer extrapolation dop853 gauss splitting long_horizon; do
    "$program" run scenarios/toy-top.json --quiet --out "$results/method-$method" --set /motion/duration_s=0.5 \
      --set "/numerics/method=$method" --set /motion/output_step_s=0.05 >/dev/null
  done
  for precision in long_double float128; do
    "$program" run scenarios/asymmetric-top.json --quiet --out "$results/precision-$precision" --set /motion/duration_s=0.2 \
      --set "/numerics/precision=$precision" --set /motion/output_step_s=0.05 >/dev/null
  done
  (cd "$results" && find . -name trajectory.csv | LC_ALL=C sort | xargs sha256sum) | tee "${list:-/dev/null}" | sha256sum | cut -c1-16
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
          "-DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -O$level $native" -DEARTHTOP_PRECOMPILE_HEADERS=ON \
          -DEARTHTOP_UNITY=ON >/dev/null
        cmake --build "$build" --parallel "$(nproc)" --target earthtop-tool >/dev/null
        names+=("$name")
        programs[$name]=$build/tools/earthtop/earthtop
      done
    done
  done
fi

declare -A seen
for name in "${names[@]}"; do
  hash=$(list=$results.list hash_of "${programs[$name]}")
  printf '%-32s %s\n' "$name" "$hash"
  seen[$hash]=1
  if [[ ${#seen[@]} -gt 1 ]]; then
    printf 'differs in:\n'
    diff <(cut -c1-300 "$results.first") <(cut -c1-300 "$results.list") | sed -n 's/^> [0-9a-f]*  /  /p'
  else
    mv "$results.list" "$results.first"
  fi
done
rm -f "$results.first" "$results.list"
[[ ${#seen[@]} -eq 1 ]]
