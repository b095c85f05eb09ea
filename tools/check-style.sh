#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks the formatting of every C++ file, the syntax of every script and Python file, the licence line in all of them, and that the nightly
# workflow has every job.
#   tools/check-style.sh [--fix]     --fix: format the files instead of checking their format
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -t sources < <(find include src tests tools -type f \( -name '*.hpp' -o -name '*.ipp' -o -name '*.cpp' \) | LC_ALL=C sort)
if [[ ${1:-} == --fix ]]; then
  clang-format -i "${sources[@]}"
else
  clang-format --dry-run -Werror "${sources[@]}"
fi
for script in tools/*.sh tools/*/*.sh tools/slurm/*.sbatch tests/*/*.sh tools/package/python/* .ci/run; do bash -n "$script"; done
# Python 3.9 is the oldest that the package is for.
find tests tools -type f \( -name '*.py' -o -name '*.pyi' \) -print0 | xargs -0 python3 -c '
import ast, pathlib, sys
for path in sys.argv[1:]:
    ast.parse(pathlib.Path(path).read_text(encoding="utf-8"), path, feature_version=(3, 9))'

unlicensed=$(find CMakeLists.txt .ci include src tests tools -type f \( -name '*.[hic]pp' -o -name '*.js' -o -name '*.css' -o -name '*.sh' \
  -o -name '*.sbatch' -o -name '*.py' -o -name '*.pyi' -o -name pyproject.toml -o -path 'tools/package/python/*' -o -name '*.cmake' -o -name '*.hpp.in' -o -name '*.cmake.in' -o -name '*.pc.in' -o -name CMakeLists.txt -o -path .ci/run \) -print0 |
  xargs -0 grep -L 'SPDX-License-Identifier: GPL-3.0-or-later' || true)
if [[ -n $unlicensed ]]; then
  printf 'no licence, SPDX-License-Identifier: GPL-3.0-or-later, in its first lines:\n%s\n' "$unlicensed" >&2
  exit 1
fi

jobs=$(sed -n 's/^ *job: \[\(.*\)\]$/\1/p' .github/workflows/nightly.yml)
if [[ $jobs != "$(.ci/run --list | paste -sd, | sed 's/,/, /g')" ]]; then
  printf 'the jobs in .github/workflows/nightly.yml are not those of .ci/run --list\n' >&2
  exit 1
fi
