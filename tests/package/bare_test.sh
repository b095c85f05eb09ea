#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tries the Debian packages where nothing else is installed: in a root with apt and the essential packages of a suite alone, by the commands
# and programs of the manuals.
#   tests/package/bare_test.sh SUITE [PACKAGES]
# SUITE:    bookworm (Debian 12) or trixie (Debian 13)
# PACKAGES: where the packages are that were made on this suite; default: build/packages
# It takes root, and a network in which apt finds Debian.
set -euo pipefail
cd "$(dirname "$0")/../.."
suite=$1
packages=$(cd "${2:-build/packages}" && pwd)
if [[ $(id -u) -ne 0 ]]; then
  echo "tests/package/bare_test.sh makes a root of its own, which takes root." >&2
  exit 2
fi
tools/install-dependencies.sh mmdebstrap

root=$(mktemp -d)
clean_up() {
  umount "$root/proc" 2>/dev/null || true
  rm --one-file-system -rf "$root"
}
trap clean_up EXIT
fail() {
  echo "FAILED: $*" >&2
  exit 1
}
step() { printf -- '-- %s\n' "$*"; }
# What is in a bare root; sudo, of which manuals speak, is not, and he who is root needs none.
inside() {
  chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" bash -euc "cd; sudo() { \"\$@\"; }; $1"
}
install() { inside "apt-get install -q -y --no-install-recommends $*" >"$root/log" 2>&1 || { tail -n 20 "$root/log" && fail "apt-get install $*"; }; }
block() { # the first block in a LANGUAGE of a MANUAL after a line that begins with TEXT
  awk -v language="$1" -v text="$3" 'index($0, text) == 1 { found = 1 } found && $0 == "```" language { inside = 1; next }
                                     inside && $0 == "```" { exit } inside' "$2"
}

step "A bare root of $suite"
mmdebstrap --quiet --mode=root --variant=minbase "$suite" "$root" http://deb.debian.org/debian
mount -t proc proc "$root/proc" 2>/dev/null || true # where it may be
mkdir -p "$root/root/build/packages"
cp "$packages"/*.deb "$root/root/build/packages"
chmod 755 "$root" "$root/root"
inside 'apt-get update -q' >"$root/log" 2>&1 || { tail -n 20 "$root/log" && fail "apt finds no Debian"; }

step "Install, as tools/README.md says"
command=$(block sh tools/README.md '## Debian packages' | sed -n 's/^\(sudo apt install [^#]*\).*/\1/p')
[[ $command == *.deb* ]] || fail "tools/README.md does not say how the packages are installed"
echo "   $command"
inside "${command/install/install -y --no-install-recommends}" >"$root/log" 2>&1 || { tail -n 20 "$root/log" && fail "$command"; }

step "The program: README.md"
inside 'ln -s /usr/share/earthtop/scenarios .'
for text in '## What a run prints' 'The directory `out/toy-top`'; do
  commands=$(block sh README.md "$text")
  echo "${commands//earthtop /   earthtop }" | sed 's/  *#.*//'
  inside "$commands" >"$root/said" || fail "$commands"
done
inside 'cat out/toy-top/summary.json' | grep -q '"verdict": "reliable"' || fail "the run has no verdict"
inside '[[ -s toy-top.html || -s out/toy-top/report.html ]] && verbs=$(earthtop help)' || fail "no page"

step "Its manual"
install man-db
inside 'MANPAGER=cat man earthtop-run' | grep -q 'earthtop.run' || fail "no manual page"

step "Python: README.md"
block python README.md 'In Python' >"$root/root/program.py"
inside 'python3 program.py' | tee "$root/said"
grep -q '^reliable ' "$root/said" || fail "the program in Python prints something else"

step "C++: README.md, by pkg-config"
install g++
block cpp README.md 'In C++' >"$root/root/program.cpp"
inside 'g++ -std=gnu++20 program.cpp -o program $(pkg-config --cflags --libs --static earthtop) && ./program' | tee "$root/said"
grep -Eqx '0[.]0011402[0-9]* rad' "$root/said" || fail "the program in C++ prints something else"

step "Remove, as tools/README.md says"
command=$(block sh tools/README.md '## Debian packages' | sed -n 's/.*# \(sudo apt remove .*\)/\1/p')
echo "   $command"
inside "${command/remove/remove -y}" >"$root/log" 2>&1 || { tail -n 20 "$root/log" && fail "$command"; }
left=$(cd "$root" && find usr etc var/lib -iname '*earthtop*' ! -path 'var/lib/dpkg/*' ! -path 'var/lib/apt/*')
[[ -z $left ]] || fail "left after removal: $left"
echo "In a bare $suite the packages install, work and go."
