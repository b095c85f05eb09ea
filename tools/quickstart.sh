#!/usr/bin/env bash
# From a fresh checkout to a first result: installs what is missing, builds the program, runs scenarios/toy-top.json.
set -euo pipefail
cd "$(dirname "$0")/.."

tools/install-dependencies.sh
cmake --preset release
cmake --build --preset release --parallel "$(nproc)" --target earthtop-tool
program=build/release/tools/earthtop/earthtop
out=out/toy-top

echo
echo "\$ $program run scenarios/toy-top.json --out $out --force"
"$program" run scenarios/toy-top.json --out "$out" --force
echo
echo "The files are in $PWD/$out: $(cd "$out" && echo *)"
