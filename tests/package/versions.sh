#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The version is written once, in project() of the top CMakeLists.txt. Everything else that states it must agree: what a build
# made of it, and the two files written by hand, whose newest release must have this version and date.
#   tests/package/versions.sh BUILD VERSION PROGRAM
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$1 version=$2 program=$3
status=0

expect() { # WHERE FOUND EXPECTED
  if [[ $2 != "$3" ]]; then
    echo "$1: found \"$2\", expected \"$3\"" >&2
    status=1
  fi
}
of_yaml() { sed -n "s/^$1: *\"\{0,1\}\([^\"]*\)\"\{0,1\}\$/\1/p" .github/CITATION.cff; }

# ## [1.2.3] - 2026-01-31, the first of them
read -r released _ date < <(sed -n 's/^## \[\([0-9.]*\)\] \(-\) \(.*\)/\1 \2 \3/p' .github/CHANGELOG.md)
expect "newest release in .github/CHANGELOG.md" "$released" "$version"
expect "its date, as GNU date reads it" "$date" "$(date --date="$date" +%F)"
expect "version in .github/CITATION.cff" "$(of_yaml version)" "$version"
expect "date-released in .github/CITATION.cff" "$(of_yaml date-released)" "$date"
expect "earthtop version" "$("$program" version | head -n 1)" "earthtop $version"
for file in "$build"/earthtop*.pc; do
  expect "$file" "$(sed -n 's/^Version: //p' "$file")" "$version"
done
expect "earthtop-config-version.cmake" "$(sed -n 's/^set(PACKAGE_VERSION "\(.*\)")/\1/p' "$build/earthtop-config-version.cmake")" "$version"
expect "CPackConfig.cmake" "$(sed -n 's/^set(CPACK_PACKAGE_VERSION "\(.*\)")/\1/p' "$build/CPackConfig.cmake")" "$version"
exit "$status"
