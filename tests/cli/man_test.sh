#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The manual has a page for the program and for every verb. Each page has all that --help knows, and roff gives no warning.
# usage: man_test.sh PATH_OF_EARTHTOP
set -u
# shellcheck source=tests/cli/expect.sh
. "$(dirname "$0")/expect.sh"

options_of() { # VERB...: the long options that its help lists
  "$tool" "$@" --help | sed -n 's/^  \(-[a-zA-Z], \)\{0,1\}\(--[a-z-]*\).*/\2/p'
}
subverbs_of() { # VERB...: the verbs below it
  "$tool" "$@" --help | sed -n '1,/^O/ s/^  \([a-z]*\)  .*/\1/p'
}
has_options() { # PAGE VERB...: a word of roff has minus signs for its hyphens
  page=$1
  shift
  options=$(options_of "$@")
  [ -n "$options" ] || fault "help of $* lists no option"
  for option in $options; do
    word=$(printf '%s' "$option" | sed 's/-/\\\\-/g')
    grep -q "^\(\\\\fB\\\\-[a-zA-Z]\\\\fR, \)\{0,1\}\\\\fB$word\\\\fR" "$page" || fault "$page does not tell of $option of $*"
  done
}

expect 0 man --all pages
nothing_on_stdout
nothing_on_stderr
expect 0 man
cmp -s out.txt pages/earthtop.1 || fault "man prints another page than man --all writes"
has_options pages/earthtop.1
pages=1
for verb in $(subverbs_of); do
  pages=$((pages + 1))
  expect 0 man "$verb"
  cmp -s out.txt "pages/earthtop-$verb.1" || fault "man $verb prints another page than man --all writes"
  grep -q "earthtop.\\\\-$verb" pages/earthtop.1 || grep -q "earthtop\\\\-$verb" pages/earthtop.1 ||
    fault "earthtop.1 does not name $verb"
  has_options "pages/earthtop-$verb.1" "$verb"
  for subverb in $(subverbs_of "$verb"); do has_options "pages/earthtop-$verb.1" "$verb" "$subverb"; done
done
[ "$pages" -gt 10 ] || fault "help lists $((pages - 1)) verbs only"
[ "$(find pages -type f | wc -l)" -eq "$pages" ] || fault "man --all wrote other pages than those of the verbs"

version=$("$tool" --version | sed -n 's/^earthtop //p')
for page in pages/*.1; do
  name=$(basename "$page" .1)
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' EXAMPLES 'SEE ALSO'; do
    [ "$(grep -cx ".SH $section" "$page")" -eq 1 ] || fault "$page: no section $section, or several"
  done
  head -n 1 "$page" | grep -q "^.TH .* 1 \"\" \"earthtop $version\"" || fault "$page: no such version in its title"
  if LC_ALL=C grep -q '[^ -~]' "$page"; then fault "$page: not in ASCII"; fi
  if command -v groff >/dev/null; then
    groff -man -ww -z "$page" >out.txt 2>err.txt || fault "$page: groff fails"
    nothing_on_stderr
    MANWIDTH=80 groff -man -Tascii "$page" >out.txt 2>err.txt
    nothing_on_stderr
  fi
  if command -v mandoc >/dev/null; then
    mandoc -T lint -W warning "$page" >out.txt 2>&1
    grep -v 'missing date' out.txt >err.txt # there is none: the version says how old a page is
    nothing_on_stderr
  fi
  if command -v lexgrog >/dev/null; then
    lexgrog "$page" >out.txt 2>err.txt
    on_stdout "\"$name - "
  fi
done

expect 2 man frobnicate
nothing_on_stdout
expect 2 man run --all elsewhere
[ ! -e elsewhere ] || fault "a refused command line left a directory"
echo a file >file
expect 2 man --all file
on_stderr 'file'

[ "$faults" -eq 0 ] && echo "all as expected"
[ "$faults" -eq 0 ]
