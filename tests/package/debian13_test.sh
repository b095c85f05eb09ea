#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tests/package/debian13.sh says what it lacks, and .ci/run names its job as not run then.
set -euo pipefail
cd "$(dirname "$0")/../.."
if [[ $(. /etc/os-release && echo "${VERSION_CODENAME:-}") == trixie ]]; then
  [[ -z $(tests/package/debian13.sh --lacks) ]]
  exit
fi

wants() { # SENTENCE COMMAND...: the job, run by that command, says the sentence and runs nothing
  local said
  said=$("${@:2}" .ci/run debian13)
  grep -qxF "=== Debian 13: not run. $1" <<<"$said" && grep -qx 'Not run: debian13' <<<"$said" ||
    { echo "no \"$1\", and that the job was not run, in: $said" >&2 && exit 1; }
}
no_apt="Debian 13 is made here by mmdebstrap, which needs apt."
no_root="Debian 13 is made here by mmdebstrap, which needs root."
no_mounts="Debian 13 is run here in a root of its own, which needs the right to mount."
no_mirror="Debian 13 is made here of packages from http://deb.debian.org/debian, which does not answer."
nobody=(setpriv --reuid=65534 --clear-groups)
if [[ $(id -u) -ne 0 ]]; then
  wants "$no_root" env
else
  if "${nobody[@]}" test -x .ci/run; then wants "$no_root" "${nobody[@]}"; fi
  wants "$no_mounts" setpriv --bounding-set=-sys_admin
  if unshare --mount true 2>/dev/null; then wants "$no_mirror" unshare --net; fi
  if unshare --mount true 2>/dev/null && [[ -d /usr/lib/apt ]]; then
    wants "$no_apt" unshare --mount sh -c 'mount -t tmpfs none /usr/lib/apt && exec "$@"' sh
  fi
fi
