#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the wheel of the Python package as users meet it: built, installed into a clean virtual environment, used from outside the
# source tree, removed.
#   tests/python/wheel_test.sh BUILD     BUILD: a release build whose libraries are linked, with the program
set -euo pipefail
build=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
source_dir=$PWD
version=$(sed -n 's/^project(earthtop VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
unset PYTHONPATH

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
step() { printf -- '-- %s\n' "$*"; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
venv=$work/venv
python() { "$venv/bin/python" -W error "$@"; }

step "Build, install"
git status --porcelain >"$work/before"
tools/python/build.sh --build "$build" "$venv"
git status --porcelain | cmp "$work/before" - || fail "building changed the source tree"
[[ $(echo build/python/*.whl) == build/python/earthtop-"$version"-cp3*-linux_*.whl ]] || fail "there is no wheel of $version alone"
cd "$work"

step "What is linked, and the licence"
package=$(echo "$venv"/lib/*/site-packages/earthtop)
"$source_dir/tests/package/linked_test.py" "$package/earthtop.spdx.json" "$package"/_core.*.so
for archive in erfa GeographicLib gsl; do
  grep -q "\"SPDXRef-lib$archive.a\"" "$package/earthtop.spdx.json" || fail "lib$archive.a is linked and not listed"
done
cmp "$source_dir/LICENSE" "$package/LICENSE"
if grep -rlaF "$source_dir" "$package" --exclude='*.pyc'; then fail "these files name the directory in which they were built"; fi

step "Import, run"
[[ $(python -c 'import earthtop; print(earthtop.__path__[0])') == "$venv"/lib/*/earthtop ]] || fail "another earthtop is imported"
[[ $(python -c 'import earthtop; from importlib.metadata import version; print(version("earthtop"), earthtop.__version__)') == "$version $version" ]] ||
  fail "the versions are not $version"
python "$source_dir/tests/python/needs.py" || fail "it states a wrong need of NumPy"
"$build/tools/earthtop/earthtop" run "$source_dir/scenarios/toy-top.json" --out by-program --quiet
python -c 'import earthtop as et; et.run(et.example("toy-top")).save("by-python")'
for file in trajectory.csv summary.json drift.svg; do cmp by-program/$file by-python/$file; done
# What takes long to import is imported only when it is used. Processor time, the best of five; NumPy's own is most of it.
python - "$venv/bin/python" <<'END' || fail "importing earthtop takes too long"
import resource
import subprocess
import sys


def seconds(code):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.argv[1], "-c", code], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


taken = min(seconds("import earthtop, sys; assert not {'pandas', 'matplotlib', 'mpmath', 'IPython'} & set(sys.modules)") for _ in range(5))
print(f"import: {taken:.3f} s of processor time, of which NumPy {min(seconds('import numpy') for _ in range(5)):.3f} s")
sys.exit(taken >= 0.2)
END

step "The manual and the docstrings, by the installed package"
python -m pytest -q -p no:cacheprovider "$source_dir/tests/python/test_documentation.py"

step "Remove"
"$venv/bin/python" -m pip --quiet --disable-pip-version-check uninstall --yes earthtop
[[ -z $(find "$venv"/lib/*/site-packages -iname '*earthtop*') ]] || fail "files are left after removal"
echo "The wheel installs, works and goes."
