# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten times as many points take no more memory, and no more than their share of processor time, in any job on a study's store; an
export goes to a reader who takes his time without being gathered first.
usage: scale_test.py PATH_OF_EARTHTOP [--points N]     default: 60000; the smaller study has a tenth of them"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

# What all points take in memory is far more: 60,000 lines of study.csv have 9 MB.
MOST_GROWTH_KIB = 4096
BASE = {"site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
        "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                 "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
        "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 0.1, "output_step_s": 0.1}}


def study(points):
    """A study of so many points."""
    return {"base": BASE, "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80, "points": points // 50}},
                                   {"pointer": "/release/spin_rad_s", "range": {"from": 100, "to": 300, "points": 50}}]}


def cost(command, reader=None):
    """Largest memory (KiB) and processor time (s) of a command; `reader` takes what it prints."""
    out = subprocess.PIPE if reader else subprocess.DEVNULL
    with subprocess.Popen(command, stdout=out, stdin=subprocess.DEVNULL) as process:
        if reader:
            reader(process.stdout)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"FAULT: {' '.join(command)}: exit status {process.returncode}")
    return usage.ru_maxrss, usage.ru_utime + usage.ru_stime


def read_slowly(stream):
    """Reads a little and lets the writer wait before it reads the rest."""
    stream.read(1000)
    time.sleep(1)
    while stream.read(1 << 16):
        pass


def costs(tool, points):
    """What each job costs in a study of so many points."""
    pathlib.Path("scale.json").write_text(json.dumps(study(points)), encoding="utf-8")
    compute = [tool, "study", "scale.json", "--jobs", "1", "--quiet", "--out"]
    table = {"study": cost([*compute, f"whole{points}"]), "resume": cost([*compute, f"whole{points}"])}
    for k in (1, 2):
        cost([*compute, f"parts{points}", "--shard", f"{k}/2"])
    parts = [f"parts{points}/shard-{k}-of-2.sqlite" for k in (1, 2)]
    table["merge"] = cost([tool, "study", "merge", *parts, "--out", f"merged{points}", "--quiet"])
    table["show"] = cost([tool, "study", "show", f"whole{points}"])
    table["export"] = cost([tool, "study", "export", f"whole{points}"], read_slowly)
    table["report"] = cost([tool, "report", f"whole{points}", "--quiet"])
    return table


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("tool")
    arguments.add_argument("--points", type=int, default=60000)
    given = arguments.parse_args()
    tool = os.path.realpath(given.tool)
    faults = 0
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        few, many = costs(tool, given.points // 10), costs(tool, given.points)
        for job, (memory, seconds) in many.items():
            memory_of_few, seconds_of_few = few[job]
            print(f"{job:7} {memory_of_few / 1024:6.1f} MiB {seconds_of_few:6.2f} s    {memory / 1024:6.1f} MiB {seconds:6.2f} s")
            if memory - memory_of_few > MOST_GROWTH_KIB:
                faults += 1
                print(f"FAULT: {job}: ten times as many points take more memory")
            if seconds > 20 * seconds_of_few + 0.5:  # twice its share; the start takes some hundredths of a second
                faults += 1
                print(f"FAULT: {job}: ten times as many points take more than ten times as long")
        for file in ("study.csv", "study.json"):
            if pathlib.Path(f"whole{given.points}", file).read_bytes() != pathlib.Path(f"merged{given.points}", file).read_bytes():
                faults += 1
                print(f"FAULT: merged shards differ in {file}")
    return faults > 0


sys.exit(main())
