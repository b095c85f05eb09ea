#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# No digit of the results may depend on the processor through the C library's elementary functions: the library's objects must
# not call any of them, and the program must define its own for the shared libraries that call them. Nor may vectorization
# introduce fused products.
#   symbols.sh LIBRARY... PROGRAM
set -euo pipefail
export LC_ALL=C # compare bytes: ten times as fast in a long listing

libraries=("${@:1:$#-1}") program=${!#}
status=0
fail() {
  printf '%s\n' "$1" >&2
  sed 's/^/  /' >&2
  status=1
}
# The functions of double and float. hypot is left out, because the C library has one code for it on all processors. Sine and
# cosine of long double, which affect results in double too, are also computed by one code for all processors.
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
