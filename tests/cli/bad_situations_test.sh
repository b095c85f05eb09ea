#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Everything that can go wrong around a run: texts, files, output directories, signals, the environment. In each case the exit
# status is the documented one, the message names the place, old results stay as they were, and no temporary file is left.
# usage: bad_situations_test.sh PATH_OF_EARTHTOP
set -u
# shellcheck source=tests/cli/expect.sh
. "$(dirname "$0")/expect.sh"
mounted=
tidy_up() {
  [ -z "$mounted" ] || umount "$mounted"
  chmod -R u+rwx "$work" 2>/dev/null
  rm -rf "$work"
}
trap tidy_up EXIT
skip() { echo "skipped: $1"; }
# refused FILE TEXT: the run ends with status 2 and TEXT on standard error, and leaves no results.
refused() {
  expect 2 run "$1" --out results
  on_stderr "$2"
  [ ! -e results ] || fault "$1: a refused scenario left a directory"
}
# set_refused /POINTER=VALUE TEXT: the same for the good scenario with one value changed.
set_refused() {
  expect 2 run top.json --out results --set "$1"
  on_stderr "$2"
}
# nothing_left DIR: checks that no temporary file is in it.
nothing_left() {
  left=$(find "$1" -name '.*.tmp')
  [ -z "$left" ] || fault "left behind: $left"
}
# keep DIR: remembers its files; intact DIR: checks that they are unchanged and that nothing else is there.
keep() {
  rm -rf kept
  cp -a "$1" kept
}
intact() { diff -r "$1" kept >diff.txt 2>&1 || fault "$2: the old results changed: $(head -n 1 diff.txt)"; }

cat >top.json <<'END_OF_TOP'
{ "name": "bad-luck", "site": { "latitude_deg": 45, "gravity_m_s2": 9.8 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
            "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 0.5, "output_step_s": 0.01 } }
END_OF_TOP

# -- texts: encodings
for encoding in UTF-16LE UTF-16BE UTF-32LE UTF-32BE; do
  iconv -f UTF-8 -t "$encoding" top.json >wide.json
  refused wide.json "wide.json:1:1: error: the text is in $encoding; save it as UTF-8"
  { printf '\357\273\277' && cat top.json; } | iconv -f UTF-8 -t "$encoding" >wide.json
  refused wide.json "wide.json:1:1: error: the text is in $encoding; save it as UTF-8"
done
{ printf '\357\273\277' && cat top.json; } >marked.json
expect 0 run marked.json --out marked --quiet
sed 's/bad-luck/bad-l\xfcck/' top.json >latin.json
refused latin.json 'latin.json:1:17: error: .*0xfc is not valid UTF-8; save the text as UTF-8'
sed 's/"name"/"title": "\\ud83d", "name"/' top.json >half.json
refused half.json 'half.json:1:13: error: /title: half of a surrogate pair; write both'
sed 's/"site":/"site":\xc2\xa0/' top.json >space.json
refused space.json 'space.json:1:.*(U+00A0)'

# -- texts: numbers, physics
for number in NaN Infinity -Infinity; do
  sed "s/0\\.1,/$number,/" top.json >number.json
  refused number.json "number.json:2:24: error: /body/mass_kg: $number is not a finite number; "
done
set_refused /body/mass_kg=1e999 'mass_kg: 1e999 is too large for a double; '
set_refused /body/mass_kg=1e-400 'mass_kg: 1e-400 is too small for a double and would become 0; '
set_refused /body/mass_kg=0 'mass_kg: 0 is out of range; must be '
set_refused /body/mass_kg=-1 'mass_kg: -1 is out of range; must be '
set_refused '/body/inertia/principal_kg_m2=[1e-4,1e-4,9e-4]' 'top.json:3:24: error: /body/inertia: .*triangle inequality; '
set_refused '/body/inertia/principal_kg_m2=[0,0,0]' 'top.json:3:24: error: /body/inertia: .*; '
set_refused /motion/duration_s=0 'duration_s: .*must be '
set_refused /motion/output_step_s=1e-12 'output_step_s must be at least '
set_refused /numerics/relative_tolerance=1e-30 'relative_tolerance: 1e-30 is out of range; must be .*1e-1[0-9]'
set_refused /numerics/relative_tolerance=0 'relative_tolerance: 0 is out of range; must be .*1e-1[0-9]'
set_refused /name=../up 'name: is "../up"; must be '
[ ! -e results ] || fault "a refused scenario left a directory"

# -- files
mkdir folder
mkfifo pipe.json
refused missing.json 'missing.json: error: there is no such file; '
refused folder 'folder: error: is a directory; '
refused pipe.json 'pipe.json: error: is a FIFO; '
refused /dev/zero '/dev/zero: error: is not a regular file; '
refused "$(printf 'steer\033[2J\nme\302\233.json')" 'steer.x1b.2J.x0ame.u009b.json: error: there is no such file; '
refused "$(printf '%05000d' 0)" 'cannot be opened (File name too long)'
ln -s loop.json loop.json
refused loop.json 'cannot be opened (Too many levels'
sed 's/"name": "bad-luck",//' top.json >..json
refused ..json 'cannot replace it; give a name of '
if [ -e /proc/self/mem ]; then # a file that is there, and cannot be read
  expect 4 run /proc/self/mem --out results
  on_stderr 'reading failed .*; check the file'
fi
cp top.json locked.json
chmod 0 locked.json
if [ -r locked.json ]; then skip "an unreadable file: root reads everything"; else refused locked.json 'cannot be opened (Permission'; fi
timeout "$patience" "$tool" run - --out results >out.txt 2>err.txt <&-
[ $? -eq 2 ] || fault "closed standard input: not exit status 2"
on_stderr '<stdin>: error: is closed; give a file, or redirect standard input'
timeout "$patience" "$tool" run - --out results >out.txt 2>err.txt <folder
[ $? -eq 2 ] || fault "a directory as standard input: not exit status 2"
on_stderr '<stdin>: error: is a directory; give a scenario file in it'
head -c 2000 /dev/zero | timeout "$patience" "$tool" run - --out results >out.txt 2>err.txt
[ $? -eq 2 ] || fault "NUL bytes: not exit status 2"
on_stderr '<stdin>:1:1: error: a NUL byte; '

# -- where results go
expect 0 run top.json --out old --quiet
keep old
nothing_left old
(
  ulimit -f 4 # KiB or half of one: too little for the trajectory
  timeout "$patience" "$tool" run top.json --out old --quiet
) >out.txt 2>err.txt
[ $? -eq 4 ] || fault "file size limit: not exit status 4"
on_stderr 'old/trajectory.csv: error: '
intact old "file size limit"
(
  ulimit -f 4
  timeout "$patience" "$tool" run top.json --out new/deep --quiet
) >out.txt 2>err.txt
[ ! -e new ] || fault "file size limit: a directory was left"
mkdir small
if mount -t tmpfs -o size=16k tmpfs small 2>/dev/null; then # a full disk, and another file system than the scenario's
  mounted=$work/small
  expect 4 run top.json --out small/results --quiet
  on_stderr 'small/results/.*: error: No space left on device'
  [ -z "$(ls -A small)" ] || fault "full disk: files were left"
  mount -o remount,size=4m small
  expect 0 run top.json --out small/results --quiet
  keep small/results
  mount -o remount,ro small
  expect 4 run top.json --out small/results --quiet
  on_stderr 'Read-only file system'
  intact small/results "read-only file system"
  expect 4 run top.json --out small/others --quiet
  mount -o remount,rw small
  head -c 8m /dev/zero >small/filler 2>/dev/null
  expect 4 run top.json --out small/results --quiet
  intact small/results "full disk"
  umount small && mounted=
else
  skip "full and read-only disks: mounting is not permitted"
fi
mkdir sealed
chmod 500 sealed
if [ -w sealed ]; then
  skip "a directory without permission: root writes everywhere"
else
  expect 4 run top.json --out sealed/results
  on_stderr 'Permission denied'
fi
expect 4 run top.json --out "$(printf '%0300d' 0)"
on_stderr 'File name too long'
expect 2 run top.json --out top.json/below
on_stderr 'is not a directory; '
mkdir place
ln -s place link
expect 0 run top.json --out link --quiet
[ -L link ] && [ -s place/summary.json ] || fault "a link to a directory was not followed"
ln -s nowhere dangling
ln -s circle circle
expect 2 run top.json --out dangling
on_stderr "dangling: error: is a link that does not lead to a directory; "
expect 2 run top.json --out circle
on_stderr "circle: error: cannot be examined (Too many levels of symbolic links); "
[ ! -e nowhere ] || fault "a dangling link was followed"
echo precious >precious
for file in trajectory.csv summary.json; do ln -sf "$work/precious" "place/$file"; done
expect 2 run top.json --out place
on_stderr 'its summary.json was not written by earthtop; '
expect 0 run top.json --out place --force --quiet
[ "$(cat precious)" = precious ] || fault "a link was followed, and its target overwritten"
for file in trajectory.csv summary.json; do [ ! -L "place/$file" ] || fault "$file is still a link"; done
nothing_left place
rm place/summary.json
mkfifo place/summary.json
expect 2 run top.json --out place
on_stderr 'its summary.json was not written by earthtop; '
keep old
expect 2 run top.json --out old --set /release/spin_rad_s=201
on_stderr 'holds the results of another scenario; '
intact old "another scenario"

# -- streams
timeout "$patience" "$tool" run missing.json >out.txt 2>&- </dev/null
[ $? -eq 2 ] || fault "closed standard error: not exit status 2"
timeout "$patience" "$tool" run top.json --out streams >&- 2>&- <&-
[ $? -eq 4 ] || fault "closed streams: not exit status 4"
[ "$(find streams -type f | wc -l)" -eq 4 ] || fault "closed streams: not the four result files"
timeout "$patience" "$tool" run top.json --out streams 2>err.txt | true
timeout "$patience" "$tool" run top.json --out streams >/dev/full 2>err.txt
[ $? -eq 4 ] || fault "full standard output: not exit status 4"
timeout "$patience" "$tool" run missing.json >/dev/null 2>/dev/full
[ $? -eq 2 ] || fault "full standard error: not exit status 2"
if command -v script >/dev/null; then # a terminal as standard input: the text comes from it, to the end-of-file character
  (cat top.json && printf '\004') | timeout "$patience" script -qec "'$tool' run - --out typed --quiet" /dev/null >out.txt 2>err.txt
  [ -s typed/summary.json ] || fault "a scenario typed at a terminal"
else
  skip "a terminal as standard input: no script(1)"
fi

# -- signals. The first command is long to compute, the second long to write.
sed 's/"duration_s": 0.5, "output_step_s": 0.01/"duration_s": 50000, "output_step_s": 1000/' top.json >long.json
# stopped STATUS SIGNAL SECONDS ARGUMENTS...: sends the signal after so many seconds; the program must end soon after.
stopped() {
  wanted=$1
  signal=$2
  delay=$3
  shift 3
  timeout --preserve-status -k "$patience" -s "$signal" "$delay" "$tool" "$@" >out.txt 2>err.txt </dev/null
  status=$?
  [ "$status" -eq "$wanted" ] || fault "SIG$signal after $delay s: exit status $status, not $wanted"
}
for delay in 0.02 0.2; do
  stopped 130 INT "$delay" run long.json --set method=taylor --out stopped/deep
  stopped 143 TERM "$delay" run long.json --set method=taylor --out stopped/deep
done
stopped 129 HUP 0.2 run long.json --set method=taylor --out stopped/deep
[ ! -e stopped ] || fault "an interrupted run left a directory"
expect 2 run long.json --set method=taylor --out old
rm -rf old
expect 0 run top.json --out old --quiet --set /motion/output_step_s=1e-5
keep old
for delay in 0.15 0.25 0.35 0.45; do
  timeout --preserve-status -k "$patience" -s TERM "$delay" "$tool" run top.json --out old --quiet --force \
    --set /motion/output_step_s=1e-5 >out.txt 2>err.txt </dev/null
  case $? in
    143) intact old "SIGTERM after $delay s" ;;
    0) keep old ;; # it had ended before the signal came
    *) fault "SIGTERM after $delay s: neither 143 nor 0" ;;
  esac
  nothing_left old
done
for delay in 0.25 0.35; do # what cannot be handled may leave temporaries, and the next run removes them
  timeout -s KILL "$delay" "$tool" run top.json --out old --quiet --set /motion/output_step_s=1e-5 >/dev/null 2>&1
  # While files are being moved into place, the summary has only its temporary name.
  [ -e old/summary.json ] || ls old/.summary.json.*.tmp >/dev/null 2>&1 || fault "SIGKILL after $delay s: no summary is left"
done
expect 0 run top.json --out old --quiet --set /motion/output_step_s=1e-5
nothing_left old
# The state that a run leaves if it is killed while it moves its files into place: the same scenario may continue there, another
# may not.
mv old/summary.json old/.summary.json.77-0.tmp
expect 2 run top.json --out old
on_stderr 'without a summary.json; '
expect 0 run top.json --out old --quiet --set /motion/output_step_s=1e-5
nothing_left old

# A run that is killed, or stopped by a full disk, at any of the eight renamings: without its summary.json a result does not
# count.
export ASAN_OPTIONS=detect_leaks=0 # which cannot be done under strace
if command -v strace >/dev/null && strace -o /dev/null -e trace=rename true 2>/dev/null; then
  for n in 1 2 5 8; do
    rm -rf old
    expect 0 run top.json --out old --quiet
    keep old
    strace -f -o /dev/null -e trace=rename -e "inject=rename:error=EIO:when=$n" "$tool" run top.json --out old >out.txt 2>err.txt
    [ $? -eq 4 ] || fault "renaming $n failed: not exit status 4"
    on_stderr 'old/.*: error: Input/output error'
    intact old "renaming $n failed"
    strace -f -o /dev/null -e trace=rename -e "inject=rename:signal=KILL:when=$n" "$tool" run top.json --out old >out.txt 2>&1
    [ ! -e old/summary.json ] || [ "$n" -eq 1 ] || fault "killed at renaming $n: a summary.json is there"
    expect 0 run top.json --out old --quiet
    [ "$(find old -type f | wc -l)" -eq 4 ] || fault "killed at renaming $n: the next run left more than its four files"
  done
else
  skip "failing and killed renamings: no strace(1), or not permitted"
fi

# -- surroundings
expect 0 run top.json --out plain --quiet
alone() { "$@" >out.txt 2>err.txt </dev/null || fault "$*"; }
same() { cmp -s plain/trajectory.csv "$1/trajectory.csv" && cmp -s plain/summary.json "$1/summary.json" || fault "$1: other results"; }
alone env LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 "$tool" run top.json --long --out german
same german
grep -q 'gravity 9.8 m' out.txt || fault "a decimal comma"
if command -v nm >/dev/null; then
  if nm -D --undefined-only "$tool" 2>/dev/null | grep -qE ' (setlocale|_ZNSt6locale6globalERKS_)'; then fault "a locale is set"; fi
else
  skip "whether a locale is ever set: no nm(1)"
fi
alone env TZ=Nowhere/Odd:99 "$tool" run top.json --out odd --quiet
alone env -i "$tool" run top.json --out bare --quiet
same odd
same bare
for mask in 077:600 022:644; do
  (umask "${mask%:*}" && exec "$tool" run top.json --out "mask-$mask" --quiet)
  for file in "mask-$mask"/*; do
    [ "$(stat -c %a "$file")" = "${mask#*:}" ] || fault "umask ${mask%:*}: $file has mode $(stat -c %a "$file")"
  done
done
mkdir gone
(
  cd gone && rmdir ../gone
  "$tool" run top.json >../out.txt 2>../err.txt
  [ $? -eq 2 ] || exit 1
  "$tool" run "$work/top.json" >../out.txt 2>../err.txt
  [ $? -eq 4 ] || exit 1
  "$tool" run "$work/top.json" --out "$work/from-nowhere" --quiet
) 2>/dev/null || fault "a working directory that is gone"
same from-nowhere

[ "$faults" -eq 0 ] && echo "all as expected"
[ "$faults" -eq 0 ]
