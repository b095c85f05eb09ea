#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nasty legal scenes: does each end within ten times its estimate, and do two methods agree within their bounds?

An estimate is what `earthtop check` prints, in processor time; less than 0.1 s counts as 0.1 s. A run that ends with
"step_limit" has noticed by itself. Two methods agree if their drifts of the axis at the end differ by no more than the sum of
their bounds, or if one of them says that its drift cannot be trusted."""
import collections
import json
import os
import re
import resource
import subprocess

from attack import Attack

TIMES = 10  # how far a run may go beyond its estimate
LEAST = 0.1  # the least estimate that is told from others (s)
KILLED = 60  # no run may take longer (s of processor time)
AFFORDABLE = 4  # a scene with a longer estimate is not run (s)
UNITS = {"s": 1, "minutes": 60, "hours": 3600, "days": 86400}
SPINS = [0, 1e-6, 1, 30, 200, 1000, 1e4, 1e6]
PRECESSIONS = [1e-6, 1e-3, 1, 50, 1e3, 1e5, 1e6]
TILTS = [0, 1e-6, 20, 60, 90, 150, 180]
LOOSE = {"taylor": "rkf78", "long_horizon": "taylor", "closed_form": "taylor", "dop853": "rkf78", "rkf78": "extrapolation",
         "extrapolation": "rkf78"}


def scene(random, **given):
    """A top with a fixed pivot; what is given replaces what is drawn."""
    log = lambda a, b: 10 ** random.uniform(a, b)
    duration = given.get("duration", log(-3, 1.5))
    release = {"tilt_deg": given.get("tilt", random.choice(TILTS)), "azimuth_deg": random.uniform(-180, 180),
               "spin_rad_s": given.get("spin", random.choice(SPINS)) * random.choice([1, -1])}
    if given.get("precession"):
        release["precession"] = {"rate_rad_s": given["precession"]}
    return {"site": {"latitude_deg": random.choice([0, 45, -60, 90])},
            "earth": {"rotation_rate_rad_s": given.get("rotation", 7.292115e-5)},
            "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, random.choice([0, 0.001, 0.03])],
                     "inertia": {"about": "center_of_mass" if "moments" in given else "pivot",
                                 "principal_kg_m2": given.get("moments", [1.2e-4, 1.2e-4, 4e-5])}},
            "release": release, "motion": {"duration_s": duration, "output_step_s": duration / random.choice([1, 20, 200])}}


def spinning(random):
    return scene(random, rotation=random.choice([0, 1e-9, 7.292115e-5, -7.292115e-5, 1e-3, 1]))


def precessing(random):
    precession = random.choice(PRECESSIONS)
    return scene(random, precession=precession, spin=random.choice([1, 200, 1e4]),
                 duration=random.choice([3e3, 1e4, 3e5, 4e6]) / (precession + 2e3))


def asymmetric(random):
    return scene(random, moments=random.choice([[1e-4, 1.1e-4, 4e-5], [1e-4, 1e-6, 1.005e-4], [1e-4, 1.2e-4, 1.10001e-4]]),
                 spin=random.choice([0, 1, 200, 5e3]))


def exact(random):
    one = scene(random, spin=random.choice([1, 200, 1e3]))
    precision = random.choice(["double", "long_double", "float128"])
    least = {"double": 1e-14, "long_double": 1e-17, "float128": 1e-20}[precision]
    one["numerics"] = {"precision": precision, "relative_tolerance": random.choice([1e-4, 1e-9, least])}
    one["motion"] = {"duration_s": random.choice([0.01, 0.1, 1])}
    one["motion"]["output_step_s"] = one["motion"]["duration_s"] / random.choice([1, 10])
    return one


def sensitive(random):
    one = scene(random, spin=random.choice([1, 200, 1e4]), tilt=random.choice([0, 1e-6, 20, 90, 180]))
    one["report"] = {"sensitivities": True}
    return one


def accurate(random):
    one = scene(random)
    one["accuracy"] = {"drift_rad": 10 ** random.uniform(-13, -3)}
    return one


def driven(random):
    one = scene(random, spin=random.choice([0, 1, 200, 1e4]), tilt=random.choice([1e-6, 20, 90, 180]))
    one["platform"] = {"motion": "harmonic", "axis": random.choice([[0, 0, 1], [1, 0, 0]]),
                       "amplitude_rad": random.choice([1e-6, 0.1, 3]), "frequency_hz": random.choice([0.01, 1, 100])}
    one["platform"]["pivot_offset_m"] = random.choice([[0, 0, 0], [0.1, 0, 0]])
    return one


def braked(random):
    one = scene(random, spin=random.choice([0, 1, 200, 1e4]))
    one["effects"] = random.choice([{"coulomb_torque_N_m": 10 ** random.uniform(-9, -3)},
                                    {"viscous_torque_N_m_s": 10 ** random.uniform(-9, -3)},
                                    {"quadratic_torque_N_m_s2": 10 ** random.uniform(-12, -6)}])
    return one


def level(random):
    one = scene(random, spin=random.choice([1, 200, 1e4]), tilt=90)
    one["effects"] = {"gimbal": {"damping_N_m_s": random.choice([0, 1e-7, 1e-4])}}
    return one


def on_table(random):
    one = scene(random, spin=random.choice([0, 1, 200, 1e3]), tilt=random.choice([0, 1e-6, 5, 20, 60]))
    one["body"]["center_of_mass_m"] = [0, 0, 0.03]
    one["contact"] = {"tip_radius_m": random.choice([1e-4, 0.005]), **random.choice(
        [{"law": "frictionless"}, {"law": "rolling"}, {"law": "viscous", "sliding_viscosity_N_s_m": 10 ** random.uniform(-3, 1)},
         {"law": "coulomb", "friction_coefficient": random.choice([0.01, 0.3])}])}
    return one


KINDS = {"spins": spinning, "precession given": precessing, "asymmetric": asymmetric, "precision": exact,
         "sensitivities": sensitive, "accuracy": accurate, "platform": driven, "friction": braked, "gimbal": level,
         "table": on_table}


def estimate(attack, file, extra=()):
    """Returns the seconds that `check` says a run takes, or None where the scene is refused."""
    end = attack.run("check", file, *extra)
    if end.status != 0:
        return None
    said = re.search(r"less than 0\.1 s|about ([\d.e+-]+) (s|minutes|hours|days)\b", " ".join(end.out.split()))
    return float(said[1]) * UNITS[said[2]] if said and said[1] else 0


def measured(attack, file, folder, extra=()):
    """Runs a scene. Returns its status, its processor time (s) and its summary; the status is None where it was killed."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (KILLED, KILLED))
    with open(os.path.join(folder, "out"), "w+", encoding="utf-8") as out, open(os.devnull, "w", encoding="utf-8") as none:
        child = subprocess.Popen([attack.program, "run", file, "--json", "--force", "--out", os.path.join(folder, "results"),
                                  *extra], stdout=out, stderr=none, preexec_fn=limit)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    status = None if child.returncode < 0 else child.returncode
    return status, used.ru_utime + used.ru_stime, json.loads(text) if status in (0, 3) and text else {}


def slow(said, status, seconds, summary):
    """Returns what is wrong with the time of a run."""
    if status is None:
        return [f"killed after {seconds:.0f} s, estimate {said:g} s"]
    if seconds > TIMES * max(said, LEAST) and summary.get("outcome", {}).get("status") != "step_limit":
        return [f"{seconds:.2g} s, estimate {said:g} s"]
    return []


def drift(summary):
    """Returns the drift at the end and its bound, or None where it is not to be trusted."""
    found = summary.get("drift", {})
    if summary.get("outcome", {}).get("status") != "completed" or found.get("verdict") not in ("reliable", "noise_floor"):
        return None
    if found.get("axis_final_rad") is None or found.get("axis_bound_rad") is None:
        return None
    return found["axis_final_rad"], found["axis_bound_rad"]


def attempt(attack, case, folder):
    """Checks, runs, and runs again by another method."""
    file = os.path.join(folder, "scene.json")
    with open(file, "w", encoding="utf-8") as out:
        json.dump({"name": "nasty", **case[2]}, out)
    said = estimate(attack, file)
    if said is None:
        attack.refused[case[0]] += 1
        return ["check refuses more than a tenth of the kind"] if attack.refused[case[0]] > attack.options.count / 100 else []
    if said > AFFORDABLE:
        attack.left_out[case[0]] += 1
        return []
    status, seconds, summary = measured(attack, file, folder)
    faults = slow(said, status, seconds, summary)
    if attack.options.keep and faults:
        os.makedirs(attack.options.keep, exist_ok=True)
        with open(os.path.join(attack.options.keep, case[1].replace(" ", "-") + ".json"), "w", encoding="utf-8") as kept:
            json.dump({"name": "nasty", **case[2]}, kept)
    first = drift(summary)
    other = LOOSE.get(summary.get("solution", {}).get("method"))
    if first is None or other is None or "contact" in case[2] and other != "rkf78":
        return faults
    extra = ["--set", f"/numerics/method={other}"]
    said = estimate(attack, file, extra)
    if said is None or said > AFFORDABLE:
        return faults
    status, seconds, summary = measured(attack, file, folder, extra)
    faults += [f"{other}: {fault}" for fault in slow(said, status, seconds, summary)]
    second = drift(summary)
    if second and abs(first[0] - second[0]) > first[1] + second[1]:
        faults.append(f"{first[0]!r} +- {first[1]:.2g} rad, but by {other} {second[0]!r} +- {second[1]:.2g} rad")
    return faults


def describe(parser):
    parser.add_argument("--count", type=int, default=400, help="how many scenes")
    parser.add_argument("--keep", help="folder for the scenes that fall through")


def main():
    attack = Attack(__doc__, describe)
    attack.left_out, attack.refused = collections.Counter(), collections.Counter()
    names = list(KINDS)
    cases = [(names[i % len(names)], f"{names[i % len(names)]} {i}", KINDS[names[i % len(names)]](attack.random))
             for i in range(attack.options.count)]
    attack.all(cases, lambda case, folder: attempt(attack, case, folder))
    for kinds, why in ((attack.left_out, f"as check says that they take more than {AFFORDABLE} s"),
                       (attack.refused, "as check refuses them")):
        if kinds:
            print(f"not run, {why}: " + ", ".join(f"{count} of {kind}" for kind, count in kinds.items()))
    attack.end()


if __name__ == "__main__":
    main()
