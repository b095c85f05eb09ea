#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# earthtop gallery as users call it: what it writes, twice the same; what it refuses, and that it overwrites no file of a user.
#   tests/cli/gallery_test.sh PATH-TO-EARTHTOP [--all]     --all: the whole gallery, its size and its number of pages
set -u
# shellcheck source=tests/cli/expect.sh
scenarios=$(realpath "$(dirname "$0")/../../scenarios")
. "$(dirname "$0")/expect.sh"
TMPDIR=$work/tmp
export TMPDIR
mkdir "$TMPDIR"
nothing_is_left() { [ -z "$(ls -A "$TMPDIR")" ] || fault "$1 leaves temporary files"; }

if [ "${2:-}" = --all ]; then
  most_bytes=15000000
  expect 0 gallery whole
  nothing_is_left "the whole gallery"
  count=$(find "$scenarios" "$scenarios/studies" -maxdepth 1 -name '*.json' | wc -l)
  pages=$(find whole -name '*.html' ! -name index.html | wc -l)
  [ "$pages" -eq "$count" ] || fault "$pages pages of $count scenarios and studies"
  bytes=$(cat whole/*.html | wc -c)
  [ "$bytes" -le "$most_bytes" ] || fault "$bytes bytes, of $most_bytes"
  for page in whole/*.html; do
    name=$(basename "$page" .html)
    [ "$name" = index ] || grep -q "<li><a href=\"$name.html\"><span class=\"small\"><svg" whole/index.html || fault "$name has no card with a picture"
  done
  expect 0 gallery again --jobs 3 --quiet
  diff -r whole again >out.txt 2>err.txt || fault "two galleries differ"
  echo "$count pages, $bytes bytes, $faults faults"
  exit "$faults"
fi

few=toy-top,rolling-ball,study-flip-torques,study-gyrocompass-settles
expect 0 gallery a --only $few
on_stdout '^a/index.html: 4 pages beside it, '
nothing_on_stderr
nothing_is_left "a gallery"
[ "$(ls a | tr '\n' ' ')" = "index.html rolling-ball.html study-flip-torques.html study-gyrocompass-settles.html toy-top.html " ] || fault "other files: $(ls a)"
for name in toy-top rolling-ball study-flip-torques study-gyrocompass-settles; do
  grep -q "<li><a href=\"$name.html\"><span class=\"small\"><svg" a/index.html || fault "$name has no card with a picture"
  grep -q '<a href="index.html">The gallery</a>' a/$name.html || fault "$name does not lead back"
done
# The index says what the page says, and the page's finding is that of a report.
finding='In a minute the Earth turns this top&#39;s axis\|axis <data value="[0-9.e-]*">235.2</data> arcseconds off course'
grep -q "$finding" a/index.html || fault "no finding in the index"
grep -q "<h1>.*235.2</data> arcseconds off course</h1>" a/toy-top.html || fault "no finding on the page"
grep -q 'The page to play with runs this scene, too: it is <code>toy top</code> there.' a/toy-top.html || fault "nothing is said of the page to play with"
grep -q 'The page to play with runs one scene at a time, and no study.' a/study-flip-torques.html || fault "nothing is said of studies"

# The same bytes again, by another number of threads; it may be written where it was.
cp -r a before
expect 0 gallery a --only $few --jobs 1 --quiet
nothing_on_stdout
diff -r a before >out.txt 2>err.txt || fault "the same command gives other bytes"
expect 0 gallery a --only tippe-top --svg --json
on_stdout '"playable": true'
on_stdout '"unplayable_reason": null'
on_stdout '"a/tippe-top.svg"'
grep -q '^<svg xmlns.*class="et"' a/tippe-top.svg || fault "no picture"
[ -e a/toy-top.html ] || fault "a smaller gallery removes pages"

# What is refused: status 2, a remedy, nothing written.
mkdir mine
echo "mine" >mine/notes.txt
expect 2 gallery mine --only toy-top
on_stderr 'has other files, and no gallery; choose another directory, or --force'
[ "$(ls mine)" = notes.txt ] || fault "something was written beside a user's file"
mkdir empty
expect 0 gallery empty --only toy-top --quiet
echo "<!-- changed -->" >>empty/toy-top.html
cp empty/toy-top.html changed.html
expect 2 gallery empty --only toy-top
on_stderr 'is not as earthtop gallery wrote it; give another name, or --force'
cmp -s changed.html empty/toy-top.html || fault "a changed page was overwritten"
expect 0 gallery empty --only toy-top --force --quiet
cmp -s before/toy-top.html empty/toy-top.html || fault "--force does not write the page"
echo "mine" >file
expect 2 gallery file
on_stderr 'is not a directory'
expect 2 gallery other --only toy-tops
on_stderr 'there is no such page; did you mean toy-top?'
expect 2 gallery other --only toy-tops --json
on_stdout '"errors"'
expect 2 gallery
[ ! -e other ] || fault "something was written"
TMPDIR=$work/nowhere expect 4 gallery other --only toy-top
[ ! -e other ] || fault "something was written without a place for temporary files"

# Interrupted, it leaves nothing anywhere, and says so. The signal comes when a page is being made.
"$tool" gallery stopped >out.txt 2>err.txt &
made=$!
while kill -0 $made 2>>noise.txt && [ -z "$(ls -A "$TMPDIR")" ]; do sleep 0.05; done
kill -TERM $made
wait $made
[ $? -eq 143 ] || fault "it was not interrupted"
on_stderr 'interrupted at [0-9]* of [0-9]* pages; nothing was written; the same command starts again'
[ ! -e stopped ] || fault "an interrupted gallery leaves files"
nothing_is_left "an interrupted gallery"

echo "$faults faults"
exit "$faults"
