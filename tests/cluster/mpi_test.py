# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes of a study over MPI are killed at random moments: the points that are stored stay, the message says how to go on, and
the same command completes the study with the bytes of a run that nobody killed.
usage: mpi_test.py PATH_OF_EARTHTOP [--kills N]     N kills of a worker and N of the first process; default: 3"""
import argparse
import csv
import json
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
POINTS = 20000
PROCESSES = 3
STUDY = {
    "name": "killed",
    "base": {"site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
             "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                      "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
             "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 0.2, "output_step_s": 0.2}},
    "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80, "points": POINTS // 2}},
             {"pointer": "/release/spin_rad_s", "values": [150, 200]}],
}


def skip(reason):
    print("skipped:", reason)
    sys.exit(SKIPPED)


def environment():
    """Lets Open MPI start more processes than there are cores, as root too, as in a container."""
    return os.environ | {"OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                         "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "ASAN_OPTIONS": "detect_leaks=0"}


def command(tool, out):
    return ["mpirun", "-n", str(PROCESSES), tool, "study", "killed.json", "--quiet", "--out", out]


def stored(out):
    """Number of points in the store of a study that runs or was killed."""
    try:
        with sqlite3.connect(f"file:{out}/study.sqlite?mode=rw", uri=True, timeout=10) as store:
            return store.execute("SELECT count(*) FROM point").fetchone()[0]
    except sqlite3.OperationalError:  # it is not there yet
        return 0


def process_of_rank(tool, launcher, rank):
    """The process id of one of the launcher's children; None if it is not there yet."""
    for child in pathlib.Path(f"/proc/{launcher}/task/{launcher}/children").read_text().split():
        try:
            variables = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
            is_started = os.path.samefile(f"/proc/{child}/exe", tool)
        except OSError:
            continue
        if is_started and f"OMPI_COMM_WORLD_RANK={rank}".encode() in variables:
            return int(child)
    return None


def run_and_kill(tool, out, rank, moment):
    """Kills the process of this rank `moment` seconds after it has started.
    returns (number of points stored before, number after, seconds since points were last stored, what was printed), or None if the
    study was done by then"""
    with open("log", "w+", encoding="utf-8") as log, subprocess.Popen(command(tool, out), env=environment(), stdout=log, stderr=log,
                                                                     stdin=subprocess.DEVNULL) as launcher:
        victim = None
        while victim is None and launcher.poll() is None:
            victim = process_of_rank(tool, launcher.pid, rank)
            time.sleep(0.01)
        start = changed = time.monotonic()
        before = stored(out)
        while time.monotonic() - start < moment:
            time.sleep(0.02)
            now = stored(out)
            if now != before:
                before, changed = now, time.monotonic()
        if victim is None or launcher.poll() is not None:
            return None
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:  # it has just ended, before its launcher
            return None
        since = time.monotonic() - changed if before > 0 else 0
        launcher.wait()
        log.seek(0)
        return None if launcher.returncode == 0 else (before, stored(out), since, log.read())


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("tool")
    arguments.add_argument("--kills", type=int, default=3)
    given = arguments.parse_args()
    tool = os.path.realpath(given.tool)
    if not shutil.which("mpirun"):
        skip("there is no mpirun (Debian: openmpi-bin)")
    if not json.loads(subprocess.run([tool, "version", "--json"], check=True, capture_output=True).stdout)["mpi"]:
        skip("this program was built without MPI (Debian: libopenmpi-dev)")
    if "Open MPI" not in subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=False).stdout:
        skip("mpirun is not Open MPI's")
    seed = 20261123
    draw = random.Random(seed)
    print("seed", seed)
    faults = []
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        pathlib.Path("killed.json").write_text(json.dumps(STUDY), encoding="utf-8")
        start = time.monotonic()
        subprocess.run(command(tool, "whole"), env=environment(), check=True, stdin=subprocess.DEVNULL)
        whole_s = time.monotonic() - start
        print(f"{POINTS} points in {whole_s:.1f} s without a kill")
        for rank in (1, 0):
            kills = lost = studies = 0
            kept, ages = [], []
            while kills < given.kills:
                shutil.rmtree("out", ignore_errors=True)
                done = False
                while not done and kills < given.kills:
                    result = run_and_kill(tool, "out", rank, draw.uniform(0.05, 0.6 * whole_s))
                    done = result is None
                    if result:
                        before, after, since, text = result
                        ages.append(since)
                        kills += 1
                        lost += after < before
                        kept.append(after - before)
                        if rank != 0 and "the same command" not in text:  # goes on from there, or starts it again if nothing is stored
                            faults.append(f"no word of how to go on: {text}")
                subprocess.run(command(tool, "out"), env=environment(), check=True, stdin=subprocess.DEVNULL)
                studies += 1
                for file in ("study.csv", "study.json"):
                    if pathlib.Path("out", file).read_bytes() != pathlib.Path("whole", file).read_bytes():
                        faults.append(f"after kills of rank {rank} {file} differs")
                with open("out/study.csv", encoding="utf-8") as table:
                    if sum(1 for _ in csv.reader(table)) != POINTS + 1:
                        faults.append("points are missing")
                if list(pathlib.Path("out").glob("*.tmp")) + list(pathlib.Path("out").glob("*.lock")):
                    faults.append("something is left beside the store")
            print(f"rank {rank}: {kills} kills in {studies} studies, {lost} lost stored points; after the kill {min(kept)} to"
                  f" {max(kept)} points more were stored; the newest stored points were at most {max(ages):.2f} s old")
            if lost:
                faults.append(f"kills of rank {rank} lost stored points")
    for fault in faults:
        print("FAULT:", fault)
    return 1 if faults else 0


sys.exit(main())
