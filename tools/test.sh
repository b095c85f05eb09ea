#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The gate: installs missing packages, builds with warnings as errors, and runs every test labelled `gate`. The other tests, labelled
# `nightly`, and those of the Python package are run by .ci/run.
# Its exit status and last lines are CTest's. Arguments are passed to CTest:  tools/test.sh -R Torques
set -euo pipefail
cd "$(dirname "$0")/.."

tools/install-dependencies.sh python3 python3-jsonschema
jobs=$(nproc)
# Otherwise ccache, where it is installed, keeps nothing that was compiled with a precompiled header.
export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}
cmake --preset release -Werror=dev -DEARTHTOP_WERROR=ON -DEARTHTOP_BUILD_TESTS=ON -DEARTHTOP_BUILD_TOOLS=ON -DEARTHTOP_PYTHON=OFF \
  -DEARTHTOP_NIGHTLY_TESTS=OFF -DEARTHTOP_SLOW_TESTS=OFF -DEARTHTOP_PRECOMPILE_HEADERS=ON
cmake --build --preset release --parallel "$jobs"
exec ctest --test-dir build/release --label-regex '^gate$' --no-tests=error --output-on-failure --parallel "$jobs" "$@"
