#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Updates references while another process rewrites the new results, and while the update is killed, and prints what became of
the references.

usage: updates.py PROGRAM [SHIM] [--brief] [--updates N] [--kills N] [--seed N]

Beside a writer, an update must end with status 0 and a reference that holds one of the versions that the writer writes, whole,
or be refused with status 2 and leave the reference as it was. Killed at a random moment, an update of several references must leave
all old or all new ones, as the next comparison sees them, and the same command must then succeed and leave the new ones and
nothing else. With the SHIM made of fault_shim.cpp it is killed at its system calls that change a file, too.
"""
import argparse
import collections
import filecmp
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

TOP = {"name": "top", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
       "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
       "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 2, "output_step_s": 0.02}}
STUDY = {"base": "top.json", "axes": [{"pointer": "/site/latitude_deg", "values": [-40, 10, 60]}]}
RESULTS = ("trajectory.csv", "torques.csv", "drift.svg", "timing.json", "summary.json")
NOTES = "reference.json"


class Bench:
    def __init__(self, program, shim, folder, seed):
        self.program, self.shim, self.folder, self.seed = program, shim, folder, seed
        (folder / "top.json").write_text(json.dumps(TOP))
        (folder / "study.json").write_text(json.dumps(STUDY))

    def start(self, line, **more):
        return subprocess.Popen([self.program, *line.split()], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, **more)

    def do(self, line, **more):
        process = self.start(line, **more)
        said = process.communicate(timeout=120)[0]
        return process.returncode, said

    def must(self, line):
        status, said = self.do(line)
        if status != 0:
            sys.exit(f"earthtop {line}: {status}: {said}")

    def make_several(self, name, spin):
        """Results of three runs and a study below one directory, of a version that the spin tells."""
        for member in ("a", "b", "deep/c"):
            self.must(f"run top.json --out {name}/{member} --set /release/spin_rad_s={spin} --quiet")
        (self.folder / f"study-{spin}.json").write_text(json.dumps(dict(STUDY, base=f"top-{spin}.json")))
        (self.folder / f"top-{spin}.json").write_text(json.dumps(dict(TOP, release={"tilt_deg": 20, "spin_rad_s": spin})))
        self.must(f"study study-{spin}.json --out {name}/study --quiet")

    def is_same(self, reference, new):
        return self.do(f"compare {reference} {new} --profile bitwise --quiet")[0] == 0


def holds(reference):
    """The files of a reference, for the check that a refused update left all as it was."""
    if not reference.exists():
        return None
    if reference.is_file():
        return reference.read_bytes()
    return {str(path.relative_to(reference)): path.read_bytes() for path in reference.rglob("*") if path.is_file()}


class Writer:
    """Rewrites results in a loop. Its versions are those of two spins."""

    def __init__(self, bench, way):
        self.bench, self.way, self.ends, self.count, self.faults = bench, way, False, 0, 0
        self.thread = threading.Thread(target=self.write)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ends = True
        self.thread.join()

    def write(self):
        while not self.ends:
            spin = (150, 160)[self.count % 2]
            if self.way in ("run", "runs"):
                for member in ("new",) if self.way == "run" else ("several/one", "several/two"):
                    self.must(f"run top.json --out {member} --force --quiet --set /release/spin_rad_s={spin}")
            elif self.way == "study":
                self.must(f"study study-{spin}.json --out studied --force --quiet")
            else:  # another program, which knows of no lock and writes into the files
                for name in RESULTS:
                    version = self.bench.folder / f"version-{spin}" / name
                    if version.exists():
                        with open(version, "rb") as source, open(self.bench.folder / "new" / name, "wb") as target:
                            shutil.copyfileobj(source, target, 4096)
            self.count += 1

    def must(self, line):
        status, said = self.bench.do(line)
        if status != 0:
            print(f"    the writer ended with {status}: {said.strip()}")
            self.faults += 1


def is_whole(bench, kind, reference, versions):
    """Whether a reference holds one version and nothing else."""
    if kind == "several":
        return all(is_whole(bench, "directory", reference / member, versions) for member in ("one", "two"))
    if sum(bench.is_same(reference, version) for version in versions) != 1:
        return False
    if kind != "directory":
        return True
    names = {path.name for path in reference.iterdir()} - {NOTES}
    return any(names == {path.name for path in version.iterdir()} and
               all(filecmp.cmp(reference / name, version / name, shallow=False) for name in names if name != "timing.json")
               for version in versions)


def beside_a_writer(bench, updates, way, kind):
    """Counts the ends of updates of one reference beside a writer."""
    ends = collections.Counter()
    reference = bench.folder / ("reference.json" if kind == "compact" else "reference")
    new = {"several": "several", "study": "studied"}.get(kind, "new")
    versions = [bench.folder / f"{'studied' if kind == 'study' else 'version'}-{spin}" for spin in (150, 160)]
    if kind == "several":
        for member in ("one", "two"):
            shutil.copytree(versions[0], reference / member)
    before = holds(reference)
    with Writer(bench, way) as writer:
        for number in range(updates):
            status, said = bench.do(f"compare {reference.name} {new} --update --reason number-{number} --quiet")
            if status == 0:
                ends["0, whole" if is_whole(bench, kind, reference, versions) else "0, TORN"] += 1
            else:
                told = "writing there" in said or "damaged" in said or "in use" in said
                ends[f"{status}, {'as before' if holds(reference) == before else 'LOST'}{'' if told else ', in other words'}"] += 1
                if not told:
                    print("    " + said.strip())
            before = holds(reference)
    if writer.faults:
        ends["RUNS DISTURBED"] = writer.faults
    shutil.rmtree(reference) if reference.is_dir() else reference.unlink(missing_ok=True)
    return ends, writer.count


def killed(bench, kills, by_call):
    """Kills updates of four references and counts how they are found."""
    ends = collections.Counter()
    source = random.Random(f"{bench.seed} {by_call}")
    command = "compare references {} --update --reason {} --quiet"
    bench.must(command.format("old", "first"))
    template = bench.folder / "references-old"
    (bench.folder / "references").rename(template)
    shutil.copytree(template, bench.folder / "references")
    start = time.monotonic()
    bench.must(command.format("newer", "second"))
    seconds = 1.1 * (time.monotonic() - start)
    shutil.rmtree(bench.folder / "references")
    shutil.copytree(template, bench.folder / "references")
    counts = bench.folder / "counts"
    environment = dict(os.environ, LD_PRELOAD=str(bench.shim), EARTHTOP_FAULT_COUNTS=str(counts)) if bench.shim else None
    status, said = bench.do(command.format("newer", "second"), env=environment)
    calls = int(dict(line.split() for line in counts.read_text().splitlines())["change"]) if bench.shim else 0
    new_state = holds(bench.folder / "references")
    old_state = holds(template)
    if status != 0:
        sys.exit(f"the update under the shim: {status}: {said}")
    for number in range(min(kills, calls) if by_call else kills):
        shutil.rmtree(bench.folder / "references")
        shutil.copytree(template, bench.folder / "references")
        if by_call:
            at = 1 + number * calls // min(kills, calls)
            fault = dict(os.environ, LD_PRELOAD=str(bench.shim), EARTHTOP_FAULT=f"change:{at}:kill")
            status, _ = bench.do(command.format("newer", "second"), env=fault)
        else:
            process = bench.start(command.format("newer", "second"))
            time.sleep(source.random() * seconds)
            process.kill()
            process.communicate()
            status = process.returncode
        end = "killed" if status == -signal.SIGKILL else f"status {status}"
        left = (bench.folder / "references/.earthtop-update").exists()
        # A comparison of one reference or of all of them, or none, comes between the kill and the next update.
        reading = number % 3
        if reading == 1:
            bench.do("compare references/deep newer/deep --quiet")
        if reading == 0:
            is_old = bench.is_same("references", "old")
            is_new = bench.is_same("references", "newer")
            found = "old" if is_old else "new" if is_new else "MIXED"
            now = holds(bench.folder / "references")
            if found != "MIXED" and now != (old_state if is_old else new_state):
                found += ", OTHER FILES"
        elif reading == 1:
            now = holds(bench.folder / "references")
            found = "old" if now == old_state else "new" if now == new_state else "MIXED"
        else:
            found = "not read"
        status, said = bench.do(command.format("newer", "second"))
        now = holds(bench.folder / "references")
        whole = status == 0 and now == new_state
        if not whole or not bench.is_same("references", "newer"):
            print(f"    kill {number}: then {status}: {said.strip()}")
        ends[f"{end:10} {'staging left' if left else '':13} read: {found:10} then: {'new, whole' if whole else 'WRONG'}"] += 1
    shutil.rmtree(bench.folder / "references")
    shutil.rmtree(template)
    return ends


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("shim", nargs="?")
    parser.add_argument("--brief", action="store_true", help="some seconds")
    parser.add_argument("--updates", type=int, default=80)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    updates, kills = (4, 6) if arguments.brief else (arguments.updates, arguments.kills)
    wrong = 0

    def tell(title, ends):
        nonlocal wrong
        print(title)
        for end, count in sorted(ends.items()):
            print(f"  {count:5}  {end}", flush=True)
            wrong += count * any(word in end for word in ("TORN", "LOST", "MIXED", "WRONG", "OTHER", "DISTURBED", "status 4", "status -1"))

    with tempfile.TemporaryDirectory(prefix="earthtop-updates-") as name:
        bench = Bench(os.path.abspath(arguments.program), arguments.shim and os.path.abspath(arguments.shim),
                      pathlib.Path(name), arguments.seed)
        for spin in (150, 160):
            bench.must(f"run top.json --out version-{spin} --quiet --set /release/spin_rad_s={spin}")
        bench.make_several("old", 150)
        bench.make_several("newer", 160)
        for spin, source in ((150, "old"), (160, "newer")):
            shutil.copytree(bench.folder / source / "study", bench.folder / f"studied-{spin}")
        for new in ("new", "several/one", "several/two"):
            shutil.copytree(bench.folder / "version-150", bench.folder / new)
        shutil.copytree(bench.folder / "studied-150", bench.folder / "studied")
        for way, kind in (("run", "directory"), ("run", "compact"), ("runs", "several"), ("copy", "directory"), ("copy", "compact"),
                          ("study", "study")):
            ends, written = beside_a_writer(bench, updates, way, kind)
            tell(f"{updates} updates, reference: {kind}; writer: {way}, {written} times", ends)
        # Two of the references are compact, and two are directories.
        for member in ("a", "study"):
            shutil.copytree(bench.folder / "old" / member, bench.folder / "references" / member)
        template = bench.folder / "references"
        shutil.copytree(template, bench.folder / "seed")
        tell(f"{kills} kills at random moments of an update of four references:", killed(bench, kills, False))
        if bench.shim:
            shutil.copytree(bench.folder / "seed", template)
            tell("kills at calls that change files:", killed(bench, kills, True))
    print(f"{wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
