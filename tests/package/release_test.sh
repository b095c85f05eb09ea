#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tries every file of a release where nothing else is installed: in bare roots of Debian 12 and 13, by the commands of the release's own
# README.md. Prints a row for each: whether the commands worked, and whether toy-top has the digits of the program as one file: every row of
# a run, and of pages the drift, as far as they print it.
#   tests/package/release_test.sh [FOLDER [SUITE...]]     default: build/release-files bookworm trixie
#   ONLY=REGEX tests/package/release_test.sh ...          only files whose names have it
# It takes root, and a network in which apt finds Debian.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$(cd "${1:-build/release-files}" && pwd)
suites=("${@:2}")
[[ ${#suites[@]} -gt 0 ]] || suites=(bookworm trixie)
if [[ $(id -u) -ne 0 ]]; then
  echo "tests/package/release_test.sh makes roots of its own, which takes root." >&2
  exit 2
fi
if [[ -z ${RELEASE_TEST_MOUNTS:-} ]]; then # what is mounted below is mounted for this script alone
  tools/install-dependencies.sh mmdebstrap
  RELEASE_TEST_MOUNTS=1 exec unshare --mount --propagation private "$PWD/tests/package/release_test.sh" "$folder" "${suites[@]}"
fi

work=$(mktemp -d)
chmod 755 "$work"
root=$work/root
remove_root() {
  umount --recursive --lazy "$root" 2>/dev/null || true
  rm --one-file-system -rf "$root"
}
trap 'remove_root; rm --one-file-system -rf "$work"' EXIT
(cd "$folder" && sha256sum --quiet --check SHA256SUMS)
python3 tools/package/wheel.py check "$folder"/*.whl

# In the root, with a home of its own; sudo, of which manuals speak, is not there, and he who is root needs none.
inside() {
  chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 \
    bash -euc "sudo() { if [[ \$1 == apt ]]; then apt-get -q -y --no-install-recommends \"\${@:2}\"; else \"\$@\"; fi; }; cd; cd release; $1" </dev/null
}
commands() { # of a file
  awk -v heading="## $1" '$0 == heading { found = 1; next } /^## / { found = 0 } found && $0 == "```" { inside = 0 } found && inside
                          found && $0 == "```sh" { inside = 1 }' "$folder/README.md"
}
is_fit() { # FILE SUITE: a Python extension and a package of Debian belong to one suite
  case $1 in
    *-cp311-*) [[ $2 == bookworm ]] ;;
    *-cp313-*) [[ $2 == trixie ]] ;;
    python3-* | lib*) [[ $2 == bookworm ]] ;;
  esac
}

# Of the program as one file, on this system: the hash of the rows, and the drift as JSON writes it, and with ten digits.
static=$(echo "$folder"/earthtop-*-x86_64)
"$static" run toy-top --out "$work/expected" --quiet
hash_of() { sha256sum <"$1" | cut -c 1-12; }
expected=$(hash_of "$work/expected/trajectory.csv")
read -r drift drift10 < <(python3 -c 'import json, sys
drift = json.load(open(sys.argv[1]))["drift"]["axis_final_rad"]
print(repr(drift), f"{drift:.10g}")' "$work/expected/summary.json")
seen() { # the words of a browser's tree, without its scripts
  python3 -c 'import re, sys
words = re.sub(r"(?s)<(script|style)\b.*?</\1>|<[^>]*>", " ", sys.stdin.read())
print(" ".join(words.split()))'
}

try() { # FILE COMMANDS: how it went, in a word or two
  local said=$work/said list
  case $1 in
    *-x86_64) # in a directory that has nothing else
      mkdir -p "$root/root/empty"
      cp "$folder/$1" "$root/root/empty/program"
      chmod 755 "$root/root/empty/program"
      chroot "$root/root/empty" /program run toy-top >"$said" 2>&1 || { echo "fails in an empty directory" && return; }
      inside "$2" >"$said" 2>&1 || { echo fails && return; }
      cmp -s "$root"/root/{empty,release}/out/toy-top/trajectory.csv || { echo "other digits in an empty directory" && return; }
      ;;
    earthtop-*.tar.gz)
      if [[ $1 != *gallery* ]]; then # what is missing is said, and installed as it is said, until nothing is missing
        until inside "$2" >"$said" 2>&1; do
          list=$(sed -n 's/^ *apt-get install --no-install-recommends /apt-get install -q -y --no-install-recommends /p' "$said" | head -n 1)
          [[ -n $list ]] || { echo fails && return; }
          echo "$list" >>"$work/installed"
          [[ $(grep -cxF "$list" "$work/installed") -eq 1 ]] || { echo "asks for the same again" && return; }
          inside "$list" >"$said" 2>&1 || { echo "asks for what apt does not find" && return; }
        done
      else
        inside "${2//xdg-open/test -s}" >"$said" 2>&1 || { echo fails && return; }
        grep -qF "value=\"$drift\"" "$root"/root/release/*-gallery/toy-top.html || { echo "another drift than $drift" && return; }
      fi
      ;;
    *-container.tar) # in a root that is in a container itself, podman must do without what that may not give
      mount -t cgroup2 none "$root/sys/fs/cgroup"
      mkdir -p "$root/etc/containers"
      printf '[containers]\ncgroups = "disabled"\nnetns = "host"\nutsns = "host"\nipcns = "host"\n%s\n' \
        'default_ulimits = ["nofile=1024:1024", "nproc=1024:1024"]' >"$root/etc/containers/containers.conf"
      inside "$2" >"$said" 2>&1 || { echo fails && return; }
      ;;
    *.html)
      inside "apt-get install -q -y --no-install-recommends chromium" >"$said" 2>&1 || { echo "no browser" && return; }
      inside "${2//xdg-open/chromium --headless --no-sandbox --disable-gpu --disable-background-networking --virtual-time-budget=20000 --dump-dom}" \
        2>"$said" | seen >"$work/seen" || { echo fails && return; }
      grep -qF "$drift10 rad" "$work/seen" || { echo "does not show the drift $drift10 rad" && return; }
      ;;
    *) inside "$2" >"$said" 2>&1 || { echo fails && return; } ;;
  esac
  echo works
}

status=0
printf '| system | file | tried by | result | digits |\n| --- | --- | --- | --- | --- |\n'
for suite in "${suites[@]}"; do
  mmdebstrap --quiet --mode=root --variant=minbase --dpkgopt=force-unsafe-io "$suite" "$work/$suite.tar" http://deb.debian.org/debian
  while read -r file; do
    [[ $file =~ ${ONLY:-} ]] || continue
    text=$(commands "$file")
    if ! is_fit "$file" "$suite" || [[ -z $text ]]; then continue; fi
    remove_root
    rm -f "$work/installed"
    mkdir -p "$root"
    mount --bind "$root" "$root"
    tar -xf "$work/$suite.tar" -C "$root"
    mkdir -p "$root/root/release"
    chmod 755 "$root" "$root/root"
    cp "$folder"/* "$root/root/release"
    mount --rbind /dev "$root/dev"
    mount -t proc proc "$root/proc"
    mount -t sysfs sysfs "$root/sys"
    inside 'apt-get update -q' >"$work/said" 2>&1 || { cat "$work/said" && exit 1; }
    result=$(try "$file" "$text")
    digits=-
    trajectory=$root/root/release/out/toy-top/trajectory.csv
    if [[ -e $trajectory ]]; then
      digits=$([[ $(hash_of "$trajectory") == "$expected" ]] && echo "the same" || echo others)
    elif [[ $result == works && $file =~ gallery|html$ ]]; then
      digits="the same drift"
    fi
    printf '| %s | `%s` | `%s` | %s | %s |\n' "$(. "$root/etc/os-release" && echo "Debian $VERSION_ID")" "$file" \
      "$(tail -n 1 <<<"$text" | cut -c 1-60)" "$result" "$digits"
    if [[ $result != works || $digits == others || $digits == - ]]; then
      status=1
      tail -n 15 "$work/said" >&2
    fi
  done < <(sed -n 's/^## //p' "$folder/README.md")
done
exit "$status"
