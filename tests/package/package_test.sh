#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the Debian packages as users meet them: built, checked by lintian, installed, used from outside the source tree,
# removed.
#   tests/package/package_test.sh [BUILD]     BUILD: a release build to package, see tools/package.sh
# Installing takes root. Without it the packages are built and judged only.
set -euo pipefail
cd "$(dirname "$0")/../.."
source_dir=$PWD
packages=(earthtop libearthtop-dev python3-earthtop)

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
step() { printf -- '-- %s\n' "$*"; }
is_installed() { dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

for package in "${packages[@]}"; do
  if is_installed "$package"; then fail "$package is installed already; this test would remove it"; fi
done

step "Build"
tools/install-dependencies.sh lintian man-db bash-completion file
tools/package.sh "$@"
debs=()
for package in "${packages[@]}"; do debs+=(build/packages/"$package"_*.deb); done
version=$(sed -n 's/^project(earthtop VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

step "lintian"
lintian --allow-root --fail-on error,warning "${debs[@]}"
for deb in "${debs[@]}"; do
  [[ $(dpkg-deb -f "$deb" Version) == "$version"-* ]] || fail "$deb is not of version $version"
done

work=$(mktemp -d)
chmod 755 "$work"
clean_up() {
  if [[ $(id -u) -eq 0 ]]; then dpkg --purge "${packages[@]}" >/dev/null 2>&1 || true; fi
  rm -rf "$work"
}
trap clean_up EXIT

step "No file names the directory in which it was built"
mkdir "$work/unpacked"
for deb in "${debs[@]}"; do dpkg-deb --raw-extract "$deb" "$work/unpacked/$(basename "$deb")"; done
[[ -s $(echo "$work"/unpacked/libearthtop-dev_*/usr/lib/*/libearthtop.a) ]] || fail "no archive is looked into"
find "$work/unpacked" -name '*.gz' -exec gunzip {} +
if grep -rlaF -e "$source_dir" -e "$(realpath "${1:-build/packages}")" "$work/unpacked"; then fail "these files name it"; fi
rm -r "$work/unpacked"

if [[ $(id -u) -ne 0 ]]; then
  echo "Not root: the packages were built and judged, but not installed and used."
  exit 0
fi

step "Install"
apt_get() { DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 "$@"; }
# Some images drop manuals and documentation when packages are unpacked; here these are part of the test.
everything=(-o 'Dpkg::Options::=--path-include=/usr/share/*')
apt_get install --no-install-recommends "${everything[@]}" "${debs[@]/#/./}" >"$work/apt.log" 2>&1 ||
  { cat "$work/apt.log" && fail "apt does not install them"; }
dpkg --listfiles "${packages[@]}" | sort -u >"$work/listed"
grep -q / "$work/listed" || fail "the packages have no files"
dpkg --verify "${packages[@]}" | grep . && fail "installed files are not those of the packages"
cd "$work"

step "The program, from PATH"
[[ $(command -v earthtop) == /usr/bin/earthtop ]] || fail "earthtop in PATH is $(command -v earthtop)"
earthtop version | grep -qxF "earthtop $version" || fail "earthtop version does not say $version"
file /usr/bin/earthtop | grep -q ', stripped' || fail "the program is not stripped"
if readelf -d /usr/bin/earthtop | grep -E 'R(UN)?PATH'; then fail "the program has a path of its own to libraries"; fi
earthtop example toy-top >toy-top.json
earthtop run toy-top.json --set /motion/duration_s=1 --out by-name --quiet
earthtop run /usr/share/earthtop/scenarios/toy-top.json --set /motion/duration_s=1 --out installed --quiet
cmp by-name/trajectory.csv installed/trajectory.csv
earthtop check /usr/share/doc/earthtop/examples/*.json >check.log || { cat check.log && fail "an example has a mistake"; }

step "What is linked"
for pair in /usr/share/doc/earthtop:/usr/bin/earthtop /usr/lib/python3/dist-packages/earthtop:"$(echo /usr/lib/python3/dist-packages/earthtop/_core.*.so)"; do
  "$source_dir/tests/package/linked_test.py" "${pair%%:*}/earthtop.spdx.json" "${pair#*:}"
done

step "Schemas"
for kind in scenario study mapping tolerances; do
  python3 -m json.tool "/usr/share/earthtop/schema/earthtop-$kind-1.json" >/dev/null || fail "no schema of a $kind"
done
earthtop schema | cmp - /usr/share/earthtop/schema/earthtop-scenario-1.json

step "Completion in bash"
# As in a shell: bash-completion finds the file by the program's name, and its function is called for the word being typed.
completions_of() {
  bash --norc -c '
    source /usr/share/bash-completion/bash_completion
    _completion_loader earthtop
    [[ $(complete -p earthtop) =~ -F\ ([^ ]+) ]] || exit
    COMP_WORDS=(earthtop "$1") COMP_CWORD=1 COMP_LINE="earthtop $1" COMP_POINT=$((9 + ${#1}))
    "${BASH_REMATCH[1]}" earthtop "$1" earthtop
    printf "%s\n" "${COMPREPLY[@]}"' bash "$1"
}
[[ $(completions_of expl) == explain ]] || fail "bash completes \"earthtop expl\" to: $(completions_of expl)"
mapfile -t verbs < <(completions_of '' | grep '^[a-z]')
[[ " ${verbs[*]} " == *" run "*" version "* ]] || fail "bash knows these verbs only: ${verbs[*]}"
[[ -s /usr/share/zsh/vendor-completions/_earthtop && -s /usr/share/fish/vendor_completions.d/earthtop.fish ]] ||
  fail "no completions for zsh and fish"

step "Manual"
MANPAGER=cat MANWIDTH=80 man earthtop-run >page.txt || fail "man does not find earthtop-run"
grep -qi 'earthtop.run' page.txt || fail "man earthtop-run shows another page"
for verb in "${verbs[@]}"; do
  man --where "earthtop-$verb" >/dev/null || fail "no page of earthtop $verb"
done

step "The library, by CMake and by pkg-config"
scenario=/usr/share/earthtop/scenarios/toy-top.json
cmake -S "$source_dir/tests/consumer" -B cmake -G Ninja -DCMAKE_BUILD_TYPE=Release >cmake.log 2>&1 ||
  { cat cmake.log && fail "CMake does not find the package"; }
cmake --build cmake >cmake.log 2>&1 || { cat cmake.log && fail "the consumer does not build"; }
cmake/consumer "$scenario"
cmake/workbench_consumer "$scenario" study
[[ $(pkg-config --modversion earthtop) == "$version" ]] || fail "earthtop.pc is not of version $version"
# shellcheck disable=SC2046  # flags are words
g++ -std=gnu++20 "$source_dir/tests/consumer/consumer.cpp" -o consumer $(pkg-config --cflags --libs --static earthtop)
./consumer "$scenario"
# shellcheck disable=SC2046
g++ -std=gnu++20 "$source_dir/tests/consumer/workbench_consumer.cpp" -o workbench $(pkg-config --cflags --libs --static earthtop-workbench)
./workbench "$scenario" other-study

step "The Python package, by the system's Python"
python() { env -u PYTHONPATH /usr/bin/python3 -W error "$@"; }
package_dir=/usr/lib/python3/dist-packages/earthtop
[[ $(python -c 'import earthtop; print(earthtop.__path__[0])') == "$package_dir" ]] || fail "Python imports another earthtop"
[[ $(python -c 'from importlib.metadata import version; print(version("earthtop"))') == "$version" ]] ||
  fail "the Python package's metadata are not of version $version"
python "$source_dir/tests/python/needs.py" "$(dpkg-query -W -f='${Depends}' python3-earthtop)" || fail "it states a wrong need of NumPy"
python -c '
import earthtop as et
result = et.run(et.example("toy-top"), duration_s=1)
assert len(et.examples()) > 20 and not result.q_LB.flags.writeable
result.save("from-python")' || fail "a run in Python"
cmp by-name/trajectory.csv from-python/trajectory.csv
[[ -s $(echo "$package_dir"/__pycache__/__init__.*.pyc) ]] || fail "the modules have not been compiled to byte code"
file "$package_dir"/_core.*.so | grep -q ', stripped' || fail "the extension is not stripped"
if readelf -d "$package_dir"/_core.*.so | grep -E 'R(UN)?PATH'; then fail "the extension has a path of its own to libraries"; fi

step "Remove"
apt_get purge "${packages[@]}" >apt.log 2>&1 || { cat apt.log && fail "apt does not remove them"; }
left=()
while read -r path; do # a directory may be another package's as well
  if [[ -e $path || -L $path ]] && ! dpkg-query --search "$path" >/dev/null 2>&1; then left+=("$path"); fi
done < <(grep '^/.' "$work/listed" | grep -vx '/\.')
[[ ! -e $package_dir ]] || left+=("$package_dir") # with byte code that no package lists
[[ ${#left[@]} -eq 0 ]] || fail "left after removal: ${left[*]}"
for package in "${packages[@]}"; do
  if dpkg-query -W "$package" >/dev/null 2>&1; then fail "$package is still known to dpkg"; fi
done
echo "The packages install, work and go."
