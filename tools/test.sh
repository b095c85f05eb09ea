#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The release suite: installs what is missing, builds with warnings as errors, runs every test that is labelled
# neither `slow` nor `extra` (one more of what the others see, which .ci/run runs after it).
# Its status and its last lines are CTest's. Arguments go to CTest:  tools/test.sh -R Torques
set -euo pipefail
cd "$(dirname "$0")/.."

tools/install-dependencies.sh python3 python3-jsonschema
jobs=$(nproc)
cmake --preset release -DEARTHTOP_WERROR=ON -DEARTHTOP_BUILD_TESTS=ON -DEARTHTOP_BUILD_TOOLS=ON -DEARTHTOP_SLOW_TESTS=OFF \
  -DEARTHTOP_PRECOMPILE_HEADERS=ON
cmake --build --preset release --parallel "$jobs"
exec ctest --test-dir build/release --label-exclude '^(slow|extra)$' --no-tests=error --output-on-failure --parallel "$jobs" "$@"
