#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests that tools/install-dependencies.sh waits where another process holds a lock of the package manager, and says so; that it gives up
# after a time; and that it does not wait for other faults. A stand-in plays the package manager.
set -euo pipefail
here=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
cat > "$work/bin/dpkg-query" <<'END'
#!/bin/sh
exit 1
END
cat > "$work/bin/sudo" <<'END'
#!/bin/sh
exec "$@"
END
cat > "$work/bin/apt-get" <<'END'
#!/bin/sh
echo "$*" >> "$WORK/calls"
case "$*" in
  *update*)
    echo x >> "$WORK/updates"
    if [ "$(wc -l < "$WORK/updates")" -le "$LOCKED" ]; then
      echo "E: $FAULT"
      exit 100
    fi ;;
esac
END
chmod +x "$work"/bin/*

try() {  # LOCKED FAULT WAIT_S: output in $work/out, status in $status
  rm -f "$work/updates" "$work/calls"
  status=0
  WORK=$work LOCKED=$1 FAULT=$2 EARTHTOP_LOCK_WAIT_S=$3 PATH="$work/bin:$PATH" "$here/tools/install-dependencies.sh" > "$work/out" 2>&1 || status=$?
}
fail() {
  echo "FAULT: $1" >&2
  cat "$work/out" >&2
  exit 1
}
LOCK="Could not get lock /var/lib/apt/lists/lock. It is held by process 1234 (apt-get)"

try 1 "$LOCK" 20
[[ $status -eq 0 ]] || fail "a lock that is released: status $status"
grep -q "Waiting: another process holds the lock of the package lists" "$work/out" || fail "it does not say that it waits"
[[ $(wc -l < "$work/updates") -eq 2 ]] || fail "the lists are not tried again"
grep -q "DPkg::Lock::Timeout=20 install .*cmake" "$work/calls" || fail "nothing is installed, or without waiting"

try 99 "$LOCK" 2
[[ $status -ne 0 ]] || fail "a lock that is never released is no failure"
grep -q "It is held by process 1234" "$work/out" || fail "it does not say who holds the lock"

try 99 "Temporary failure resolving 'deb.debian.org'" 20
[[ $status -ne 0 && $(wc -l < "$work/updates") -eq 1 ]] || fail "it waits where no lock is held"
! grep -q "^Waiting" "$work/out" || fail "it says that it waits for a lock"
echo "locks of the package manager: waited for, given up after a time, no other fault waited for"
