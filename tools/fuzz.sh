#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Feeds generated texts to the scenario decoder (tests/fuzz/decoder_fuzz.cpp), starting from the shipped scenarios and a
# dictionary of the keys and words that they may hold. Inputs that cause failures are stored in build/fuzz/found, and can be
# passed to decoder_fuzz.
#   tools/fuzz.sh [SECONDS]
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$(nproc)"

work=build/fuzz
mkdir -p "$work/corpus" "$work/seeds" "$work/found"
cp scenarios/*.json "$work/seeds/"
printf '%s\001/site/latitude_deg\00112\001/numerics/method\001dopri5' "$(cat scenarios/toy-top.json)" >"$work/seeds/sets.txt"
{ # every key, pointer and word of the table of fields, and the punctuation and numbers that JSON consists of
  grep -hoE '"[^" ]+"' src/scenario/fields.cpp src/scenario/rules.hpp | tr -d '"' | tr '|' '\n' | grep -E '^[/$A-Za-z0-9_.*-]+$' |
    awk '{ print; if (sub(/.*\//, "") && length) print }' | sort -u | sed 's/.*/"\\"&\\""/'
  grep -oE '"/[^" ]+"' src/scenario/fields.cpp | tr -d '"' | sort -u | sed 's/.*/"\\x01&\\x01"/'
  printf '"%s"\n' '{' '}' '[' ']' ':' ',' '\"' '\\u0000' '\\ud83d' '\\ude00' '0' '-0' '1e308' '1e-320' '1e999' '1e-400' \
    '5e-324' '90' '180' '1e6' '1e9' '1e18' 'null' 'true' 'false' 'NaN' '-Infinity' '//' '\x01' '\xef\xbb\xbf' '\xff\xfe' '_'
} >"$work/words.dict"

"$work/tests/fuzz/decoder_fuzz" -max_total_time="$seconds" -dict="$work/words.dict" -max_len=8192 -timeout=5 -rss_limit_mb=1024 \
  -artifact_prefix="$work/found/" -print_final_stats=1 "$work/corpus" "$work/seeds" 2>&1 |
  grep -vE '^(#[0-9]+[[:space:]]+(REDUCE|NEW|pulse|RELOAD)|[[:space:]]+NEW_FUNC)'
