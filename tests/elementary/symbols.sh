#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# No digit depends on the processor through the C library's elementary functions: the library's objects call none of them, and the
# program brings its own for the shared libraries that do. Nor does a fused product come in by vectorizing.
#   symbols.sh LIBRARY... PROGRAM
set -euo pipefail
export LC_ALL=C # by bytes: ten times as fast in a long listing

libraries=("${@:1:$#-1}") program=${!#}
status=0
fail() {
  printf '%s\n' "$1" >&2
  sed 's/^/  /' >&2
  status=1
}
# Those of double and float. hypot is left out, of which there is one code for all processors. The sine and cosine of long double
# reach results of double, too; the C library computes them in C, from one code for all processors.
names='(a?(sin|cos|tan)h?|sincos|atan2|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|pow10|cbrt|erfc?|[tl]gamma(_r)?|gamma)'
elementary() { grep -oE "\\b$names$1(@.*)?\$" | sed 's/@.*//' | sort -u || true; }

for library in "${libraries[@]}"; do
  called=$(nm --undefined-only "$library" | elementary 'f?')
  [[ -z $called ]] || fail "$library calls of the C library:" <<<"$called"
done

called=$(nm --dynamic --undefined-only "$program" | elementary '')
[[ -z $called ]] || fail "$program calls of the C library:" <<<"$called"

defined=$(nm --dynamic --defined-only "$program" | elementary '')
while read -r shared; do
  missing=$(comm -13 <(echo "$defined") <(nm --dynamic --undefined-only "$shared" | elementary ''))
  [[ -z $missing ]] || fail "$shared calls what $program does not bring:" <<<"$missing"
done < <(ldd "$program" | grep -oE '/[^ ]+' | grep -vE '/(libm|libc|ld-linux[^/]*|libsleef|libquadmath)\.so')

for library in "${libraries[@]}"; do
  fused=$(objdump --disassemble --no-show-raw-insn "$library" | grep -oE 'vfm(addsub|subadd)[0-9a-z]*' | sort | uniq -c || true)
  [[ -z $fused ]] || fail "$library has fused products that no source asks for (-ffp-contract=off):" <<<"$fused"
done
exit "$status"
