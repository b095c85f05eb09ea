#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that includes point one way only, and that elementary functions come from one place. In the list below each line may
# include the lines above it and itself; of two names in the same line only one may include the other.
#   tools/check-layers.sh
set -euo pipefail
cd "$(dirname "$0")/.."

layers='elementary fifth_root float128 float80
real text error arithmetic watch members
vectors
frames
model
closed_form
integrate
drift
input
scenario
scene
budget
run
results plot
bench study compare measure
plan
report verify
tools'

find include/earthtop src tools/earthtop -type f \( -name '*.hpp' -o -name '*.ipp' -o -name '*.cpp' \) | LC_ALL=C sort |
  xargs awk -v layers="$layers" '
    function complain(what) { printf "%s:%d: %s\n", FILENAME, FNR, what; ++faults }
    function layer_of(path) {  # for a path below include/earthtop or src: its directory, or its name if it has none
      sub(/^include\/earthtop\//, "", path); sub(/^src\//, "", path)
      if (path ~ /^tools\//) return "tools"
      if (path ~ /\//) sub(/\/.*/, "", path); else sub(/\..*/, "", path)
      if (path == "run_batch") path = "run"
      return path
    }
    BEGIN {
      n = split(layers, line, "\n")
      for (i = 1; i <= n; ++i) { m = split(line[i], name, " "); for (j = 1; j <= m; ++j) rank[name[j]] = i }
    }
    FNR == 1 {
      from = layer_of(FILENAME)
      is_public = FILENAME ~ /^include\//
      if (!(from in rank)) complain("in no known layer: " from)
    }
    { code = $0; sub(/\/\/.*/, "", code) }
    is_public && code ~ /#[ ]*include[ ]*[<"](sleef|nlohmann|boost\/numeric\/odeint|fmt|gsl|GeographicLib|sha2|sqlite3|erfa)/ {
      complain("a public header must not need this: " $0)
    }
    # The functions with these names in the C library have a last digit that depends on the processor; for constants, on the
    # compiler.
    from != "elementary" && from != "real" && from !~ "^float(80|128)$" && FILENAME !~ /libm[.]cpp$/ &&
    code ~ /(std::|__builtin_|[^a-z0-9_:.>&]::)(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|cbrt|hypot|erfc?|[tl]gamma)[fl]?[ ]*[(;]/ {
      complain("the C library has other digits on another processor; real:: of elementary.hpp has one: " $0)
    }
    from != "tools" && code ~ /std::(cout|cerr|clog)|(^|[^a-z_])f?printf ?\(|fmt::print ?\(|(^|[^a-z_])f?puts ?\(/ {
      complain("only the tools print: " $0)
    }
    match(code, /#[ ]*include[ ]*"[^"]*"/) {
      path = substr(code, RSTART, RLENGTH); sub(/^[^"]*"/, "", path); sub(/"$/, "", path)
      was_public = sub(/^earthtop\//, "", path)
      if (is_public && !was_public) complain("a public header includes a private one: " $0)
      if (!was_public && path !~ /\//) next  # a neighbour in the same directory
      to = from == "tools" && !was_public ? "tools" : layer_of(path)
      if (!(to in rank)) complain("includes no known layer: " $0)
      else if (rank[to] > rank[from]) complain(from " must not include " to ", which stands above it: " $0)
      else if (to != from && rank[to] == rank[from]) {
        if ((to, from) in seen) complain(from " and " to " include each other: " $0)
        seen[from, to] = 1
      }
    }
    END { exit faults > 0 }'
