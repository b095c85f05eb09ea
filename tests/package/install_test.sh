#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs from a build that may be spoilt, uses what was installed, and wants it gone after the target `uninstall`, and nothing else with it.
#   tests/package/install_test.sh BUILD     BUILD: a build of a clone that is this test's own
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
clone=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
"$here/../../tools/install-dependencies.sh" --program python3 # for linked_test.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
prefix="$work/a prefix"

fail() {
  echo "FAILED: $*" >&2
  tail -n 20 said >&2
  exit 1
}
step() { printf -- '-- %s\n' "$*"; }
says() { tr -s ' \n' ' ' <said | grep -qF -- "$1" || fail "not said: $1"; }
install() { cmake --install "$build" "$@" >said 2>&1; }
uninstall() { cmake --build "$build" --target uninstall >said 2>&1; }
refused() { # SENTENCE COMMAND...: it fails, says so, and installs nothing
  local sentence=$1 before
  shift
  before=$(find "$prefix" | sort)
  if "$@"; then fail "not refused: $*"; fi
  says "$sentence"
  says "Nothing was installed."
  [[ $(find "$prefix" | sort) == "$before" ]] || fail "a refused installation leaves files"
}

step "A prefix in which there is something already"
mkdir -p "$prefix/bin" "$prefix/share/man/man1"
echo other >"$prefix/share/man/man1/other.1"
find "$prefix" | sort >before

step "Install; manual pages that have not been built are built first"
rm -rf "$build/pages"
install --prefix "$prefix" || fail "it is not installed"
says "Not all of it has been built; that is done first"
find "$prefix" -type f ! -name other.1 >installed
"$prefix/bin/earthtop" run "$prefix/share/earthtop/scenarios/toy-top.json" --set /motion/duration_s=1 --out out --quiet
[[ -s out/drift.svg ]] || fail "the installed program does not run"
"$prefix/bin/earthtop" man --all pages
for page in pages/*; do zcat "$prefix/share/man/man1/${page##*/}.gz" | cmp - "$page"; done
[[ $(ls "$prefix/share/man/man1") == $({ ls pages | sed 's/$/.gz/' && echo other.1; } | sort) ]] || fail "other manual pages"
for file in bash-completion/completions/earthtop zsh/site-functions/_earthtop fish/vendor_completions.d/earthtop.fish; do
  [[ -s $prefix/share/$file ]] || fail "no $file"
done
"$prefix/bin/earthtop" schema | cmp - "$prefix/share/earthtop/schema/earthtop-scenario-1.json"
diff -r "$clone/scenarios" "$prefix/share/earthtop/scenarios"
for file in LICENSE README.md; do cmp "$clone/$file" "$prefix/share/doc/earthtop/$file"; done
"$here/linked_test.py" "$prefix/share/doc/earthtop/earthtop.spdx.json" "$prefix/bin/earthtop"
[[ -s $prefix/lib/libearthtop.a && -s $prefix/include/earthtop/run.hpp ]] || fail "the library is not installed"
if grep -rlaF "$clone" "$prefix"; then fail "these files name the directory in which they were built"; fi

step "Uninstall: all of it, and nothing else"
mkdir -p "$prefix/share/earthtop/scenarios"
echo '{}' >"$prefix/share/earthtop/scenarios/mine.json"
install --prefix "$prefix" || fail "it is not installed a second time"
uninstall || fail "it is not uninstalled"
says "Removed $(wc -l <installed) files and "
[[ $(find "$prefix" -type f | sort) == "$(printf '%s\n' "$prefix/share/earthtop/scenarios/mine.json" "$prefix/share/man/man1/other.1")" ]] ||
  fail "after uninstalling there is $(find "$prefix" -type f)"
rm -r "$prefix/share/earthtop"
find "$prefix" | sort | cmp - before || fail "directories are left"
uninstall || fail "a second call fails"
says "Nothing is installed from this build"

step "A component, and a prefix that is not there"
install --prefix "$work/new/er" --component program || fail "the component program is not installed"
[[ -x new/er/bin/earthtop && -s new/er/share/doc/earthtop/LICENSE && ! -e new/er/include ]] || fail "the component program is another one"
uninstall || fail "it is not uninstalled"
[[ ! -e new ]] || fail "the prefix is left"

step "DESTDIR"
export DESTDIR=$work/stage
install --prefix /opt/earthtop || fail "DESTDIR is not followed"
[[ -x stage/opt/earthtop/bin/earthtop ]] || fail "DESTDIR is not followed"
unset DESTDIR
uninstall || fail "it is not uninstalled"
says "Nothing is installed from this build"
says "What was installed in other places is removed with DESTDIR=$work/stage"
[[ -x stage/opt/earthtop/bin/earthtop ]] || fail "what was installed with DESTDIR is removed without it"
DESTDIR=$work/stage uninstall || fail "it is not uninstalled"
[[ ! -e stage ]] || fail "DESTDIR is left"

step "What would stop it half way stops it before"
refused 'This build has no component "programs"; it has: program, development' install --prefix "$prefix" --component programs
echo >"$prefix/include"
refused "$prefix/include is in the way, where a directory belongs: remove it, or choose another --prefix." install --prefix "$prefix"
rm "$prefix/include"
mkdir "$prefix/bin/earthtop"
refused "$prefix/bin/earthtop is in the way, where a file belongs: remove it, or choose another --prefix." install --prefix "$prefix"
rmdir "$prefix/bin/earthtop"
mkdir unwritable # as `test` says, which says of root's own directories that they may be written
printf '#!/bin/sh\n[ "$2" != "%s/share/man/man1" ]\n' "$prefix" >unwritable/test
chmod +x unwritable/test
refused "You may not write in $prefix/share/man/man1: install as one who may (sudo), or choose another --prefix." \
  env PATH="$work/unwritable:$PATH" bash -c 'cmake --install "$0" --prefix "$1" >said 2>&1' "$build" "$prefix"
mv "$clone/LICENSE" licence
refused "The installation would stop half way:" install --prefix "$prefix"
mv licence "$clone/LICENSE"
rm -rf "$build/pages"
mv "$clone/tools/package/write-pages.sh" written
printf '#!/bin/sh\nexit 1\n' >"$clone/tools/package/write-pages.sh"
chmod +x "$clone/tools/package/write-pages.sh"
refused "The build failed, after this:" install --prefix "$prefix"
mv written "$clone/tools/package/write-pages.sh"

step "A file that may not be removed"
install --prefix "$work/kept" || fail "it is not installed"
chmod 755 "$work" "$clone"
chmod a-w kept/bin
others=()
if [[ $(id -u) -eq 0 ]]; then others=(setpriv --reuid 65534 --clear-groups); fi
if "${others[@]}" cmake -DRECORD="$build/installed.txt" -P "$clone/tools/package/uninstall.cmake" >said 2>&1; then fail "no word of it"; fi
says "the first of them $work/kept/"
says "uninstall as one who may remove them (sudo)."
chmod u+w kept/bin
uninstall || fail "it is not uninstalled"
[[ ! -e kept ]] || fail "something is left"
echo "It installs whole, and goes."
