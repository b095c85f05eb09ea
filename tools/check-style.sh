#!/usr/bin/env bash
# Formatting of every C++ file, and the syntax of every script. `tools/check-style.sh --fix` formats the files instead.
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -t sources < <(find include src tests tools -type f \( -name '*.hpp' -o -name '*.ipp' -o -name '*.cpp' \) | LC_ALL=C sort)
if [[ ${1:-} == --fix ]]; then
  clang-format -i "${sources[@]}"
else
  clang-format --dry-run -Werror "${sources[@]}"
fi
for script in tools/*.sh tools/*/*.sh tests/*/*.sh .ci/run; do bash -n "$script"; done
