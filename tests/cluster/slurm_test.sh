#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The job scripts of tools/slurm on a Slurm of its own: two nodes of two processors each on this machine. Nodes are drained, tasks are
# killed, requeued and cancelled in the middle; nothing that is stored is lost, and the study.csv is that of a run without Slurm.
# usage: slurm_test.sh PATH_OF_EARTHTOP
# Status 77: skipped, since something is not installed.
set -u
tool=$(realpath "$1") || exit 1
scripts=$(realpath "$(dirname "$0")/../../tools/slurm") || exit 1
for program in munged slurmctld slurmd sbatch scontrol; do
  PATH=$PATH:/usr/sbin command -v $program >/dev/null || { echo "skipped: there is no $program (Debian: slurm-wlm, munge)"; exit 77; }
done
PATH=$PATH:/usr/sbin
work=$(mktemp -d) || exit 1
chmod 755 "$work" # munge refuses to have its socket where others may write
cd "$work" || exit 1
faults=0
fault() {
  echo "FAULT: $1" >&2
  faults=$((faults + 1))
}

# The private Slurm.
export SLURM_CONF=$work/slurm.conf EARTHTOP=$tool
port=$((20000 + $$ % 10000))
user=$(id -un) host=$(hostname -s)
cat >slurm.conf <<END
ClusterName=trial
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
# A requeued job waits until its credential has expired: seconds.
AuthInfo=socket=$work/munge.socket,cred_expire=2
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd-%n.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
KillWait=5
MinJobAge=3600
ReturnToService=2
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES State=UP
END
mkdir state spool-n1 spool-n2
end() {
  scancel --user="$user" 2>/dev/null && sleep 1
  for file in slurmd-n1.pid slurmd-n2.pid slurmctld.pid munged.pid; do
    [[ -s $file ]] && kill "$(cat $file)" 2>/dev/null
  done
  sleep 1
  [[ $faults -eq 0 ]] || tail -n 20 ./*.log
  rm -rf "$work"
}
trap end EXIT
(umask 077 && head -c 1024 /dev/urandom >munge.key)
if ! munged --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
  --log-file="$work/munged.log" --seed-file="$work/munge.seed" || ! slurmctld -f "$SLURM_CONF" ||
  ! slurmd -f "$SLURM_CONF" -N n1 || ! slurmd -f "$SLURM_CONF" -N n2; then
  fault "Slurm does not start"
  exit 1
fi

# wait_until SECONDS CONDITION...: waits, at most so long. It is no limit on speed, but ends a test that would never end.
wait_until() {
  local left=$(($1 * 10))
  shift
  until "$@"; do
    left=$((left - 1))
    [[ $left -gt 0 ]] || { fault "waited in vain until: $*"; scontrol show job >&2; return 1; }
    sleep 0.1
  done
}
nodes_are_up() { [[ $(sinfo --noheader --states=idle --format=%D 2>/dev/null) == 2 ]]; }
# state JOB: the states of a job, of all tasks of an array, each once.
state() { scontrol show job "$1" | grep -o 'JobState=[A-Z_]*' | sort -u | cut -d= -f2 | paste -sd ' '; }
is_over() { ! state "$1" | grep -qE 'PENDING|RUNNING|COMPLETING|REQUEUED|CONFIGURING'; }
node_of() { scontrol show job "$1" | grep -o ' BatchHost=.*' | cut -d= -f2; }
# points STORE: number of points in a store.
points() { if [[ -s $1 ]]; then "$tool" study export "$1" 2>/dev/null | tail -n +2 | wc -l; else echo 0; fi; }
has_points() { [[ $(points "$1") -gt 0 ]]; }
# processes VARIABLE=VALUE: ids of the program's processes in this directory with this variable in their environment.
processes() {
  local process
  for process in /proc/[0-9]*; do
    [[ $process/exe -ef $tool && $process/cwd -ef $work ]] && tr '\0' '\n' <"$process/environ" 2>/dev/null | grep -qx "$1" &&
      echo "${process#/proc/}"
  done
}
is_started() { [[ -n $(processes "$1") ]]; }
same() {
  for file in study.csv study.json; do cmp "whole/$file" "$1/$file" || fault "$1: $file differs from that of a run without Slurm"; done
}
# requeue JOB: without the minutes that Slurm lets pass before it starts the job again.
requeue() {
  scontrol requeue "$1" || { fault "job $1 could not be requeued"; return; }
  wait_until 60 is_pending "$1" && scontrol update jobid="$1" StartTime=now
}
is_pending() { [[ $(state "$1") == PENDING ]]; }
submit_array() { sbatch --parsable --output="$1.log" --array=1-4 "$scripts/study-array.sbatch" study.json "$1"; }
submit_merge() {
  sbatch --parsable --output="$2-merge.log" --dependency="afterok:$1" --kill-on-invalid-dep=yes "$scripts/study-merge.sbatch" "$2"
}

cat >study.json <<'END'
{ "base": { "site": { "latitude_deg": 45, "gravity_m_s2": 9.8 },
    "body": { "mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03], "inertia": { "about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5] } },
    "release": { "tilt_deg": 20, "spin_rad_s": 200 }, "motion": { "duration_s": 0.2, "output_step_s": 0.2 } },
  "axes": [ { "pointer": "/site/latitude_deg", "range": { "from": -80, "to": 80, "points": 300 } },
            { "pointer": "/release/spin_rad_s", "range": { "from": 150, "to": 250, "points": 200 } } ] }
END
"$tool" study study.json --out whole --quiet || fault "the study without Slurm failed"
wait_until 60 nodes_are_up || exit 1

# An array of four shards, and their merge.
array=$(submit_array plain)
merge=$(submit_merge "$array" plain)
wait_until 300 is_over "$merge" && same plain
echo "array of 4 shards and merge: $(state "$array"), $(state "$merge"), $(points plain/study.sqlite) points"

# In the middle: a node is drained, a task on it requeued; another task's program is killed, and a third task is cancelled.
array=$(submit_array trouble)
merge=$(submit_merge "$array" trouble)
for k in 1 2 3 4; do wait_until 60 has_points "trouble/shard-$k-of-4.sqlite"; done
scontrol update nodename=n1 state=drain reason=trial
drained=0 killed=0 cancelled=0
for k in 1 2 3 4; do
  before[k]=$(points "trouble/shard-$k-of-4.sqlite")
  if [[ $drained -eq 0 && $(node_of "${array}_$k") == n1 ]]; then
    drained=$k
    requeue "${array}_$k"
  elif [[ $killed -eq 0 ]]; then
    killed=$k
    # shellcheck disable=SC2046
    kill -KILL $(processes SLURM_ARRAY_TASK_ID=$k) || fault "shard $k had no process to kill"
  elif [[ $cancelled -eq 0 ]]; then
    cancelled=$k
    scancel "${array}_$k" || fault "shard $k could not be cancelled"
  fi
done
sleep 1
for k in 1 2 3 4; do
  now=$(points "trouble/shard-$k-of-4.sqlite")
  [[ $now -ge ${before[k]} ]] || fault "shard $k had ${before[k]} points before, and $now after"
done
echo "drained and requeued: shard $drained; killed: shard $killed; cancelled: shard $cancelled; points stored by then: ${before[*]}"
wait_until 300 is_over "$array"
wait_until 60 is_over "$merge"
[[ $(node_of "${array}_$drained") == n2 ]] || fault "the requeued task ran on the drained node"
grep -q 'was killed (status 137)' trouble.log || fault "the killed program was not started again"
[[ $(grep -c 'resuming: ' trouble.log) -ge 2 ]] || fault "the killed and the requeued task did not go on from the store"
[[ $(state "$merge") == CANCELLED ]] || fault "shards were merged although one had been cancelled: $(state "$merge")"
array=$(submit_array trouble) # while the node is still drained
merge=$(submit_merge "$array" trouble)
wait_until 300 is_over "$merge" && same trouble
echo "the same commands again: $(state "$array"), $(state "$merge"), $(points trouble/study.sqlite) points"
scontrol update nodename=n1 state=resume

# One job of MPI processes: a process is killed, then the job is requeued.
if ! command -v mpirun >/dev/null || ! "$tool" version --json | grep -q '"mpi": true'; then
  echo "skipped: MPI (no mpirun, or a program without MPI)"
else
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 # as in a container
  job=$(sbatch --parsable --output=mpi.log --nodes=1 --ntasks=2 "$scripts/study-mpi.sbatch" study.json mpi)
  wait_until 60 has_points mpi/study.sqlite
  first=$(points mpi/study.sqlite)
  kill -KILL "$(processes OMPI_COMM_WORLD_RANK=1)" || fault "there was no worker to kill"
  sleep 2
  wait_until 60 is_started OMPI_COMM_WORLD_RANK=1
  sleep 1
  second=$(points mpi/study.sqlite)
  requeue "$job"
  sleep 1
  third=$(points mpi/study.sqlite)
  [[ $first -le $second && $second -le $third ]] || fault "points were lost: $first, $second, $third"
  wait_until 300 is_over "$job" && same mpi
  grep -q 'lost a process (status 137)' mpi.log || fault "the processes were not started again"
  [[ $(grep -c 'resuming: ' mpi.log) -eq 2 ]] || fault "it did not go on from the store twice"
  echo "MPI: $(state "$job"); points when a worker was killed, when the job was requeued, after it: $first, $second, $third"
fi
exit $((faults > 0))
