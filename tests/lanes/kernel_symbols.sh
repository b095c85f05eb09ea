#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sources compiled for wider vectors must not define any symbol that another source may share. If several objects define a
# function, the linker takes any one of them, and a program could meet instructions that its processor does not have.
#   kernel_symbols.sh OBJECT...
set -euo pipefail

status=0
for object in "$@"; do
  # Defined: weak (V, W), unique (u), and global functions (T).
  if shared=$(nm --defined-only "$object" | grep -E ' [VWuT] '); then
    printf '%s defines:\n%s\n' "$object" "$shared" >&2
    status=1
  fi
  if ! nm --defined-only "$object" | grep -q -E ' [DR] .*lanes'; then
    printf '%s: no kernel in it\n' "$object" >&2
    status=1
  fi
  if called=$(nm --undefined-only "$object" | grep -v -E '_GLOBAL_OFFSET_TABLE_|__(asan|ubsan|stack_chk)_'); then
    printf '%s calls:\n%s\n' "$object" "$called" >&2
    status=1
  fi
done
exit "$status"
