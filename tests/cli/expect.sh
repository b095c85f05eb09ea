# SPDX-License-Identifier: GPL-3.0-or-later
# Functions that the shell tests share. Sourced with the program's path as $1; leaves the shell in a new, empty directory,
# $work.
tool=$(realpath "$1") || exit 1
[ -x "$tool" ] || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
faults=0

fault() {
  echo "FAULT: $1" >&2
  head -n 5 out.txt | sed 's/^/  stdout: /' >&2
  head -n 5 err.txt | sed 's/^/  stderr: /' >&2
  faults=$((faults + 1))
}
# Stops a program that never ends. It is not a limit on speed: on a busy machine everything takes longer.
patience=600
# used_s: processor time (whole seconds) that the commands so far have used. (A pipe would measure another shell.)
take_processor_time() {
  times >times.txt
  used_s=$(awk 'NR == 2 { split($1, u, "[ms]"); split($2, s, "[ms]"); print int(60 * (u[1] + s[1]) + u[2] + s[2]) }' times.txt)
}
# expect STATUS ARGUMENTS...: runs the program, checks its exit status, and keeps its streams in out.txt and err.txt.
expect() {
  wanted=$1
  shift
  timeout "$patience" "$tool" "$@" >out.txt 2>err.txt </dev/null
  status=$?
  [ "$status" -eq "$wanted" ] || fault "earthtop $*: exit status $status, not $wanted"
}
on_stdout() { grep -q -- "$1" out.txt || fault "no '$1' on standard output"; }
# says TEXT: the same where the line may have been broken within the text: the output's words, with one space between them.
says() { tr -s ' \n' ' ' <out.txt | grep -q -- "$1" || fault "no '$1' on standard output, wherever its lines end"; }
on_stderr() { grep -q -- "$1" err.txt || fault "no '$1' on standard error"; }
nothing_on_stdout() { [ ! -s out.txt ] || fault "standard output is not empty"; }
nothing_on_stderr() { [ ! -s err.txt ] || fault "standard error is not empty"; }
