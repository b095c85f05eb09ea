#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes every file of a release, in one folder, with checksums and a README.md that says what each is: source distribution, wheels for the
# Pythons of Debian 12 and 13, Debian packages, the program as one file and as a container, the gallery, the page to play with.
#   tools/release.sh [--without-play] [FOLDER]     FOLDER: build/release-files by default; it is emptied
#   --without-play: without the page to play with, whose compiler takes 800 MB
# It is made on Debian 12, so that it runs on that and on what is newer, of a checkout without changes. The same commit gives the same bytes. It
# takes root, by which mmdebstrap unpacks the Python of Debian 13 into build/python/debian13.
set -euo pipefail
cd "$(dirname "$0")/.."

play=1
if [[ ${1:-} == --help ]]; then
  sed -n '3,/^[^#]/s/^# \{0,1\}//p' "$0"
  exit
fi
if [[ ${1:-} == --without-play ]]; then
  play=0
  shift
fi
refuse() {
  echo "tools/release.sh: $1" >&2
  exit 2
}
case ${1:-} in -*) refuse "there is no option $1; see tools/release.sh --help" ;; esac
mkdir -p "${1:-build/release-files}"
folder=$(cd "${1:-build/release-files}" && pwd)
[[ -z $(ls -A "$folder") || -e $folder/SHA256SUMS ]] || refuse "$folder is not empty, and no release is in it"
[[ $(. /etc/os-release && echo "${VERSION_CODENAME:-}") == bookworm && $(uname -m) == x86_64 ]] ||
  refuse "a release is made on Debian 12 for x86-64, so that it runs on that and on what is newer"
changes=$(git status --porcelain) || refuse "this is no checkout of a commit"
[[ -z $changes ]] || refuse $'there are changes that are not in the commit:\n'"$changes"
[[ $(id -u) -eq 0 ]] || refuse "mmdebstrap takes root to unpack the Python of Debian 13"

umask 022
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
version=$(sed -n 's/^project(earthtop VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
objects=build/packages/objects
static=$folder/earthtop-$version-x86_64
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
step() { printf -- '-- %s\n' "$*"; }
quietly() { "$@" >"$work/log" 2>&1 || { tail -n 30 "$work/log" >&2 && exit 1; }; }
packed() { tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner -C "$1" -cf - "$2" | gzip -9n; }

tools/install-dependencies.sh python3-dev pybind11-dev python3-numpy python3-pip python3-setuptools python3-wheel mmdebstrap buildah file
rm -rf "${folder:?}"/*
touch "$folder/SHA256SUMS" # by which the next call knows the folder

step "Debian packages"
quietly tools/package.sh
cp build/packages/*.deb "$folder"

step "The program as one file"
quietly cmake -S . -B $objects -DEARTHTOP_STATIC=ON
quietly cmake --build $objects --parallel "$(nproc)" --target earthtop-static earthtop-static-list
strip -o "$static" $objects/tools/earthtop/earthtop-static
chmod 755 "$static"
python3 tools/package/licences.py $objects/earthtop-static.spdx.json >"$folder/earthtop-$version-licences.txt"

step "Container"
cp "$static" "$work/earthtop"
cp "$folder/earthtop-$version-licences.txt" "$work/licences.txt"
store=(--root "$work/store" --runroot "$work/run" --storage-driver vfs)
buildah "${store[@]}" build --quiet --isolation chroot --timestamp "$SOURCE_DATE_EPOCH" --file tools/package/Containerfile \
  --tag "earthtop:$version" "$work" >/dev/null
buildah "${store[@]}" push --quiet "earthtop:$version" "docker-archive:$folder/earthtop-$version-container.tar:localhost/earthtop:$version"

step "Source distribution"
quietly env -C tools/python /usr/bin/python3 -c 'import setuptools.build_meta as b, sys; b.build_sdist(sys.argv[1])' "$folder"

# Both wheels by this system's compiler, so that they run on it; of Debian 13 are only Python's headers, pybind11, pip and setuptools.
python13=$PWD/build/python/debian13
if [[ ! -x $python13/usr/bin/python3-from-here ]]; then
  step "The Python of Debian 13"
  rm -rf --one-file-system "$python13"
  mkdir -p "$python13"
  mmdebstrap --quiet --mode=root --variant=minbase --dpkgopt=force-unsafe-io \
    --include=python3-dev,pybind11-dev,python3-numpy,python3-pip,python3-setuptools,python3-wheel trixie "$python13" http://deb.debian.org/debian
  # The only headers taken are those of Python and pybind11: the compiler must not see another C library's.
  find "$python13"/usr/include{,/x86_64-linux-gnu} -mindepth 1 -maxdepth 1 ! -name 'python3*' ! -name pybind11 ! -name x86_64-linux-gnu \
    -exec rm -rf {} +
  libraries=$python13/usr/lib/x86_64-linux-gnu
  cat >"$python13/usr/bin/python3-from-here" <<END
#!/bin/sh
exec "$python13/lib64/ld-linux-x86-64.so.2" --argv0 "\$0" --library-path "$libraries:$libraries/blas:$libraries/lapack" \\
  "$python13/usr/bin/python3" "\$@"
END
  chmod 755 "$python13/usr/bin/python3-from-here"
fi
wheel() { # PYTHON ROOT
  local made=$work/wheels
  rm -rf "$made"
  quietly env EARTHTOP_BUILD="$PWD/$objects" CMAKE_ARGS="-DEARTHTOP_PYTHON_ALONE=ON -Dpybind11_DIR=$2/usr/lib/cmake/pybind11" \
    "$1" -m pip --disable-pip-version-check wheel --verbose --no-build-isolation --no-index --no-deps --wheel-dir "$made" tools/python
  python3 tools/package/wheel.py make "$made"/*.whl "$folder" "$2/" >/dev/null
}
step "Wheel for Python 3.11"
wheel /usr/bin/python3 ""
step "Wheel for Python 3.13"
wheel "$python13/usr/bin/python3-from-here" "$python13"

if "$static" help gallery >/dev/null 2>&1; then
  step "Gallery"
  "$static" gallery "$work/earthtop-$version-gallery" >/dev/null
  packed "$work" "earthtop-$version-gallery" >"$folder/earthtop-$version-gallery.tar.gz"
fi
if [[ $play == 1 ]]; then
  step "The page to play with"
  quietly tools/play/build.sh "$folder/earthtop-$version.html"
fi

# The release's own README.md: of the manual's part on the files, what there is.
awk -v version="$version" -v folder="$folder" '
  { gsub("VERSION", version) }
  /^## / { present = system("test -e \"" folder "/" $2 "\"") == 0 }
  present && !/^<!--/
' tools/package/README.md | sed -E "s/\[([^]]*)\]\(\.\.[^)]*\)/\1/g; 1i # earthtop $version\n" >"$folder/README.md"
for file in "$folder"/*; do
  name=${file##*/}
  [[ $name == README.md || $name == SHA256SUMS ]] || grep -qxF "## $name" "$folder/README.md" || refuse "tools/package/README.md does not say what $name is"
done
(cd "$folder" && LC_ALL=C sha256sum -- [!S]* >SHA256SUMS)
ls -l "$folder"
