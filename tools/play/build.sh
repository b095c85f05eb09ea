#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the page to play with: the core library compiled to WebAssembly, and one HTML file with it inside.
#   tools/play/build.sh [FILE]     default: build/play/earthtop.html
set -euo pipefail
cd "$(dirname "$0")/../.."

tools/install-dependencies.sh --program emscripten nodejs binutils python3
page=${1:-build/play/earthtop.html}
engine=build/play/engine
# Debian's optimiser of JavaScript needs node-acorn from here, also beside a Node that is not Debian's.
export NODE_PATH=/usr/share/nodejs
emcmake cmake -S tools/play/engine -B "$engine" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
NINJA_STATUS='[%p after %e s] ' ninja -C "$engine" -j "$(nproc)" engine
mkdir -p "$(dirname "$page")"
python3 tools/play/assemble.py "$engine/engine.js" "$engine/engine.wasm" "$page"
echo "The page is $page: open it in a browser."
