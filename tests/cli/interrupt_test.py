#!/usr/bin/env python3
"""SIGINT, SIGTERM and SIGHUP end every verb, wherever it is, within 0.2 s of processor time, with status 128 + signal, and leave
no half-written file.

usage: interrupt_test.py PATH_OF_EARTHTOP SCENARIOS [--all]
--all: many moments of every command, instead of one or two; prints a table.
"""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile

from signals import Interrupted

MOST_S = 0.2
TOOL, SCENARIOS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ALL = "--all" in sys.argv
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
faults = []


def fault(text):
    faults.append(text)
    print("FAULT:", text, flush=True)


def scene(name, **sets):
    """The name of a copy of a shipped scenario with some values changed, written into the working directory."""
    with open(os.path.join(SCENARIOS, name + ".json"), encoding="utf-8") as file:
        document = json.load(file)
    document.pop("headline", None)
    document.pop("criteria", None)
    for path, value in sets.items():
        at = document
        *above, last = path.split("__")
        for key in above:
            at = at.setdefault(key, {})
        at[last] = value
    document["name"] = f"scene-{len(os.listdir('.'))}"
    file = document["name"] + ".json"
    with open(file, "w", encoding="utf-8") as out:
        json.dump(document, out)
    return file


def gimbal():
    """A damped gyrocompass, whose growth of disturbances takes most of a run."""
    document = {
        "name": "compass", "site": {"latitude_deg": 52},
        "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0],
                 "inertia": {"about": "pivot", "principal_kg_m2": [9.1e-5, 9.1e-5, 1.42e-4]}},
        "release": {"tilt_deg": 90, "azimuth_deg": 20, "spin_rad_s": 2513.27},
        "motion": {"duration_s": 60, "output_step_s": 0.05},
        "effects": {"gimbal": {"axis": "vertical", "damping_N_m_s": 1e-5}}}
    return document


def main_cases():
    """(name, arguments, processor times at which the signal comes; None: up to the whole command)."""
    long_top = scene("toy-top", motion__duration_s=20000, motion__output_step_s=1000)
    friction = scene("asymmetric-top", motion__duration_s=3600, motion__output_step_s=1,
                     effects__coulomb_torque_N_m=1e-9)
    rows = scene("fast-gyro", motion__duration_s=1000, motion__output_step_s=0.002)
    ledger = scene("toy-top", motion__output_step_s=0.0005, numerics__ledger="laboratory")
    chaotic = scene("asymmetric-top", motion__duration_s=600)
    wide = scene("asymmetric-top", motion__duration_s=60, numerics__precision="float128", motion__output_step_s=0.01)
    wide_form = scene("free-gyro", numerics__precision="float128", motion__output_step_s=0.001)
    viscous = scene("asymmetric-top", motion__duration_s=3600, motion__output_step_s=1, effects__viscous_torque_N_m_s=1e-9)
    sensitive = scene("toy-top", motion__duration_s=600, report__sensitivities=True)
    with open("study.json", "w", encoding="utf-8") as file:
        json.dump({"name": "many", "base": long_top, "axes": [{"name": "tilt", "pointer": "/release/tilt_deg",
                                                             "from": 5, "to": 40, "points": 400}}],
                   "collect": ["drift.axis_final_rad"]}, file)
    with open("wide-study.json", "w", encoding="utf-8") as file:
        json.dump({"name": "wide", "base": wide, "axes": [{"name": "tilt", "pointer": "/release/tilt_deg",
                                                          "from": 5, "to": 40, "points": 40}}],
                   "collect": ["drift.axis_final_rad"]}, file)
    cases = [
        ("run: series, bound", ["run", long_top], (0.3, 2.0)),
        ("run: dry friction", ["run", friction], (0.3,)),
        ("run: rows of a closed form", ["run", rows], (0.5, 3.0)),
        ("run: ledger, writing", ["run", ledger], (0.5,)),
        ("run: growth of disturbances", ["run", chaotic], (1.0,)),
        ("run: 113 bits", ["run", wide], (0.5,)),
        ("run: a closed form in 113 bits", ["run", wide_form], (0.5,)),
        ("run: sensitivities", ["run", sensitive], (1.0,)),
        ("explain: dry friction", ["explain", friction], (0.3,)),
        ("explain: viscous", ["explain", viscous], (0.5,)),
        ("bench", ["bench", long_top], (0.5,)),
        ("verify", ["verify"], (0.3,)),
        ("study: 4 threads", ["study", "study.json", "--jobs", "4", "--out", "studied"], (0.8,)),
        ("study: 113 bits", ["study", "wide-study.json", "--jobs", "2", "--out", "wide-studied"], (0.8,)),
    ]
    return cases


def check(name, arguments, number, at_s, second=False):
    done = Interrupted([TOOL, *arguments], number, at_s, ".", second)
    label = f"{name}, {signal.Signals(number).name} at {done.at_s or 0:.2f} s"
    if done.after_s is None:
        return label, None
    if done.status != 128 + number:
        fault(f"{label}: status {done.status}; {done.err.strip()}")
    if not done.after_s <= MOST_S:
        fault(f"{label}: {done.after_s:.3f} s of processor time after it")
    if "interrupted" not in done.err + done.out:
        fault(f"{label}: it does not say so: {done.err.strip()}")
    left = [os.path.join(place, file) for place, _, files in os.walk(".") for file in files if file.endswith(".tmp")]
    if left:
        fault(f"{label}: left behind: {left}")
    if arguments[0] == "run" and os.path.exists("out"):
        fault(f"{label}: something was written")
        shutil.rmtree("out")
    return label, done.after_s


def whole_time(arguments):
    """Processor time of the whole command, at most a minute."""
    done = Interrupted([TOOL, *arguments], signal.SIGKILL, 60, ".")
    shutil.rmtree("out", ignore_errors=True)
    return done.at_s or 60


def main():
    random.seed(19)
    worst = 0
    for name, arguments, moments in main_cases():
        if ALL:
            moments = [0.01, 0.05, *sorted(random.uniform(0, 12) for _ in range(8))]
        for k, at_s in enumerate(moments):
            for number in SIGNALS if ALL else (SIGNALS[(k + len(name)) % 3],):
                label, after_s = check(name, arguments, number, at_s)
                worst = max(worst, after_s or 0)
                print(f"{label}: {'ended before' if after_s is None else f'{1000 * after_s:.0f} ms'}", flush=True)
    label, after_s = check("twice: run", main_cases()[0][1], signal.SIGTERM, 0.3, second=True)
    print(f"{label}: {after_s}; the longest of all {1000 * worst:.0f} ms")
    return 1 if faults else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        sys.exit(main())
