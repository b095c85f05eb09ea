#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The program as one file against the program that loads libraries: the same bytes for every scenario that comes with it and for a study, also
# in an empty directory and on an old processor.
#   tests/package/static_test.sh STATIC PROGRAM
# As root also in a directory that is all it sees; with qemu-x86_64 (qemu-user) also on a processor without what came after SSE3.
set -euo pipefail
static=$(realpath "$1")
program=$(realpath "$2")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "FAILED: $*" >&2
  exit 1
}

if readelf -lW "$static" | grep -E 'INTERP|DYNAMIC'; then fail "$static loads libraries"; fi

numbers() { # a summary without what built the program
  python3 -c '
import json, sys
summary = json.load(open(sys.argv[1]))
summary["provenance"] = summary["provenance"]["constants"]
del summary["checksum"]
print(json.dumps(summary, indent=1))' "$1"
}
same() { # DIRECTORY DIRECTORY
  cmp "$1/trajectory.csv" "$2/trajectory.csv" && cmp <(numbers "$1/summary.json") <(numbers "$2/summary.json")
}
run() { "$@" --quiet || [[ $? -eq 3 ]]; } # 3: numerical trouble, but with results

count=0
for scenario in scenarios/*.json; do
  name=$(basename "$scenario" .json)
  run "$program" run "$scenario" --out "$work/loads/$name"
  run "$static" run "$scenario" --out "$work/static/$name"
  same "$work/loads/$name" "$work/static/$name" || fail "$name has other numbers"
  count=$((count + 1))
done
echo "$count scenarios: the same bytes"

cat >"$work/study.json" <<'JSON'
{ "$schema": "earthtop-study-1.json", "name": "latitudes", "base": "toy-top.json", "set": { "/motion/duration_s": 0.5 },
  "axes": [ { "pointer": "/site/latitude_deg", "range": { "from": -80, "to": 80, "points": 17 } } ],
  "collect": ["drift.axis_final_rad", "drift.axis_bound_rad"] }
JSON
cp scenarios/toy-top.json "$work"
study() { # NAME COMMAND...: points are computed several at a time, by what the processor has
  (cd "$work" && "${@:2}" study study.json --out "$1" --force --quiet >/dev/null) && tail -n +2 "$work/$1/study.csv" >"$work/$1.csv"
}
study by-loading "$program"
study by-static "$static"
cmp "$work"/by-{loading,static}.csv || fail "a study has other numbers"
echo "A study: the same bytes"

if [[ $(id -u) -eq 0 ]]; then
  mkdir "$work/empty"
  cp "$static" "$work/empty/earthtop"
  chroot "$work/empty" /earthtop example heavy-top-benchmark >"$work/empty/top.json" || fail "no example in an empty directory"
  run chroot "$work/empty" /earthtop run toy-top --out /results || fail "it does not run in an empty directory"
  same "$work/empty/results" "$work/static/toy-top" || fail "other numbers in an empty directory"
  echo "An empty directory: the same bytes"
fi
if command -v qemu-x86_64 >/dev/null; then
  for processor in qemu64 Nehalem; do
    old=(qemu-x86_64 -cpu "$processor")
    run "${old[@]}" "$static" run scenarios/toy-top.json --out "$work/$processor" 2>"$work/log" || { cat "$work/log" && fail "not on $processor"; }
    same "$work/$processor" "$work/static/toy-top" || fail "other numbers on $processor"
    study "by-$processor" "${old[@]}" "$static"
    cmp "$work"/by-{static,"$processor"}.csv || fail "a study has other numbers on $processor"
    echo "$processor: the same bytes"
  done
fi
