# SPDX-License-Identifier: GPL-3.0-or-later
"""What `study --dry-run` says of the processor time of unlike studies, held against what they take.
usage: estimate_test.py PATH_OF_EARTHTOP SCENARIOS [--all] [--jobs N]     --all: twelve studies and more instead of a few
Prints a line a study: its points, the estimate, the time taken, their ratio, which is to be within a factor of two."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

FACTOR = 2
TOP = {"site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
       "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
       "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 60}}
TREND = ["drift.axis_final_rad", "drift.secular.azimuth_rate_rad_s"]
INPUTS = ["sensitivities.inputs.0.d_axis_rad", "sensitivities.inputs.2.d_axis_rad", "drift.axis_final_rad"]


def grid(points, base=None, changes=None, second="/release/spin_rad_s", ends=(150, 250), rows=4, **more):
    """A study over latitudes and another key."""
    return {"base": base or TOP, "set": changes or {},
            "axes": [{"name": "latitude", "pointer": "/site/latitude_deg", "range": {"from": 10, "to": 60, "points": points // rows}},
                     {"name": "second", "pointer": second, "range": {"from": ends[0], "to": ends[1], "points": rows}}], **more}


# name: a study, and whether it is among the few.
STUDIES = {
    "plain": (grid(400, rows=20), True),
    "trend": (grid(400, rows=20, collect=TREND), True),
    "dry friction": (grid(40, changes={"/effects": {"coulomb_torque_N_m": 1e-6}}), True),
    "viscous": (grid(120, changes={"/effects": {"viscous_torque_N_m_s": 1e-8}}), False),
    "float128": (grid(4, changes={"/numerics": {"precision": "float128"}, "/motion/duration_s": 2}, rows=2), True),
    "gyrocompass": (grid(60, base="gyrocompass-in-gimbals.json", second="/rotor/spin_rad_s", ends=(900, 1100)), False),
    "asymmetric": (grid(200, base="asymmetric-top.json", ends=(50, 70)), False),
    "long_horizon": (grid(16, changes={"/motion/duration_s": 3600, "/numerics": {"method": "long_horizon"}}), False),
    "closed form": (grid(400, changes={"/numerics": {"method": "closed_form"}, "/site/gravity_m_s2": 0, "/body/center_of_mass_m": [0, 0, 0]}, rows=20), False),
    "cheap": (grid(40000, changes={"/motion/duration_s": 0.01}, rows=200, collect=["drift.axis_final_rad"]), False),
    "table": (grid(40, base="toy-top-on-table.json", changes={"/motion/duration_s": 5}), True),
    "sensitivities": (grid(60, changes={"/report": {"sensitivities": True}}, collect=INPUTS), True),
    "ledger": (dict(grid(100, changes={"/numerics": {"ledger": "laboratory"}}), rows="all"), False),
    "sobol": ({"base": TOP, "axes": [
        {"pointer": "/site/latitude_deg", "range": {"from": -80, "to": 80}},
        {"pointer": "/release/spin_rad_s", "range": {"from": 150, "to": 300}},
        {"pointer": "/motion/duration_s", "range": {"from": 1, "to": 60}}],
        "design": {"kind": "sobol", "points": 128, "indices": True}}, True),
    "many short": (grid(8000, changes={"/motion/duration_s": 0.1}, rows=50), False),
    "unlike": (grid(40, second="/motion/duration_s", ends=(1, 3600), rows=10), False),
    "few are long": ({"base": TOP, "axes": [{"pointer": "/motion/duration_s", "log_range": {"from": 1, "to": 20000}},
                                             {"pointer": "/site/latitude_deg", "range": {"from": 10, "to": 60}}],
                      "design": {"kind": "random", "points": 60}}, False),
}


def processor_time(command):
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        sys.exit(f"FAULT: {' '.join(command)}: exit status {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("tool")
    arguments.add_argument("scenarios")
    arguments.add_argument("--all", action="store_true")
    arguments.add_argument("--jobs", default="1")
    arguments.add_argument("--only")
    given = arguments.parse_args()
    tool, scenarios = os.path.realpath(given.tool), os.path.realpath(given.scenarios)
    faults = 0
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        for number, (name, (study, is_one_of_few)) in enumerate(STUDIES.items()):
            if not (given.all or is_one_of_few) or given.only not in (None, name):
                continue
            if isinstance(study["base"], str):
                study["base"] = os.path.join(scenarios, study["base"])
            file = f"s{number}.json"
            pathlib.Path(file).write_text(json.dumps(study), encoding="utf-8")
            # Once more where something came in between: a machine may be busy for a moment.
            for attempt in range(2):
                told = json.loads(subprocess.run([tool, "study", file, "--dry-run", "--json", "--jobs", given.jobs], check=True,
                                                 capture_output=True, text=True).stdout)
                taken = processor_time([tool, "study", file, "--quiet", "--jobs", given.jobs, "--out", f"out{number}-{attempt}"])
                ratio = told["core_seconds"] / taken
                if 1 / FACTOR <= ratio <= FACTOR:
                    break
            print(f"{name:14} {told['points']:6} points  told {told['core_seconds']:7.2f} s, taken {taken:7.2f} s: {ratio:5.2f}  "
                  f"({told['points_timed']:.1f} points timed in {told['seconds_timed']:.2f} s)", flush=True)
            if not 1 / FACTOR <= ratio <= FACTOR:
                faults += 1
                print(f"FAULT: {name}: the estimate is not within a factor of {FACTOR}")
    return faults > 0


sys.exit(main())
