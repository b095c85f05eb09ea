#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that SIGINT, SIGTERM and SIGHUP end every verb at any moment, within 0.2 s of processor time, with status 128 + signal,
and leave no half-written file.

usage: interrupt_test.py PATH_OF_EARTHTOP SCENARIOS PATH_OF_DEAF_PROGRAM [--verbs | --all]
--verbs: one command of every verb, at one moment, instead of all commands at one or two moments.
--all: many moments of every command; prints a table.
"""
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile

from signals import Interrupted

MOST_S = 0.2
TOOL, SCENARIOS, DEAF = (os.path.abspath(path) for path in sys.argv[1:4])
ALL = "--all" in sys.argv
VERBS = "--verbs" in sys.argv
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
    document.pop("purpose", None)
    file = document["name"] + ".json"
    with open(file, "w", encoding="utf-8") as out:
        json.dump(document, out)
    return file


def study(name, base, points):
    document = {"name": name, "base": base, "collect": ["drift.axis_final_rad"],
                "axes": [{"name": "tilt", "pointer": "/release/tilt_deg", "range": {"from": 5, "to": 40, "points": points}}]}
    with open(name + ".json", "w", encoding="utf-8") as file:
        json.dump(document, file)
    return name + ".json"


def prepared(*arguments):
    """Makes files that other verbs read."""
    subprocess.run([TOOL, *arguments, "--quiet"], check=True, stdout=subprocess.DEVNULL)


def measurement(name):
    """Writes azimuths of a trajectory as a measurement."""
    with open(name, encoding="utf-8") as source, open("measured.csv", "w", encoding="utf-8") as out:
        columns = source.readline().strip().split(",")
        t, x, y = columns.index("t_s"), columns.index("axis_L_x"), columns.index("axis_L_y")
        out.write("t_s,azimuth_rad,azimuth_se_rad\n")
        for number, line in enumerate(source):
            cells = line.split(",")
            if number % 100 == 7:
                out.write(f"{cells[t]},{math.atan2(float(cells[x]), float(cells[y])) + 1e-3 * math.sin(number)},1e-3\n")
    return "measured.csv"


def main_cases():
    """(name, arguments, processor times at which the signal comes)."""
    long_top = scene("toy-top", motion__duration_s=20000, motion__output_step_s=1000)
    body = scene("asymmetric-top", motion__duration_s=3000, motion__output_step_s=100)
    friction = scene("asymmetric-top", motion__duration_s=3600, motion__output_step_s=1, effects__coulomb_torque_N_m=1e-9)
    viscous = scene("asymmetric-top", motion__duration_s=3600, motion__output_step_s=1, effects__viscous_torque_N_m_s=1e-9)
    form = scene("fast-gyro", motion__duration_s=1000, motion__output_step_s=0.002)
    ledger = scene("toy-top", motion__output_step_s=0.0002, numerics__ledger="laboratory")
    wide = scene("asymmetric-top", motion__duration_s=60, numerics__precision="float128", motion__output_step_s=0.01)
    wide_form = scene("free-gyro", numerics__precision="float128", motion__output_step_s=0.0001)
    sensitive = scene("toy-top", motion__duration_s=600, report__sensitivities=True)
    compass = scene("hard/t08-gyrocompass", motion__duration_s=600, motion__output_step_s=1)
    walk = scene("toy-top", motion__duration_s=4e6, motion__output_step_s=4e6, numerics__method="long_horizon")
    chosen = scene("asymmetric-top", motion__duration_s=3000, motion__output_step_s=100, effects="auto",
                   accuracy__drift_rad=1e-7)
    steps = scene("asymmetric-top", motion__duration_s=3000, motion__output_step_s=3000, numerics__method="gauss",
                  numerics__step_s=0.002)
    rows = scene("toy-top", motion__output_step_s=0.0004)
    prepared("run", rows, "--out", "rows", "--force")
    with open("large.json", "w", encoding="utf-8") as file:
        file.write('{"_": [' + ",\n".join(["1." + 36 * "25"] * 190_000) + "]}\n")
    few = scene("toy-top", motion__duration_s=1, motion__output_step_s=1)
    prepared("study", study("stored", few, 4_000), "--out", "stored")
    return [
        ("run: series, bound", ["run", long_top], (0.2, 1.2)),
        ("run: a body, growth", ["run", body], (0.2, 1.5)),
        ("run: dry friction", ["run", friction], (0.3,)),
        ("run: rows of a closed form", ["run", form], (0.5,)),
        ("run: ledger, writing", ["run", ledger], (0.3, 1.2)),
        ("run: 113 bits", ["run", wide], (0.5,)),
        ("run: a closed form in 113 bits", ["run", wide_form], (0.5,)),
        ("run: sensitivities", ["run", sensitive], (0.4,)),
        ("run: gimbal", ["run", compass], (0.5,)),
        ("run: one row, a long walk", ["run", walk], (0.3,)),
        ("run: one row, implicit steps", ["run", steps], (0.3,)),
        ("run: choice of effects", ["run", chosen], (0.3,)),
        ("explain: dry friction", ["explain", friction], (0.3,)),
        ("explain: viscous", ["explain", viscous], (0.5,)),
        ("explain: gimbal", ["explain", compass], (0.3,)),
        ("bench", ["bench", long_top], (0.5,)),
        ("verify", ["verify"], (0.3,)),
        ("study: 4 threads", ["study", study("many", long_top, 400), "--jobs", "4", "--out", "studied"], (0.4,)),
        ("study: 113 bits", ["study", study("wide", wide, 40), "--jobs", "2", "--out", "wide-studied"], (0.4,)),
        ("study: cheap points", ["study", study("cheap", few, 100_000), "--out", "cheap-studied"], (0.5,)),
        ("study show", ["study", "show", "stored"], (0.02,)),
        ("study export", ["study", "export", "stored"], (0.02,)),
        ("study merge", ["study", "merge", "stored", "--out", "merged"], (0.05,)),
        ("compare", ["compare", "rows", "rows"], (0.2,)),
        ("compare: a measurement", ["compare", rows, measurement("rows/trajectory.csv"), "--estimate",
                                    "/release/spin_rad_s"], (0.1,)),
        ("plan", ["plan", long_top, "--measure", "tilt_deg", "--sigma", "0.01", "--every", "1"], (0.3,)),
        ("plan: many rows", ["plan", rows, "--measure", "axis_deg", "--sigma", "0.01", "--every", "0.001", "--nuisance",
                             "spin_rad_s"], (0.5, 1.5)),
        ("plan: design", ["plan", rows, "--measure", "tilt_deg", "--sigma", "0.01", "--every", "0.1", "--optimise",
                          "/release/tilt_deg=5:60", "--optimise", "/release/spin_rad_s=100:400"], (0.5,)),
        ("report", ["report", "rows", "--out", "page.html"], (0.1,)),
        ("gallery", ["gallery", "pages"], (0.5,)),
        ("check: 16 MiB", ["check", "large.json"], (0.05,)),
    ]


def one_of_every_verb(cases):
    """The first case of every verb, at its first moment."""
    first = {}
    for name, arguments, moments in cases:
        first.setdefault(arguments[0], (name, arguments, moments[:1]))
    return list(first.values())


def interrupted(command, number, at_s, second):
    """Interrupts the command at `at_s`; if it ends before, at earlier moments, unless many moments are tried anyway."""
    done = Interrupted(command, number, at_s, ".", second)
    for share in () if ALL else (0.6, 0.8, 0.4, 0.2):
        if done.after_s is not None or done.status not in (0, 1):
            break
        shutil.rmtree("out", ignore_errors=True)
        at_s = share * done.at_s
        done = Interrupted(command, number, at_s, ".", second)
    return done, at_s


def check(name, arguments, number, at_s, second=False):
    done, at_s = interrupted([TOOL, *arguments], number, at_s, second)
    label = f"{name}, {signal.Signals(number).name} at {done.at_s or 0:.2f} s"
    if done.after_s is None:
        if done.status not in (0, 1):
            fault(f"{label}: no such command: {done.err.strip()}")
        elif not ALL:
            fault(f"{label}: it always ends before")
        shutil.rmtree("out", ignore_errors=True)
        return label, None
    if done.status not in ((128 + number, -number) if at_s < 0.03 else (128 + number,)):  # before main() by the system
        fault(f"{label}: status {done.status}; {done.err.strip()}")
    if not done.after_s <= MOST_S:
        fault(f"{label}: {done.after_s:.3f} s of processor time after it")
    said = "interrupted; nothing was written" if arguments[0] == "explain" else "interrupted"
    if done.status > 0 and said not in done.err + done.out:
        fault(f"{label}: it does not say so: {done.err.strip()}")
    left = [os.path.join(place, file) for place, _, files in os.walk(".") for file in files if file.endswith(".tmp")]
    if left:
        fault(f"{label}: left behind: {left}")
    if arguments[0] == "run" and os.path.exists("out"):
        fault(f"{label}: something was written")
        shutil.rmtree("out")
    return label, done.after_s


def what_is_said():
    """What a run says that is interrupted early, or while it checks or writes, and that this is so."""
    name = scene("asymmetric-top", motion__duration_s=60, motion__output_step_s=0.0006)
    command = [TOOL, "run", name, "--out", "said", "--jobs", "1", "--force"]
    files, whole_s = [], {}
    for option in ("--partial", "--quiet"):  # the rows are made in another order with --partial
        whole_s[option] = Interrupted([*command, option], signal.SIGTERM, 1e3, ".").at_s
        files = sorted(os.listdir("said"))
    with open("said/trajectory.csv", encoding="utf-8") as file:
        rows = sum(1 for _ in file)
    early = re.compile(r"interrupted at t = ([0-9.e+-]+) s of 60 s; nothing was written; the same command starts again\n")
    nothing = {"interrupted when the motion was complete, but not the bounds on its error or its verdict; nothing was written; the "
               "same command starts again; with --partial an interrupted run keeps the rows",
               "interrupted before the results were in place; nothing was written; the same command starts again"}
    kept = {"earthtop: error: interrupted; the rows are whole, but without error bounds and verdict, in said": "interrupted",
            "earthtop: error: interrupted; but the results are whole, in said": "completed"}
    missing = nothing | set(kept) | {"interrupted at"}
    for number in range(1, 64):
        share = int(f"{number:06b}"[::-1], 2) / 64  # ever finer, until each sentence was met
        for option, whole in whole_s.items():
            partial = option == "--partial"
            shutil.rmtree("said", ignore_errors=True)
            done = Interrupted([*command, option], signal.SIGTERM, share * whole, ".")
            if done.after_s is None:
                continue
            said = [one for one in nothing | set(kept) if one + "\n" in done.err]
            if at := early.search(done.err):
                said.append("interrupted at")
                if not 0 <= float(at[1]) <= 60:
                    fault(f"what is said: {done.err.strip()}")
            missing -= set(said)
            if len(said) != 1 or os.path.exists("said") != (said[0] in kept) or (said[0] in kept and not partial):
                fault(f"what is said at {share:.0%} {partial}: {done.err.strip()}")
            elif said[0] in kept:
                with open("said/summary.json", encoding="utf-8") as file:
                    status = json.load(file)["outcome"]["status"]
                with open("said/trajectory.csv", encoding="utf-8") as file:
                    complete = sum(1 for _ in file) == rows and sorted(os.listdir("said")) == files
                if status != kept[said[0]] or not complete:
                    fault(f"what is said at {share:.0%}: {said[0]}, and yet {status}, {'' if complete else 'not '}whole")
        if not missing:
            return
    fault(f"never said: {missing}")


def never_looks():
    """Checks that a program which ignores the request to stop is ended: by its use of processor time, or by using none."""
    for name, arguments, least_s in (("computes", [], 0.09), ("waits", ["waits"], 0)):
        done = Interrupted([DEAF, *arguments], signal.SIGTERM, 0.03, ".")
        print(f"deaf, {name}: {1000 * done.after_s:.0f} ms, {done.waited_s:.1f} s by the clock")
        if done.status != 128 + signal.SIGTERM or not least_s <= done.after_s <= MOST_S or "interrupted" not in done.err:
            fault(f"deaf, {name}: status {done.status} after {done.after_s:.3f} s of processor time; {done.err.strip()}")
        done = Interrupted([DEAF, *arguments], signal.SIGINT, 0.03, ".", second=True)
        if done.status != 128 + signal.SIGINT or done.after_s > 0.06:
            fault(f"deaf, {name}, twice: status {done.status} after {done.after_s:.3f} s of processor time")


def main():
    random.seed(19)
    worst = 0
    cases = one_of_every_verb(main_cases()) if VERBS else main_cases()
    for name, arguments, moments in cases:
        if ALL:
            moments = [0.01, 0.05, *sorted(10 ** random.uniform(-1.3, 1) for _ in range(8))]
        for at_s in moments:
            label, after_s = check(name, arguments, random.choice(SIGNALS), at_s)
            worst = max(worst, after_s or 0)
            print(f"{label}: {'ended before' if after_s is None else f'{1000 * after_s:.0f} ms'}", flush=True)
    label, after_s = check("twice: run", cases[0][1], signal.SIGTERM, 0.3, second=True)
    print(f"{label}: {1000 * (after_s or 0):.0f} ms; the longest of all {1000 * worst:.0f} ms")
    if not VERBS:
        what_is_said()
    never_looks()
    return 1 if faults else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        sys.exit(main())
