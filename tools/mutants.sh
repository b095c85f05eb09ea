#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Inserts one fault at a time into the sources and checks that the named test fails. A fault that no test notices is a gap in
# the tests.
#   tools/mutants.sh [NAME...]      NAME: a file of tests/mutants, without .mutant; default: all
#   tools/mutants.sh --help         prints this
#   tools/mutants.sh --check        builds nothing: asks only whether each fault can still be planted, and its test still exists
#
# A mutant is one text file:
#   title: what is wrong with it
#   file: the source to change
#   killed by: a GoogleTest filter, all of whose tests live in one test program
#   --- replace            the text below must occur exactly once in the file
#   ...
#   --- with
#   ...
#   --- end
# Everything happens in a copy of the tree, in $EARTHTOP_MUTANTS_DIR (default build/mutants), which is kept, so that the next
# call builds only what changed. $EARTHTOP_JOBS: number of parallel jobs (default: all cores); $EARTHTOP_MUTANT_SECONDS: time
# limit of a test run (default 300).
# Exit status: 0 if all mutants were killed, 1 if one survived or could not be tried.
set -euo pipefail
cd "$(dirname "$0")/.."

root=$PWD

field() { sed -n "/^---/q;s/^$1:[[:space:]]*//p" "$root/tests/mutants/$2.mutant"; }
block() { # the lines between two marks
  awk -v from="--- $1" -v to="--- $2" '$0 == to { inside = 0 } inside; $0 == from { inside = 1 }' \
    "$root/tests/mutants/$3.mutant"
}
# What stands against planting this mutant in a tree; nothing where it can be planted.
obstacle() {
  local tree=$1 name=$2 file old content after
  if [[ ! -f $root/tests/mutants/$name.mutant ]]; then echo "there is no tests/mutants/$name.mutant"; return; fi
  file=$(field file "$name") old=$(block replace with "$name")
  if [[ ! -f $tree/$file ]]; then echo "there is no ${file:-\'file:\' line}"; return; fi
  if [[ -z $old ]]; then echo "nothing to replace"; return; fi
  content=$(cat "$tree/$file")
  after=${content#*"$old"}
  if [[ $after == "$content" ]]; then echo "its text does not occur in $file"; return; fi
  if [[ ${after#*"$old"} != "$after" ]]; then echo "its text occurs more than once in $file"; fi
}

# The filters of a mutant that no test in the sources matches.
missing_tests() {
  local filter
  while IFS= read -r filter; do
    compgen -W "$tests" -X "!$filter" >/dev/null || echo "$filter"
  done < <(field 'killed by' "$1" | tr ':' '\n')
}

all_mutants() { for mutant in tests/mutants/*.mutant; do basename "$mutant" .mutant; done; }

if [[ ${1:-} == --help ]]; then
  sed -n '/^set /q; 3,$s/^# \{0,1\}//p' tools/mutants.sh
  exit
fi
if [[ ${1:-} == --check ]]; then
  checked=0 rotten=0
  tests=$(grep -rhoE '(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P|RC_GTEST_PROP)\([A-Za-z0-9_]+, *[A-Za-z0-9_]+' tests --include='*.cpp' |
    sed -E 's/.*\(//; s/, */./')
  for name in $(all_mutants); do
    remark=$(obstacle "$root" "$name")
    missing=$(missing_tests "$name")
    if [[ -n $missing ]]; then remark+="${remark:+; }no test is called $missing"; fi
    if [[ -n $remark ]]; then echo "$name: $remark"; rotten=$((rotten + 1)); fi
    checked=$((checked + 1))
  done
  echo "$((checked - rotten)) of $checked mutants can be planted"
  [[ $rotten -eq 0 && $checked -gt 0 ]]
  exit
fi

work=${EARTHTOP_MUTANTS_DIR:-$root/build/mutants}
jobs=${EARTHTOP_JOBS:-$(nproc)}
time_limit=${EARTHTOP_MUTANT_SECONDS:-300}
build=$work/build
changed=$work/changed # files whose objects may contain a fault: the copy below restores their old times

mkdir -p "$work/tree"
touch "$changed"
find "$work/tree" -mindepth 1 -delete
tar -cf - .github CMakeLists.txt CMakePresets.json LICENSE README.md include scenarios src tests tools | tar -xf - -C "$work/tree"
while IFS= read -r file; do
  if [[ -f $work/tree/$file ]]; then touch "$work/tree/$file"; fi
done <"$changed"

echo "Building the sound tree ..."
if ! {
  cmake -G Ninja -S "$work/tree" -B "$build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 \
    -DEARTHTOP_BUILD_TESTS=ON -DEARTHTOP_BUILD_TOOLS=ON && cmake --build "$build" --parallel "$jobs"
} >"$work/build.log" 2>&1; then
  tail -n 40 "$work/build.log"
  exit 1
fi
: >"$changed"

names=("$@")
if [[ ${#names[@]} -eq 0 ]]; then
  mapfile -t names < <(all_mutants)
fi
declare -A program verdict remark seconds

# The test program that has tests of this filter: its path, or nothing.
program_of() {
  local candidate
  while IFS= read -r candidate; do
    if "$candidate" --gtest_list_tests --gtest_filter="$1" 2>/dev/null | grep -q '^  '; then
      echo "$candidate"
      return
    fi
  done < <(find "$build/tests" -type f -perm -u+x ! -path '*/CMakeFiles/*' ! -name '*.cmake' | LC_ALL=C sort)
}
passes() { (cd "$build/tests" && timeout "$time_limit" "$1" --gtest_filter="$2" --gtest_brief=1) >"$work/test.log" 2>&1; }

# Checks that the mutant exists, and that its test passes without the fault.
prepare() {
  local filter
  verdict[$1]="NOT TRIED"
  if [[ ! -f tests/mutants/$1.mutant ]]; then remark[$1]="there is no tests/mutants/$1.mutant"; return; fi
  filter=$(field 'killed by' "$1")
  if [[ -z $filter ]]; then remark[$1]="no 'killed by:' line"; return; fi
  program[$1]=$(program_of "$filter")
  if [[ -z ${program[$1]} ]]; then remark[$1]="no test is called $filter"; return; fi
  if ! passes "${program[$1]}" "$filter"; then remark[$1]="$filter fails without it"; return; fi
  verdict[$1]=ready
}

try() {
  local file filter old new content before after status=0
  verdict[$1]="NOT TRIED"
  file=$(field file "$1") filter=$(field 'killed by' "$1") old=$(block replace with "$1") new=$(block with end "$1")
  remark[$1]=$(obstacle "$work/tree" "$1")
  if [[ -n ${remark[$1]} ]]; then return; fi

  content=$(cat "$work/tree/$file" && printf .) # the dot protects the last newline from being removed by the shell
  content=${content%.}
  before=${content%%"$old"*}
  after=${content#*"$old"}
  echo "$file" >>"$changed"
  printf '%s' "$before$new$after" >"$work/tree/$file"
  if ! cmake --build "$build" --parallel "$jobs" --target "$(basename "${program[$1]}")" >"$work/build.log" 2>&1; then
    remark[$1]="does not compile: $(grep -m1 error "$work/build.log" || true)"
  else
    passes "${program[$1]}" "$filter" || status=$?
    case $status in
      0) verdict[$1]=SURVIVED remark[$1]="$filter passes" ;;
      124) verdict[$1]=killed remark[$1]="$filter has no end in $time_limit s" ;;
      *) verdict[$1]=killed remark[$1]="$filter" ;;
    esac
  fi
  printf '%s' "$content" >"$work/tree/$file"
}

for name in "${names[@]}"; do prepare "$name"; done
killed=0
for name in "${names[@]}"; do
  start=$SECONDS
  if [[ ${verdict[$name]} == ready ]]; then
    echo "$name: $(field title "$name")"
    try "$name"
    echo "  ${verdict[$name]}: ${remark[$name]}"
  fi
  seconds[$name]=$((SECONDS - start))
  if [[ ${verdict[$name]} == killed ]]; then killed=$((killed + 1)); fi
done

echo
for name in "${names[@]}"; do
  printf '%-10s %-26s %4d s  %s\n' "${verdict[$name]}" "$name" "${seconds[$name]}" "${remark[$name]}"
done
printf '%d of %d mutants killed\n' "$killed" "${#names[@]}"
[[ $killed -eq ${#names[@]} ]]
