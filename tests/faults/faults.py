#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs jobs of earthtop while something fails under them, and prints the matrix of jobs, faults and outcomes.

usage: faults.py PROGRAM SHIM [--long | --brief] [--seed N] [--workers N] [--only JOB,...] [--kinds KIND,...] [--verbose]

PROGRAM is the program earthtop, SHIM the library made of fault_shim.cpp, which makes the n-th call of a kind fail. The numbers n
are a geometric series and random ones from a seed, between 1 and the number of such calls in an undisturbed job. Faults that
need no shim are small stacks, little memory, and SIGKILL at random moments.

After each fault these must hold:
  - the job ends by itself, with a status of the contract: 3 if memory or threads are lacking, 2 or 4 if a system call fails, 0 if
    it could do without; and says why on standard error, or with --json in a document on standard output;
  - if its status is 0, it printed what it prints undisturbed, and its results are there;
  - no file is left that neither the job's beginning nor its end knows (unless it was killed);
  - its results are the old ones or the new ones, all of them;
  - the same job, started again, ends as if nothing had happened.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile

# Files that differ from run to run, and what a study that is to be resumed consists of.
VARYING = re.compile(r"timing\.json$|\.sqlite$|report\.html$")
RESUMABLE = re.compile(r"\.sqlite(-wal|-shm|-journal)?$")

TOP = {"name": "top", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
       "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
       "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 2, "output_step_s": 0.1}}
STUDY = {"base": "top.json", "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80, "points": 5}},
                                      {"pointer": "/release/spin_rad_s", "values": [150, 200]}],
         "fits": [{"kind": "sin_latitude", "axis": "latitude_deg", "quantity": "drift.azimuth_final_rad"}]}
MANY = dict(STUDY, axes=[{"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80, "points": 160}}, STUDY["axes"][1]])

Job = collections.namedtuple("Job", "name arguments again kinds")
READS = ("alloc", "open", "stat", "read", "write")
WRITES = READS + ("fsync", "rename", "remove", "change", "kill")
THREADS = WRITES + ("thread",)


def job(name, arguments, kinds=READS, again=None):
    """A job: its name, its command line, the faults it meets, and the command line that starts it again."""
    return Job(name, arguments.split(), (again or arguments).split(), kinds + ("stack", "memory"))


JOBS = [
    job("check", "check top.json"),
    job("run", "run top.json --out new --jobs 2", THREADS),
    job("run --force", "run top.json --out old --force --jobs 2", THREADS),
    job("run --json", "run top.json --out new --json --jobs 1", THREADS),
    job("explain", "explain top.json"),
    job("study", "study study.json --out studied --jobs 2", THREADS),
    job("study of 320", "study many.json --out many --jobs 2 --json", ("kill", "change", "thread")),
    job("study show", "study show done"),
    job("study export", "study export done"),
    job("study merge", "study merge shards/shard-1-of-2.sqlite shards/shard-2-of-2.sqlite --out merged", WRITES),
    job("compare", "compare old reference"),
    job("compare --json", "compare old reference --json"),
    job("compare --update", "compare compact.json old --update --reason faults", WRITES),
    job("update several", "compare references several --update --reason faults", WRITES),
    job("report", "report reference", WRITES),
    job("report a study", "report done", WRITES),
    job("plan", "plan top.json --measure drift_azimuth_rad --sigma 1e-6 --every 0.1 --svg plan.svg", WRITES),
    job("example", "example"),
    job("schema", "schema"),
]

# Statuses that a fault may cause, beside that of the undisturbed job.
ALLOWED = {"alloc": {3}, "before": {3}, "thread": {3}, "stack": {2, 3}, "memory": {3}, "write": {4}, "fsync": {4}, "rename": {4},
           "remove": {4}, "open": {2, 3, 4}, "stat": {2, 4}, "read": {2, 4}, "change": set(), "kill": set()}


class Bench:
    """Where jobs are run: each in a copy of a directory that holds what they read."""

    def __init__(self, program, shim, folder):
        self.program, self.shim, self.folder = program, shim, folder
        self.template = folder / "template"
        self.template.mkdir()
        for name, document in (("top.json", TOP), ("study.json", STUDY), ("many.json", MANY)):
            (self.template / name).write_text(json.dumps(document))
        other = "--set /release/spin_rad_s=210"
        for line in (f"run top.json --out old {other} --quiet", "run top.json --out reference --quiet",
                     "study study.json --out done --quiet", "study study.json --out shards --shard 1/2 --quiet",
                     "study study.json --out shards --shard 2/2 --quiet",
                     "compare compact.json reference --update --reason first --quiet",
                     "compare references/a reference --update --reason first --quiet",
                     "compare references/b.json reference --update --reason first --quiet",
                     f"run top.json --out several/a {other} --quiet", f"run top.json --out several/b {other} --quiet",
                     "study study.json --out several/study --quiet"):
            made = self.run(line.split(), self.template)
            if made.returncode != 0:
                sys.exit(f"earthtop {line}: {made.stderr}")
        self.before = contents(self.template)
        # The least address space (KiB) in which the loader gets as far as the program.
        low, self.least_memory = 1_000, 1_000_000
        while self.least_memory - low > 100:
            middle = (low + self.least_memory) // 2
            loads = self.run(["version"], self.template, limits=f"ulimit -v {middle}").returncode in (0, 3)
            low, self.least_memory = (low, middle) if loads else (middle, self.least_memory)

    def run(self, arguments, where, fault=None, limits=None, counts=None, seconds=60):
        environment = dict(os.environ, LC_ALL="C")
        command = [self.program, *arguments]
        if fault or counts:
            environment.update(LD_PRELOAD=str(self.shim), EARTHTOP_FAULT=fault or "", EARTHTOP_FAULT_COUNTS=str(counts or ""))
        if limits:
            command = ["bash", "-c", f'{limits} && exec "$@"', "bash", *command]
        try:
            return subprocess.run(command, cwd=where, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                  errors="replace", timeout=seconds, check=False)
        except subprocess.TimeoutExpired:
            return None

    def kill_after(self, arguments, where, delay):
        """Runs a job and kills it after `delay` seconds."""
        process = subprocess.Popen([self.program, *arguments], cwd=where, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        try:
            out, err = process.communicate(timeout=delay)
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
        return subprocess.CompletedProcess(arguments, process.returncode, out, err)

    def fresh(self):
        where = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        shutil.copytree(self.template, where, dirs_exist_ok=True)
        return where


def contents(folder):
    """The files below a folder with their bytes; None for those that differ from run to run."""
    return {str(path.relative_to(folder)): None if VARYING.search(path.name) else path.read_bytes()
            for path in folder.rglob("*") if path.is_file()}


def steady(text):
    """A text without what differs from run to run: times, the breaks of lines that depend on their lengths, and names of temporary
    directories."""
    text = re.sub(r"\d[\d.e+-]*\s+s\b", "# s", text)
    lines = [re.sub(r"\d[\d.e+-]*", "#", line) if re.search(r"second|time|host", line) else line for line in text.splitlines()]
    return " ".join(" ".join(lines).split())


class Undisturbed:
    """How a job ends without a fault."""

    def __init__(self, bench, job):
        where, counts = bench.fresh(), bench.folder / "counts"
        self.end = bench.run(job.arguments, where)
        self.after = contents(where)
        self.again = bench.run(job.again, where)
        self.after_again = contents(where)
        shutil.rmtree(where)
        where = bench.fresh()
        counted = bench.run(job.arguments, where, counts=counts)
        if counted is None or counted.returncode != self.end.returncode:
            sys.exit(f"{job.name} does not end as usual under the shim: {counted and counted.stderr}")
        self.counts = dict(line.split() for line in counts.read_text().splitlines())
        shutil.rmtree(where)
        self.folders = {name.split("/")[0] for name in self.after
                        if "/" in name and self.after[name] != bench.before.get(name, b"")}


def mixed(before, after, now, folder):
    """Whether the results in a folder are neither the old nor the new ones. Those of a study are made of its store, each file on
    its own."""
    known = [name for name in {**before, **after} if name.startswith(folder + "/") and not VARYING.search(name)]
    whole = [all(now.get(name) == state.get(name) for name in known) for state in (before, after)]
    is_study = any(RESUMABLE.search(name) for name in after if name.startswith(folder + "/"))
    each = all(now.get(name) in (before.get(name), after.get(name)) for name in known)
    return not (any(whole) or (is_study and each))


def problems(bench, job, usual, kind, mode, end, where):
    """What is wrong after a fault, in words of a few letters."""
    if end is None:
        return ["hangs"]
    found = []
    killed = mode == "kill" and end.returncode == -signal.SIGKILL
    if end.returncode < 0 and not killed:
        found.append("signal")
    elif (not killed and end.returncode != usual.end.returncode and end.returncode not in ALLOWED[kind]
          and not (kind in ("read", "stat") and "is damaged" in end.stderr)):  # so says SQLite of what it cannot read
        found.append("status")
    now = contents(where)
    if end.returncode > 0 and end.returncode != usual.end.returncode:
        told = end.stderr if "--json" not in job.arguments else end.stdout + end.stderr
        if not told.strip():
            found.append("silent")
    if end.returncode == usual.end.returncode:
        if steady(end.stdout) != steady(usual.end.stdout):
            found.append("output")
        if {name for name in usual.after if name not in now}:
            found.append("missing")
        elif any(now[name] != usual.after[name] for name in usual.after):
            found.append("results")
    if not killed:
        left = [name for name in now if name not in usual.after and name not in bench.before and not RESUMABLE.search(name)]
        if kind == "stat":  # whose lock it is cannot be told, and another process's must not be removed
            left = [name for name in left if not name.endswith(".lock")]
        # Where nothing can be removed or, time and again, renamed, files under temporary names cannot be but left.
        clears_up = kind != "remove" and (kind, mode) != ("rename", "on")
        if left and clears_up:
            found.append("left")
        if clears_up and any(mixed(bench.before, usual.after, now, folder) for folder in usual.folders):
            found.append("mixed")
    if "kill" in job.kinds or "fsync" in job.kinds:
        again = bench.run(job.again, where)
        now = contents(where)
        if again is None or again.returncode not in (usual.end.returncode, usual.again.returncode):
            found.append("next")
        elif all(any(now.get(name, b"") != state[name] for name in state) for state in (usual.after, usual.after_again)):
            found.append("next results")
        elif [name for name in now if name not in usual.after and name not in bench.before]:
            found.append("next left")
    return found


def numbers(count, wanted, seed):
    """Numbers from 1 to `count`: half of them in a geometric series, half at random."""
    if count <= wanted:
        return list(range(1, count + 1))
    half = max(1, wanted // 2)
    series = {round(count ** (i / max(1, half - 1))) for i in range(half)}
    return sorted(series | set(random.Random(seed).sample(range(1, count + 1), wanted - half)))


def plan_faults(bench, job, usual, arguments):
    """The faults of a job: kind, mode, number or limit."""
    faults = []
    few, some, many = (2, 3, 8) if arguments.brief else (200, 400, 1500) if arguments.long else (5, 6, 20)
    for kind in job.kinds:
        if arguments.kinds and kind not in arguments.kinds:
            continue
        seed = f"{arguments.seed} {job.name} {kind}"
        count = int(usual.counts.get(kind, 0))
        if kind == "alloc":
            faults += [(kind, mode, n) for mode in ("once", "on") for n in numbers(count, many, seed + mode)]
        elif kind == "change":
            faults += [(kind, "kill", n) for n in numbers(count, some, seed)]
        elif kind == "kill":
            source = random.Random(seed)
            faults += [(kind, "kill", source.random()) for _ in range(some)]
        elif kind == "stack":
            faults += [(kind, "limit", kib) for kib in ((64,) if arguments.brief else (64, 511, 512))]
        elif kind == "memory":
            steps = range(0, 40, 15 if arguments.brief else 1 if arguments.long else 6)
            faults += [(kind, "limit", round(bench.least_memory * 1.015 ** i)) for i in steps]
        else:
            faults += [(kind, mode, n) for mode in ("once", "on") for n in numbers(count, few, seed + mode)]
    if not arguments.kinds or "before" in arguments.kinds:
        faults += [("before", mode, n) for mode in ("once", "on") for n in numbers(int(usual.counts["before"]), few, job.name)]
    return faults


def disturb(bench, job, usual, fault, seconds):
    kind, mode, number = fault
    where = bench.fresh()
    try:
        if kind == "kill":
            end = bench.kill_after(job.arguments, where, number * seconds)
        elif mode == "limit":
            end = bench.run(job.arguments, where, limits=f"ulimit -{'s' if kind == 'stack' else 'v'} {number}")
        else:
            end = bench.run(job.arguments, where, fault=f"{kind}:{number}:{mode}")
        return end and end.returncode, problems(bench, job, usual, kind, mode, end, where), end
    finally:
        shutil.rmtree(where, ignore_errors=True)


# What a job says of one of its calls that fails.
SENTENCES = [("check", "stat", "top.json: error: cannot be examined (Input/output error); check the file"),
             ("compare", "stat", "cannot be examined (Input/output error); check the disk"),
             ("check", "read", "top.json: error: reading failed (Input/output error); check the file")]


def unsaid(bench):
    """The sentences that no failing call of their job brings about."""
    missing = []
    for name, kind, sentence in SENTENCES:
        job_ = next(one for one in JOBS if one.name == name)
        count = int(Undisturbed(bench, job_).counts.get(kind, 0))
        ends = (bench.run(job_.arguments, bench.fresh(), fault=f"{kind}:{n}:once") for n in range(1, count + 1))
        if not any(end and end.returncode == 4 and sentence in end.stderr for end in ends):
            missing.append(f"{name}, {kind}: not said: {sentence}")
    return missing


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("shim")
    parser.add_argument("--long", action="store_true", help="many more faults of each kind: some hours")
    parser.add_argument("--brief", action="store_true", help="a few faults of each kind: some seconds")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--only", type=lambda text: text.split(","), default=[])
    parser.add_argument("--kinds", type=lambda text: text.split(","), default=[])
    parser.add_argument("--verbose", action="store_true", help="print every fault with a problem, to be repeated by hand")
    arguments = parser.parse_args()
    program, shim = os.path.abspath(arguments.program), os.path.abspath(arguments.shim)

    memory_disk = pathlib.Path("/dev/shm")
    with tempfile.TemporaryDirectory(prefix="earthtop-faults-", dir=memory_disk if memory_disk.is_dir() else None) as folder, \
            concurrent.futures.ThreadPoolExecutor(arguments.workers) as pool:
        bench = Bench(program, shim, pathlib.Path(folder))
        missing = unsaid(bench)
        print("\n".join(missing), end="\n" if missing else "")
        print(f"{'job':18} {'fault':12} {'faults':>6}  status: how often; problems (seed {arguments.seed})")
        total, wrong = 0, len(missing)
        for job_ in JOBS:
            if arguments.only and job_.name not in arguments.only:
                continue
            usual = Undisturbed(bench, job_)
            rows = collections.OrderedDict()
            faults = plan_faults(bench, job_, usual, arguments)
            seconds = 0.6 if job_.name == "study of 320" else 0.08
            for fault, (status, found, end) in zip(faults, pool.map(lambda f: disturb(bench, job_, usual, f, seconds), faults)):
                row = rows.setdefault(f"{fault[0]} {fault[1]}", [collections.Counter(), collections.Counter()])
                row[0][status if status is not None else "none"] += 1
                row[1].update(found)
                total += 1
                wrong += bool(found)
                if found and arguments.verbose:
                    said = (end.stderr.strip().splitlines() or [""])[-1] if end else ""
                    print(f"    {job_.name}: {fault[0]}:{fault[2]}:{fault[1]}: {status}, {', '.join(found)}; {said[:160]}")
            for name, (statuses, found) in rows.items():
                counted = " ".join(f"{s}:{n}" for s, n in sorted(statuses.items(), key=lambda item: str(item[0])))
                trouble = " ".join(f"{p}:{n}" for p, n in sorted(found.items()))
                print(f"{job_.name:18} {name:12} {sum(statuses.values()):6}  {counted:24} {trouble}", flush=True)
    print(f"{total} faults, {wrong} with problems")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
