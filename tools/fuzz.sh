#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Feeds generated inputs to the doors of the program (tests/fuzz): every kind of text and file that it reads, and the words that it
# puts into pages. Each door begins with the shipped files of its kind, the inputs kept in tests/fuzz/corpus, and what earlier calls
# found to be new (build/fuzz/corpus). Inputs that break a property are stored in build/fuzz/found; the smallest of each kind
# belongs into tests/fuzz/corpus/DOOR, from where a test replays it. Ends with status 1 if there is one.
#   tools/fuzz.sh [SECONDS [DOOR...]]     SECONDS for each door, by default 30; without DOOR four doors, others every day;
#                                         "all": every door
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-30}
shift || true
cmake --preset asan >/dev/null
cmake --build --preset asan --parallel "$(nproc)" --target earthtop-fuzz

program=$PWD/build/asan/tests/fuzz/earthtop-fuzz
work=$PWD/build/fuzz
mapfile -t all < <(FUZZ_LIST=1 "$program")
doors=("$@")
if [[ ${1:-} == all ]]; then doors=("${all[@]}"); fi
if [[ $# -eq 0 ]]; then
  day=$(($(date +%s) / 86400))
  for i in 0 1 2 3; do doors+=("${all[(day * 4 + i) % ${#all[@]}]}"); done
fi

memory=/dev/shm
if [[ ! -w $memory ]]; then memory=${TMPDIR:-/tmp}; fi
scratch=$(mktemp -d "$memory/earthtop-fuzz-XXXXXX")
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$work/found" "$work/logs"
{ # every key, pointer and word of the tables of fields, and the punctuation and numbers that JSON and CSV consist of
  grep -hoE '"[^" ]+"' src/scenario/fields.cpp src/scenario/rules.hpp src/study/fields.cpp src/compare/fields.cpp src/measure/columns.cpp |
    tr -d '"' | tr '|' '\n' | grep -E '^[/$A-Za-z0-9_.*-]+$' |
    awk '{ print; if (sub(/.*\//, "") && length) print }' | sort -u | sed 's/.*/"\\"&\\""/'
  grep -oE '"/[^" ]+"' src/scenario/fields.cpp | tr -d '"' | sort -u | sed 's/.*/"\\x01&\\x01"/'
  printf '"%s"\n' '{' '}' '[' ']' ':' ',' ';' '\x09' '\x0a' '\"' '\\u0000' '\\ud83d' '\\ude00' '0' '-0' '1e308' '1e-320' '1e999' \
    '1e-400' '5e-324' '90' '180' '1e6' '1e9' '1e18' 'null' 'true' 'false' 'nan' 'NaN' '-Infinity' '//' '\x01' '\xef\xbb\xbf' \
    '\xff\xfe' '_' 't_s' '</script>' '<' '&' ']]>'
} >"$work/words.dict"

# fuzz DOOR: one line of the table
fuzz() {
  local door=$1 log="$work/logs/$1" status=ok begin=$SECONDS
  local corpus="$work/corpus/$door" kept="tests/fuzz/corpus/$door" seeds="$scratch/$door/seeds"
  mkdir -p "$corpus" "$seeds"
  export TMPDIR="$scratch/$door" FUZZ_DOOR=$door
  FUZZ_SEEDS=$seeds "$program"
  if [[ -d $kept ]]; then cp "$kept"/* "$seeds/"; fi
  "$program" -max_total_time="$seconds" -dict="$work/words.dict" -max_len=131072 -len_control=0 -timeout=60 -rss_limit_mb=2048 \
    -artifact_prefix="$work/found/$door-" -print_final_stats=1 "$corpus" "$seeds" >"$log" 2>&1 || status=FAILED
  local executions last
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  last=$(grep -aE '^#[0-9]+.*cov: ' "$log" | tail -1)
  figure() { sed -nE "s/.* $1: ([^ ]+).*/\1/p" <<<"$last"; }
  printf '%-22s %5d s %10s %7s %7s %12s  %s\n' "$door" $((SECONDS - begin)) "${executions:-0}" "$(figure cov)" "$(figure ft)" \
    "$(figure corp)" "$status"
  if [[ $status == ok ]]; then return 0; fi
  grep -aE 'BROKEN|ERROR|runtime error|Test unit|not so' -A2 "$log" | grep -avE '^ +#' | cut -c1-2000 | head -12
  return 1
}

printf '%-22s %7s %10s %7s %7s %12s\n' door time executions cov ft corpus
failed=0 running=0
for door in "${doors[@]}"; do
  if [[ $running -ge $(nproc) ]]; then wait -n || failed=1; else running=$((running + 1)); fi
  fuzz "$door" &
done
while [[ $running -gt 0 ]]; do wait -n || failed=1; running=$((running - 1)); done
exit "$failed"
