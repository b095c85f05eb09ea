#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts tops at the edges of what a scenario may say: alone, and in pairs with a third value that the seed chooses.

usage: edges_test.py PROGRAM [--seed N] [--python DIR] [--only KIND]

On a table every law of friction meets no friction, a point tip, no spin, a tiny patch, an axis that nearly lies, and next to no
gravity; on a pivot a top meets a tiny mass, no lever, no gravity, no spin, no Earth rate and a tiny duration. Each scene goes
through check, run, explain, report, comparisons of the result with itself and with that of another tolerance, the JSON of each, and, with --python, the package in
that directory. Nobody may read an infinity or NaN anywhere, and each end has a name: done, refused, or a numerical outcome.
"""
import copy
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys

import attack

TABLE = {"name": "edge", "site": {"latitude_deg": 45, "gravity_m_s2": 9.81},
         "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                  "inertia": {"about": "center_of_mass", "principal_kg_m2": [6e-5, 6e-5, 4e-5]}},
         "contact": {"tip_radius_m": 0.002},
         "release": {"tilt_deg": 10, "azimuth_deg": 90, "spin_rad_s": 150},
         "motion": {"duration_s": 0.5, "output_step_s": 0.05}}
LAWS = {"frictionless": {}, "viscous": {"sliding_viscosity_N_s_m": 0.1}, "viscous_load": {"sliding_viscosity_s_m": 0.5},
        "coulomb": {"friction_coefficient": 0.3}, "regularised": {"friction_coefficient": 0.3, "regularisation_m_s": 1e-3},
        "contensou": {"friction_coefficient": 0.3, "patch_radius_m": 3e-5}, "rolling": {}}
FRICTION = ("sliding_viscosity_N_s_m", "sliding_viscosity_s_m", "friction_coefficient")
PIVOT = {"name": "edge", "site": {"latitude_deg": 45, "gravity_m_s2": 9.81},
         "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                  "inertia": {"about": "center_of_mass", "principal_kg_m2": [6e-5, 6e-5, 4e-5]}},
         "release": {"tilt_deg": 20, "azimuth_deg": 90, "spin_rad_s": 150},
         "motion": {"duration_s": 0.5, "output_step_s": 0.05}}

# An edge: its name and the values at JSON pointers. None for a value leaves the key out.
TABLE_EDGES = [("mu 0", {f"/contact/{key}": 0 for key in FRICTION}), ("tip radius 0", {"/contact/tip_radius_m": 0}),
               ("spin 0", {"/release/spin_rad_s": 0}), ("patch 1e-12", {"/contact/patch_radius_m": 1e-12}),
               ("tilt 89", {"/release/tilt_deg": 89}), ("gravity 1e-300", {"/site/gravity_m_s2": 1e-300})]
PIVOT_EDGES = [("mass 1e-30", {"/body/mass_kg": 1e-30, "/body/inertia/principal_kg_m2": [6e-34, 6e-34, 4e-34]}),
               ("mass 1e-300", {"/body/mass_kg": 1e-300, "/body/inertia/principal_kg_m2": [6e-304, 6e-304, 4e-304]}),
               ("lever 0", {"/body/center_of_mass_m": [0, 0, 0]}), ("lever 1e-300", {"/body/center_of_mass_m": [0, 0, 1e-300]}),
               ("gravity 0", {"/site/gravity_m_s2": 0}), ("gravity 1e-300", {"/site/gravity_m_s2": 1e-300}),
               ("spin 0", {"/release/spin_rad_s": 0}), ("rate 0", {"/earth/rotation_rate_rad_s": 0}),
               ("rate 1e-300", {"/earth/rotation_rate_rad_s": 1e-300}),
               ("duration 1e-12", {"/motion/duration_s": 1e-12, "/motion/output_step_s": 1e-13}),
               ("tilt 0", {"/release/tilt_deg": 0}), ("tilt 180", {"/release/tilt_deg": 180})]
# The third value of a pair.
BESIDE = [("pole", {"/site/latitude_deg": 90}), ("equator", {"/site/latitude_deg": 0}),
          ("rate 0", {"/earth/rotation_rate_rad_s": 0}), ("rate 1e-300", {"/earth/rotation_rate_rad_s": 1e-300}),
          ("rate 1", {"/earth/rotation_rate_rad_s": 1}), ("one row more", {"/motion/output_step_s": 0.5}),
          ("duration 1e-9", {"/motion/duration_s": 1e-9, "/motion/output_step_s": 1e-10}),
          ("inertial", {"/release/rates_relative_to": "inertial"}), ("spin 1e-12", {"/release/spin_rad_s": 1e-12}),
          ("backwards", {"/release/spin_rad_s": -150}), ("upright", {"/release/tilt_deg": 0}),
          ("almost upright", {"/release/tilt_deg": 1e-9}), ("precession 3", {"/release/precession": {"rate_rad_s": 3}}),
          ("mass 1e-20", {"/body/mass_kg": 1e-20, "/body/inertia/principal_kg_m2": [6e-24, 6e-24, 4e-24]}),
          ("sphere", {"/body/center_of_mass_m": [0, 0, 0], "/body/inertia/principal_kg_m2": [4e-5, 4e-5, 4e-5]}),
          ("long double", {"/numerics/precision": "long_double"}), ("no Coriolis", {"/effects/coriolis": False})]
TABLE_BESIDE = BESIDE + [("start rolling", {"/contact/start": "rolling"}), ("tilted table", {"/contact/table/tilt_deg": 1e-9}),
                         ("at rest", {"/contact/start": "center_of_mass_at_rest"}),
                         ("moments", {"/contact/spinning_friction_m": 1e-5, "/contact/regularisation_rad_s": 1})]

NO_NUMBER = re.compile(r"(?<![A-Za-z_-])[-+]?(?:inf|nan|infinity)(?![A-Za-z_])", re.IGNORECASE)
CODE = re.compile(r"<script(?![^>]*application/json)[^>]*>.*?</script>|base64,[A-Za-z0-9+/=]*", re.DOTALL)


def put(document, pointer, value):
    """Puts a value in a document."""
    *parents, last = pointer.split("/")[1:]
    for key in parents:
        document = document.setdefault(key, {})
    document[last] = value


def scene(base, law, edges):
    """A scene with edges; None where an edge says nothing about it: a patch or a coefficient that the law does not have."""
    document = copy.deepcopy(base)
    if law:
        document["contact"].update({"law": "coulomb" if law == "regularised" else law, **LAWS[law]})
    for _, values in edges:
        said = False
        for pointer, value in values.items():
            key = pointer.rsplit("/", 1)[1]
            if (key in FRICTION or key == "patch_radius_m") and key not in document["contact"]:
                continue
            said = True
            put(document, pointer, value)
        if not said:
            return None
    return document


def scenes(chosen, base, laws, edges, beside):
    """Cases (kind, name, document): every edge alone, and every pair with a third value. @param chosen  a random generator"""
    for law in laws:
        kind = f"table, {law}" if law else "pivot"
        for edge in edges:
            yield kind, edge[0], scene(base, law, [edge])
        for pair in itertools.combinations(edges, 2):
            pointers = {pointer for edge in pair for pointer in edge[1]}
            third = chosen.choice([one for one in beside if not pointers & set(one[1])])
            yield kind, ", ".join(edge[0] for edge in (*pair, third)), scene(base, law, [*pair, third])


def no_numbers(where, text):
    """Faults: infinities and NaN in a text, each with what stands around it."""
    text = CODE.sub("", text)
    return [f"{where}: ...{text[max(0, m.start() - 60):m.end() + 30]!r}" for m in itertools.islice(NO_NUMBER.finditer(text), 2)]


def faults_of_end(where, end, allowed):
    """Faults of how a program ended, and of what it said."""
    faults = no_numbers(where, end.out) + no_numbers(where + ", messages", end.err)
    if end.status not in allowed:
        faults.append(f"{where}: status {end.status}: {end.err[:200]!r}")
    elif end.status not in (0, 1) and not (end.err or end.out).strip():
        faults.append(f"{where}: status {end.status} without a word")
    if "unexpected" in end.err:
        faults.append(f"{where}: {end.err[:200]!r}")
    return faults


PYTHON = """
import json, sys
import earthtop as et
out = []
for file in sys.argv[1:]:
    try:
        top = et.load(file)
    except et.Error as error:
        out.append(str(error))
        continue
    try:
        r = et.run(top)
        out += [json.dumps(r.summary), str(r), repr(r), r._repr_html_(), r.svg]
    except et.Error as error:
        out.append(str(error))
    try:
        out += [str(et.explain(top)), repr(et.explain(top))]
    except et.Error as error:
        out.append(str(error))
print("\\n".join(out))
"""


def main():
    """Runs all scenes."""
    under = attack.Attack(__doc__, lambda parser: parser.add_argument("--python", metavar="DIR"))
    python = under.options.python and os.path.abspath(under.options.python)

    def attempt(case, folder):
        folder = pathlib.Path(folder)
        (folder / "edge.json").write_text(json.dumps(case[2]))

        def earthtop(where, allowed, *arguments):
            end = under.run(*arguments, cwd=folder)
            return end, faults_of_end(where, end, allowed)

        checked, faults = earthtop("check", (0, 1), "check", "edge.json")
        good = checked.status == 0
        ran, more = earthtop("run", (0, 3) if good else (2,), "run", "edge.json", "--out", "out")
        faults += more
        if ran.status in (0, 3) and (folder / "out/summary.json").exists():
            told = json.loads((folder / "out/summary.json").read_text())
            if not re.fullmatch("[a-z_]+", told["outcome"]["status"]):
                faults.append(f"summary.json: the outcome is {told['outcome']}")
            for file in sorted((folder / "out").iterdir()):
                faults += no_numbers(file.name, file.read_text(errors="replace"))
            faults += earthtop("report", (0,), "report", "out", "--quiet")[1]
            for page in (folder / "out").glob("*.html"):
                faults += no_numbers(page.name, page.read_text())
            for json_too in ([], ["--json"]):
                faults += earthtop(" ".join(["compare", *json_too]), (0,), "compare", "out", "out", *json_too)[1]
            # Another tolerance gives other numbers, and differences where there was nothing.
            other = ["run", "edge.json", "--out", "other", "--quiet", "--set", "/numerics/relative_tolerance=1e-9"]
            if earthtop("run", (0, 2, 3), *other)[0].status != 2:
                faults += earthtop("compare others", (0, 1), "compare", "out", "other")[1]
                compared, more = earthtop("compare others --json", (0, 1), "compare", "out", "other", "--json", "--junit", "junit.xml")
                (folder / "comparison.json").write_text(compared.out)
                junit = folder / "junit.xml"
                faults += more + (no_numbers(junit.name, junit.read_text()) if junit.exists() else ["no junit.xml"])
                faults += earthtop("report comparison.json", (0,), "report", "comparison.json", "--quiet")[1]
                page = folder / "comparison.html"
                faults += no_numbers(page.name, page.read_text()) if page.exists() else ["no comparison.html"]
        elif ran.status == 0:
            faults.append("run: no summary.json")
        done = (0, 2, 3) if good else (2,)
        faults += earthtop("run --json", (ran.status,), "run", "edge.json", "--out", "out2", "--json", "--quiet")[1]
        for json_too in ([], ["--json"]):
            faults += earthtop(" ".join(["explain", *json_too]), done, "explain", "edge.json", *json_too)[1]
        if python:
            try:
                end = subprocess.run([sys.executable, "-W", "error", "-c", PYTHON, "edge.json"], cwd=folder, capture_output=True, text=True,
                                     timeout=60, check=False, env={**os.environ, "PYTHONPATH": python})
                faults += faults_of_end("Python", attack.End(end.returncode, end.stdout, end.stderr), (0,))
            except subprocess.TimeoutExpired:
                faults.append("Python: more than a minute")
        return faults

    cases = [*scenes(under.random, TABLE, LAWS, TABLE_EDGES, TABLE_BESIDE),
             *scenes(under.random, PIVOT, [None], PIVOT_EDGES, BESIDE)]
    under.all([case for case in cases if case[2]], attempt)
    under.end()


if __name__ == "__main__":
    main()
