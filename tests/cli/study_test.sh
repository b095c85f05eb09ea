#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Studies as seen from a shell: exit statuses, resumption after kills, shards, processes, who holds a store.
# usage: study_test.sh PATH_OF_EARTHTOP
set -u
slurm=$(realpath "$(dirname "$0")/../../tools/slurm")
# shellcheck source=tests/cli/expect.sh
. "$(dirname "$0")/expect.sh"

cat >top.json <<'END'
{ "name": "cli-top", "site": { "latitude_deg": 45, "gravity_m_s2": 9.8 },
  "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
            "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
  "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 3 } }
END
cat >small.json <<'END'
{ "base": "top.json", "title": "A study for the shell", "axes": [
    { "pointer": "/site/latitude_deg", "range": { "from": -80, "to": 80, "points": 5 } },
    { "pointer": "/release/spin_rad_s", "values": [150, 200] } ],
  "fits": [ { "kind": "sin_latitude", "axis": "latitude_deg", "quantity": "drift.azimuth_final_rad" } ] }
END
sed 's/"points": 5/"points": 800/; s/A study for the shell/Many points/' small.json >many.json
sed 's/80, "to": 80/100, "to": 80/' small.json >failing.json
sed 's/"points": 5/"points": 1e12/' small.json >huge.json

# Usage, refusals: nothing is written.
expect 2 study
on_stderr 'a study file is needed'
expect 2 study missing.json
on_stderr 'missing.json: error: there is no such file'
expect 2 study top.json
on_stderr 'top.json:[0-9]*:[0-9]*: error: /site: unknown key'
expect 2 study small.json --shard 3/2
on_stderr '1 <= K <= N'
expect 2 study huge.json
on_stderr '2000000000000 points.*hours.*GB'
expect 2 study show missing
on_stderr 'no such store'
[ ! -e out ] || fault "a refused study left a directory"
expect 0 study small.json --dry-run
on_stdout '10 points, .* on one core, less than 0.1 MB on disk, [1-9][0-9]* MB of memory'
expect 0 study small.json --dry-run --jobs 1 --json
memory=$(sed -nE 's/.*"memory_bytes": ([0-9]+).*/\1/p' out.txt)
expect 0 study small.json --dry-run --jobs 16 --json
[ "$(sed -nE 's/.*"memory_bytes": ([0-9]+).*/\1/p' out.txt)" -gt "$memory" ] || fault "more jobs take no more memory"
[ ! -e out ] || fault "a dry run left a directory"

# A study that cannot succeed is refused before anything is written, a dry run of it too.
sed 's/latitude_deg/lattitude_deg/; s/"axis": "lattitude_deg"/"axis": "latitude_deg"/' small.json >misspelt.json
sed 's/-80, "to": 80, "points": 5/100, "to": 200, "points": 500/' small.json >hopeless.json
for flag in --dry-run --quiet; do
  expect 2 study misspelt.json $flag
  on_stderr '/axes/0/pointer: /site/lattitude_deg.*did you mean "latitude_deg"'
  expect 2 study hopeless.json $flag
  on_stderr '/site/latitude_deg: 100 is out of range.*all 20 points examined, of 1000.*--keep-going'
done
[ ! -e out ] || fault "a hopeless study left a directory"
expect 0 study hopeless.json --dry-run --keep-going
on_stdout '20 of 20 points examined are refused'
expect 1 study hopeless.json --keep-going --quiet --out room
expect 0 study small.json --out room # without --force: nothing had been completed there
on_stderr "another study's, no point of which had been completed"

# The main case.
expect 0 study small.json
on_stdout 'A study for the shell'
on_stdout 'a + b sin(latitude_deg°)'
on_stdout 'out/studies/small'
nothing_on_stderr
[ "$(wc -l <out/studies/small/study.csv)" -eq 11 ] || fault "not ten points"
expect 0 study small.json --json
on_stdout '"points_computed": 10'
expect 0 study small.json --quiet
nothing_on_stdout
expect 0 study small.json
on_stderr 'resuming: 10 of 10'
expect 0 study show out/studies/small
on_stdout 'Statistics'
expect 0 study show out/studies/small/study.sqlite --json
cmp -s out.txt out/studies/small/study.json || fault "show --json is not study.json"
expect 0 study export out/studies/small
cmp -s out.txt out/studies/small/study.csv || fault "export is not study.csv"

# Single points of a store.
expect 0 study show out/studies/small --worst drift.axis_bound_rad
on_stdout 'Worst points by drift.axis_bound_rad, largest bound first'
expect 0 study show out/studies/small --where 'latitude_deg>=40' --where 'spin_rad_s=200' --json
on_stdout '"matching": 2'
for condition in latitude_deg 'latitude>3' 'latitude_deg>north' 'status=lost' 'drift.verdict<3'; do
  expect 2 study show out/studies/small --where "$condition"
  nothing_on_stdout
  on_stderr "error: --where $condition: "
done
expect 2 study show out/studies/small --worst tilt_deg
expect 2 study show out/studies/small --worst ''

# The estimate is that of the threads and of the shard, and what Slurm's jobs are given.
expect 0 study many.json --dry-run --jobs 1 --json
whole=$(sed -nE 's/.*"core_seconds": ([0-9.e+-]+).*/\1/p' out.txt)
expect 0 study many.json --dry-run --jobs 1 --shard 1/4 --json
on_stdout '"shard_points": 400'
mkdir fake
cat >fake/sbatch <<'END'
#!/bin/sh
echo "$@" >>jobs.txt
echo 77
END
chmod +x fake/sbatch
PATH=$PWD/fake:$PATH EARTHTOP=$tool "$slurm/study-submit.sh" many.json dir 4 --partition=all >out.txt 2>err.txt ||
  fault "study-submit.sh failed"
on_stderr 'a shard is told to take [0-9.e-]* s with 1 threads; time limit: 6 minutes'
grep -q -- '--parsable --time=6 --cpus-per-task=1 --array=1-4 --partition=all .*/study-array.sbatch many.json dir' jobs.txt ||
  fault "the array is not submitted with the time told"
grep -q -- '--dependency=afterok:77 --kill-on-invalid-dep=yes .*/study-merge.sbatch dir' jobs.txt || fault "no merge is submitted"
LC_ALL=C awk -v s="$whole" 'BEGIN { exit !(s > 0) }' || fault "the study is told to take no time"

# A failed point stops nothing; another study's store is left alone.
expect 1 study failing.json --quiet
on_stderr '2 of 10 points failed'
grep -q 'refused,"\{0,1\}/site/latitude_deg' out/studies/failing/study.csv || fault "no reason in the table"
expect 2 study failing.json --out out/studies/small
on_stderr 'another study'
expect 0 study show out/studies/small
on_stdout 'A study for the shell'
expect 1 study failing.json --out out/studies/small --force

# Shards and processes give the same bytes as threads.
expect 0 study many.json --quiet --jobs 2 --out whole
for k in 1 2 3; do expect 0 study many.json --quiet --shard $k/3 --out parts; done
expect 1 study merge parts/shard-1-of-3.sqlite --out merged --quiet
on_stderr '1066 of 1600 points are missing'
expect 0 study merge parts/shard-2-of-3.sqlite parts/shard-3-of-3.sqlite --out merged --quiet
for file in study.csv study.json; do cmp -s whole/$file merged/$file || fault "merged shards differ in $file"; done
if "$tool" version --json | grep -q '"mpi": true' && command -v mpirun >/dev/null; then
  # What the launcher's library itself leaves behind at its end is not counted as a leak.
  ASAN_OPTIONS=${ASAN_OPTIONS:-}:detect_leaks=0 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    timeout "$patience" mpirun -n 3 "$tool" study many.json --quiet --out processes >out.txt 2>err.txt </dev/null ||
    fault "mpirun failed"
  for file in study.csv study.json; do cmp -s whole/$file processes/$file || fault "processes differ in $file"; done
fi

# A study is killed fifty times at random moments: nothing that was stored is lost, and the final result is the same.
stored() {
  if [ -e killed/study.sqlite ]; then "$tool" study export killed 2>/dev/null | tail -n +2 | wc -l; else echo 0; fi
}
before=0
kills=0
# shellcheck disable=SC2046
for moment in $(LC_ALL=C awk 'BEGIN { srand(20261122); for (i = 0; i < 50; ++i) printf "%.3f ", 0.005 + 0.12 * rand() }'); do
  timeout -s KILL "$moment" "$tool" study many.json --quiet --out killed >out.txt 2>err.txt </dev/null
  status=$?
  [ $status -eq 137 ] && kills=$((kills + 1))
  [ $status -eq 137 ] || [ $status -eq 0 ] || fault "killed after $moment s: exit status $status"
  now=$(stored)
  [ "$now" -ge "$before" ] || fault "$before points before the kill, $now after it"
  before=$now
done
echo "$kills kills, $before points by then"
[ "$kills" -ge 10 ] || fault "hardly a run was killed"
expect 0 study many.json --quiet --out killed
for file in study.csv study.json; do cmp -s whole/$file killed/$file || fault "after the kills $file differs"; done
[ -z "$(find killed -name '*.tmp' -o -name '*-wal' -o -name '*.lock')" ] || fault "something is left beside the store"

# While one process writes, a second one is told who holds the store; if the first one is interrupted, it keeps its points.
sed 's/"points": 800/"points": 40000/' many.json >long.json
"$tool" study long.json --jobs 1 --out held >held.txt 2>held.err </dev/null &
holder=$!
while [ ! -s held/study.sqlite.lock ]; do sleep 0.01; done
expect 2 study long.json --out held
while [ "$(cut -d' ' -f14 "/proc/$holder/stat")" -lt 150 ]; do sleep 0.01; done # hundredths of a second of the processor
on_stderr "in use by process $holder on .*, since "
kill -TERM $holder
wait $holder
status=$?
[ $status -eq 143 ] || fault "interrupted: exit status $status"
grep -q 'the same command goes on from there' held.err || fault "no word of how to go on"
kept=$("$tool" study export held | tail -n +2 | wc -l)
[ "$kept" -gt 100 ] || fault "after an interrupt only $kept points are there"
timeout -s TERM 1 "$tool" study long.json --out held >held.txt 2>held.err </dev/null
grep -q "resuming: $kept of 80000 points" held.err || fault "it does not say that it resumes"

exit $((faults > 0))
