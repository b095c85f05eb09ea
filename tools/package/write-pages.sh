#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes what the program prints about itself to DIR: man/man1/*.1.gz, earthtop.bash, .zsh and .fish, schema/*.json.
#   tools/package/write-pages.sh DIR PROGRAM...
set -euo pipefail

dir=$1
program=("${@:2}")
rm -rf "$dir"
mkdir -p "$dir/man/man1" "$dir/schema"

"${program[@]}" man --all "$dir/man/man1"
gzip -9n "$dir"/man/man1/*.1 # without name and time, so that the same program gives the same bytes

for shell in bash zsh fish; do
  "${program[@]}" completion "$shell" >"$dir/earthtop.$shell"
done

"${program[@]}" schema >"$dir/schema/earthtop-scenario-1.json"
for kind in study mapping tolerances; do
  "${program[@]}" schema "--$kind" >"$dir/schema/earthtop-$kind-1.json"
done
for schema in "$dir"/schema/*.json; do
  grep -q "\"\$id\": \"${schema##*/}\"" "$schema" # the name by which files refer to it
done

touch "$dir/written"
