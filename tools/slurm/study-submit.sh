#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Submits a study as an array of shards and the job that puts them together, with a time limit from what the study is told to take.
#   study-submit.sh STUDY.json DIR N [SBATCH_OPTION...]
# N: number of shards. DIR: directory of the shards' stores, on a file system that all nodes share.
# The limit is three times the seconds that `earthtop study --dry-run` tells of a shard on this machine, and five minutes more; an
# option --time among SBATCH_OPTIONs takes its place.
# EARTHTOP: the program's path; default: earthtop. THREADS: processors of a shard; default: 1.
set -eu

if [[ $# -lt 3 || ! $3 =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: study-submit.sh STUDY.json DIR N [SBATCH_OPTION...]" >&2
  exit 2
fi
study=$1 dir=$2 shards=$3 threads=${THREADS:-1}
shift 3
here=$(dirname "$(realpath "$0")")
told=$("${EARTHTOP:-earthtop}" study "$study" --dry-run --json --shard "1/$shards" --jobs "$threads")
seconds=$(sed -nE 's/^ *"seconds": ([0-9.e+-]+),?$/\1/p' <<<"$told")
minutes=$(LC_ALL=C awk -v s="$seconds" 'BEGIN { m = 5 + 3 * s / 60; print (m == int(m)) ? m : int(m) + 1 }')
echo "a shard is told to take $seconds s with $threads threads; time limit: $minutes minutes" >&2
job=$(sbatch --parsable --time="$minutes" --cpus-per-task="$threads" --array="1-$shards" "$@" "$here/study-array.sbatch" "$study" "$dir")
sbatch --dependency="afterok:${job%%;*}" --kill-on-invalid-dep=yes "$here/study-merge.sbatch" "$dir"
