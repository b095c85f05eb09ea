#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the wheel of the Python package without a network, and installs it into a virtual environment that sees the Python
# packages of the system.
#   tools/python/build.sh [--build BUILD] [VENV]
# BUILD: a release build of this checkout, whose libraries are linked; by default build/release if it exists. Without one the
#        libraries are compiled in build/python/objects.
# VENV:  the virtual environment, build/python/venv by default; it is made if it does not exist.
# The environment variable PYTHON names the interpreter, by default Debian's, to which the packages below belong.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
objects=""
if [[ ${1:-} == --build ]]; then
  objects=$(cd "$2" && pwd)
  shift 2
fi
venv=$(realpath -m "${1:-$root/build/python/venv}")
cd "$root"
tools/install-dependencies.sh --program \
  python3-dev pybind11-dev python3-numpy python3-venv python3-pip python3-setuptools python3-wheel
python=${PYTHON:-/usr/bin/python3}
if ! command -v "$python" >/dev/null; then python=python3; fi

if [[ -z $objects && -f build/release/CMakeCache.txt ]]; then objects=$root/build/release; fi
if [[ -z $objects ]]; then
  objects=$root/build/python/objects
  cmake --preset release -B "$objects" -DEARTHTOP_BUILD_TESTS=OFF -DEARTHTOP_BUILD_TOOLS=OFF -DEARTHTOP_PYTHON=OFF \
    -DEARTHTOP_MPI=OFF -DEARTHTOP_SUNDIALS=OFF
fi

log=build/python/wheel.log
mkdir -p build/python
rm -f build/python/*.whl
echo "Building the wheel; messages go to $log"
if ! EARTHTOP_BUILD=$objects "$python" -m pip --disable-pip-version-check wheel --verbose --no-build-isolation --no-index --no-deps \
  --wheel-dir build/python tools/python >"$log" 2>&1; then
  tail -n 60 "$log" >&2
  exit 1
fi
wheel=$(echo build/python/*.whl)

if [[ ! -x $venv/bin/python ]]; then "$python" -m venv --system-site-packages "$venv"; fi
"$venv/bin/python" -m pip --quiet --disable-pip-version-check install --no-index --force-reinstall --no-deps "$wheel"
"$venv/bin/python" -c 'import earthtop; print("earthtop", earthtop.__version__, "for Python is installed in", earthtop.__path__[0])'
echo "The wheel:  $root/$wheel"
echo "To use it:  source $venv/bin/activate && python -c 'import earthtop as et; print(et.run(et.example(\"toy-top\")))'"

# A notebook names the kernel python3, which elsewhere is the Python of the system: this one is the Python that has the package.
kernels=$venv/share/jupyter/kernels/python3
mkdir -p "$kernels"
"$venv/bin/python" - "$kernels/kernel.json" <<'END'
import json, sys
kernel = {"argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"], "display_name": "Python 3 (earthtop)", "language": "python"}
with open(sys.argv[1], "w", encoding="utf-8") as file:
    json.dump(kernel, file, indent=1)
END
echo "A notebook: JUPYTER_PATH=$venv/share/jupyter $venv/bin/python -m notebook $root/tools/python/examples/first_run.ipynb"
if ! "$venv/bin/python" -c 'import importlib.util as u, sys; sys.exit(not (u.find_spec("notebook") and u.find_spec("ipykernel")))'; then
  echo "            which needs notebook and ipykernel (Debian: python3-notebook, python3-ipykernel)"
fi
