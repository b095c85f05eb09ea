#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the progress that run, explain, study, compare and verify show on a terminal: the share never falls and ends at 100 %;
when half of the processor time is used, it is between a quarter and three quarters. With pipes, --quiet, --json or NO_COLOR
nothing is shown.

The test slows a command down by stopping it after every SLICE_S of processor time for longer than the line's refresh takes. So
a second of work is enough to see how the share grows, on any machine.

usage: progress_test.py PATH_OF_EARTHTOP SCENARIOS [--all]
"""
import json
import os
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

from signals import processor_time

TOOL, SCENARIOS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ALL = "--all" in sys.argv
SLICE_S = 0.08  # of processor time, and at least a tenth of what was used up so far
FIRST_S, NEXT_S = 1.05, 0.27  # by the clock: the line is shown from the first second on, every quarter of one
TOO_SHORT_S = 5 * SLICE_S  # of processor time: a command that ends before has too few slices to say anything about its share
SHARE = re.compile(r"\r *(\d+)%  ([^\r]*)")
faults = []


def fault(text):
    faults.append(text)
    print("FAULT:", text, flush=True)


def watched(arguments, environment=None):
    """Runs a command, in slices, whose standard error is a terminal.

    @returns its status, [(processor time, share, rest of line)], text, its processor time, the number of times it was stopped
    """
    master, slave = pty.openpty()
    seen, text = [], ""
    stops, stop_at_s = 0, SLICE_S
    with subprocess.Popen([TOOL, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=slave,
                          env={**os.environ, "TERM": "xterm", **(environment or {})}) as process:
        os.close(slave)
        while True:
            used = processor_time(process.pid) or 0
            if used >= stop_at_s:
                os.kill(process.pid, signal.SIGSTOP)
                time.sleep(NEXT_S if stops else FIRST_S)
                os.kill(process.pid, signal.SIGCONT)
                stops += 1
                stop_at_s = used + max(SLICE_S, used / 10)
            if select.select([master], [], [], min(0.05, max(0.002, (stop_at_s - used) / 2)))[0]:
                try:
                    piece = os.read(master, 65536).decode("utf-8", "replace")
                except OSError:
                    break
                if not piece:
                    break
                text += piece
                used = processor_time(process.pid)
                for share, rest in SHARE.findall(piece):
                    seen.append((used, int(share), rest))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    os.close(master)
    whole = usage.ru_utime + usage.ru_stime
    return process.returncode, [(whole if t is None else t, share, rest) for t, share, rest in seen], text, whole, stops


def check(name, arguments):
    if arguments[0] == "run":
        arguments = [*arguments, "--jobs", "1"]  # the share is one of the time that passes, which only then is the processor's
    status, seen, text, whole, stops = watched(arguments)
    if status not in (0, 1):
        return fault(f"{name}: status {status}: {text}")
    if whole < TOO_SHORT_S:
        if arguments[0] == "run" and arguments[2:4] == ["--out", "some"]:
            return print(f"{name}: over after {whole:.2f} s, not looked at", flush=True)
        return fault(f"{name}: over after {whole:.2f} s: a longer one must take its place")
    if len(seen) < max(3, stops * 2 // 3):
        return fault(f"{name}: only {len(seen)} looks in {whole:.2f} s of processor time and {stops} stops: {text!r}")
    shares = [share for _, share, _ in seen]
    if shares != sorted(shares):
        fault(f"{name}: the share falls: {shares}")
    if shares[-1] != 100:
        fault(f"{name}: it ends at {shares[-1]} %")
    if not any("left" in rest for _, _, rest in seen):
        fault(f"{name}: nothing says how long it will take")
    half = min(seen, key=lambda look: abs(look[0] - whole / 2))
    phases = sorted({rest.split(",")[0] for _, _, rest in seen if rest.strip()})
    print(f"{name}: {whole:.1f} s, {len(seen)} looks, {half[1]} % at {half[0] / whole:.0%} of it; {phases}", flush=True)
    if abs(half[0] - whole / 2) < whole / 8 and not 25 <= half[1] <= 75:
        fault(f"{name}: {half[1]} % where {half[0] / whole:.0%} of the processor time is used")
    return None


def scene(name, file, **sets):
    with open(os.path.join(SCENARIOS, name + ".json"), encoding="utf-8") as source:
        document = json.load(source)
    document.pop("headline", None)
    document.pop("criteria", None)
    for path, value in sets.items():
        at = document
        *above, last = path.split("__")
        for key in above:
            at = at.setdefault(key, {})
        at[last] = value
    document["name"] = file
    with open(file + ".json", "w", encoding="utf-8") as out:
        json.dump(document, out)
    return file + ".json"


def main():
    top = scene("toy-top", "top", motion__duration_s=3000, motion__output_step_s=1)
    body = scene("asymmetric-top", "body", motion__duration_s=900)
    rows = scene("toy-top", "rows", motion__output_step_s=0.0004)
    friction = scene("asymmetric-top", "friction", motion__duration_s=40, motion__output_step_s=1,
                     effects__coulomb_torque_N_m=1e-9)
    point = scene("asymmetric-top", "point", motion__duration_s=400)
    points = {"name": "points", "base": point, "collect": ["drift.axis_final_rad"],
              "axes": [{"name": "tilt", "pointer": "/release/tilt_deg", "range": {"from": 5, "to": 40, "points": 8}}]}
    with open("points.json", "w", encoding="utf-8") as file:
        json.dump(points, file)
    check("run, rows to be written", ["run", rows, "--out", "rows"])
    check("run, growth of disturbances", ["run", body, "--out", "body"])
    check("compare", ["compare", "rows", "rows"])
    check("explain", ["explain", friction])
    check("study", ["study", "points.json", "--out", "points", "--jobs", "2"])
    if ALL:
        wide = scene("asymmetric-top", "wide", motion__duration_s=4, numerics__precision="float128", motion__output_step_s=0.1)
        ledger = scene("toy-top", "ledger", motion__output_step_s=0.001, numerics__ledger="laboratory")
        check("run, series", ["run", top, "--out", "top"])
        check("run, 113 bits", ["run", wide, "--out", "wide"])
        check("run, ledger", ["run", ledger, "--out", "ledger"])
        check("run, dry friction", ["run", friction, "--out", "friction"])
        check("verify", ["verify"])
        for name in sorted(os.listdir(SCENARIOS)):
            if name.endswith(".json"):
                check(name, ["run", scene(name[:-5], "some-" + name[:-5], motion__output_step_s=0.001), "--out", "some", "--force"])
    silent = [("--quiet", ["--quiet"], {}), ("NO_COLOR", [], {"NO_COLOR": "1"}), ("--json", ["--json"], {}),
              ("TERM=dumb", [], {"TERM": "dumb"})]
    for name, extra, environment in silent if ALL else silent[:2]:
        text = watched(["compare", "rows", "rows", *extra], environment)[2]
        if "%" in text:
            fault(f"{name}: still {text!r}")
    return 1 if faults else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        sys.exit(main())
