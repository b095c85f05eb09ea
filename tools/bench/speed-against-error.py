#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the tables and pictures of speed against error with `earthtop bench`: for the drift, and for one motion.

    tools/bench/speed-against-error.py [--short] [--keep DIR | --from DIR] [EARTHTOP]

    EARTHTOP     the program; default: build/bench/tools/earthtop/earthtop
    --short      measures only what the short table needs, and writes only that
    --keep DIR   keeps the benchmark documents (drift.json, motion.json) in DIR
    --from DIR   makes the tables again from documents kept in DIR, and measures nothing

Writes three things: the short table in README.md, between its marks `<!-- speed: begin -->` and `<!-- speed: end -->`; the long tables
in tools/bench/README.md, between the marks `<!-- speed against error: begin -->` and `end`; and the pictures
tools/bench/pictures/speed-NAME.svg. The short table goes to standard output, too. Status 1: a manual has no such marks.
"""

import argparse
import datetime
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SCENARIOS = [
    "scenarios/toy-top.json",
    "scenarios/fast-gyro.json",
    "scenarios/asymmetric-top.json",
    "tools/bench/scenarios/chaotic-top.json",
]
OPTIONS = ["--duration", "60", "--limit", "0.5"]
# The short table: of each scenario of the first three, the family whose method and equations these are. Peers integrate the general
# equations twice, and take the difference.
SHORT_SCENARIOS = ("toy-top", "fast-gyro", "asymmetric-top")
SHORT = [
    ("dop853, here", "dop853", "general, body"),
    ("rkf78, Boost.Odeint", "rkf78", "general, body"),
    ("rk8pd, GSL", "gsl_rk8pd", "difference of two"),
    ("CVODE (Adams), SUNDIALS", "cvode_adams", "difference of two"),
    ("ARKODE (Fehlberg 7(8)), SUNDIALS", "arkode_erk", "difference of two"),
]


def bench(program, scenarios, *more):
    """The document of one run."""
    command = [program, "bench", *scenarios, *OPTIONS, "--json", *more]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def head(document):
    lines = []
    for scenario in document["scenarios"]:
        reference = scenario["reference"]
        lines.append(
            f"- `{scenario['scenario']}`, {scenario['duration_s']:g} s, largest drift {scenario['largest_drift_rad']:.3g} rad. "
            f"Reference: {reference['source']}, against {reference['witness']}: "
            f"the drift to {reference['error']['drift_rad']:.1e} rad."
        )
    return "\n".join(lines)


def cost(cell):
    if cell["seconds"] is None:
        return "-"
    return ("≤" if cell["at_most"] else "") + f"{1e3 * cell['seconds']:.3g}"


def costs(family):
    if family is None:
        return "not compiled in"
    reached = any(cell["seconds"] is not None for cell in family["costs"])
    return " / ".join(cost(cell) for cell in family["costs"]) if reached else "-"


def equal_error(document):
    """A line for each method in double precision, three costs for each scenario."""
    names = [scenario["scenario"] for scenario in document["scenarios"]]
    rows = {}
    for scenario in document["scenarios"]:
        for family in scenario["equal_error"]:
            if family["precision"] == "double":
                key = (family["method"], family["equations"])
                rows.setdefault(key, {})[scenario["scenario"]] = costs(family)
    lines = ["| method | equations | " + " | ".join(f"`{name}`" for name in names) + " |"]
    lines.append("| --- | --- |" + " ---: |" * len(names))
    for (method, equations), cells in rows.items():
        lines.append(f"| {method} | {equations} | " + " | ".join(cells.get(name, "") for name in names) + " |")
    return "\n".join(lines)


def setting(entry):
    if entry["relative_tolerance"] is not None:
        return f"{entry['relative_tolerance']:.0e}"
    return f"step {entry['step_s']:.3g} s" if entry["step_s"] is not None else "-"


def front(scenario):
    lines = [
        f"| `{scenario['scenario']}`: method | tolerance | equations | precision | milliseconds | least, most | right-hand sides | steps "
        "| axis error | attitude error | drift error (rad) |",
        "| --- | --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    shown = [entry for entry in scenario["entries"] if entry["on_front"] or entry["auto"]]
    for entry in sorted(shown, key=lambda e: e["seconds"]):
        method = entry["method"] + (" (`auto`)" if entry["auto"] else "") + ("" if entry["on_front"] else ", not on the front")
        errors = [entry["error"][k] if entry["error"] else None for k in ("axis_rad", "attitude_rad", "drift_rad")]
        known = scenario["reference"]["error"]
        texts = [
            "-" if e is None else f"<{known[k]:.1e}" if e < known[k] else f"{e:.1e}"
            for e, k in zip(errors, ("axis_rad", "attitude_rad", "drift_rad"))
        ]
        lines.append(
            f"| {method} | {setting(entry)} | {entry['equations']} | {entry['precision']} | {1e3 * entry['seconds']:.3g} "
            f"| {1e3 * entry['seconds_least']:.3g}, {1e3 * entry['seconds_most']:.3g} | {entry['evaluations']} | {entry['steps']} "
            "| " + " | ".join(texts) + " |"
        )
    return "\n".join(lines)


def pictures(document):
    names = [scenario["scenario"] for scenario in document["scenarios"]]
    images = [f"![{name}: error of the drift against processor time](pictures/speed-{name}.svg)" for name in names]
    return "| | |\n| --- | --- |\n" + "\n".join(f"| {a} | {b} |" for a, b in zip(images[::2], images[1::2]))


def measured(document):
    """Where and when."""
    return f"{document['processor']}, {document['measured']}"


def section(document, motion):
    scenarios = document["scenarios"]
    contenders = sum(len(scenario["entries"]) for scenario in scenarios)
    slow = sum(entry["outcome"] in ("too_slow", "not_tried") for scenario in scenarios for entry in scenario["entries"])
    fronts = "\n\n".join(front(scenario) for scenario in scenarios)
    return f"""Measured by `tools/bench/speed-against-error.py` on an {measured(document)}: processor time of one core, shared with other work.
Peers: {document["peers"]}. Of {contenders} contenders {slow} took more than {scenarios[0]["most_seconds"]:g} s of it and were left out.

{head(document)}

**Both motions and the drift.** Milliseconds at a drift error of 1e-6 / 1e-9 / 1e-12 rad, in double precision (≤: the cheapest setting
tried is more exact already; -: no setting tried reaches this error in that time):

{equal_error(document)}

{pictures(document)}

<details><summary>The rotating motion alone</summary>

Milliseconds at an axis error of 1e-6 / 1e-9 / 1e-12 rad. Here a peer integrates one motion, as the other methods do.

{equal_error(motion)}

</details>

<details><summary>The Pareto fronts, and what <code>auto</code> takes</summary>

{fronts}

</details>
"""


def families(scenario, method, equations):
    for family in scenario["equal_error"]:
        if family["precision"] == "double" and family["method"] == method and equations in (None, family["equations"]):
            yield family


def auto_family(scenario):
    auto = next(entry for entry in scenario["entries"] if entry["auto"])
    return next(families(scenario, auto["method"], auto["equations"]))


def short_section(document):
    """The face's table: what `auto` takes beside the peers, at three errors."""
    scenarios = [next(s for s in document["scenarios"] if s["scenario"] == name) for name in SHORT_SCENARIOS]
    lines = ["| method | " + " | ".join(f"`{s['scenario']}`, {s['duration_s']:g} s" for s in scenarios) + " |"]
    lines.append("| --- |" + " ---: |" * len(scenarios))
    chosen = [auto_family(s) for s in scenarios]
    words = list(dict.fromkeys(f"`{family['method']}`" for family in chosen))
    lines.append(f"| {' or '.join(words)}, as `auto` takes it | " + " | ".join(costs(family) for family in chosen) + " |")
    for title, method, equations in SHORT:
        lines.append(f"| {title} | " + " | ".join(costs(next(families(s, method, equations), None)) for s in scenarios) + " |")
    table = "\n".join(lines)
    return f"""Milliseconds of one core for both motions and the drift, at a drift error of 1e-6 / 1e-9 / 1e-12 rad (≤: the cheapest setting tried is more
exact already; -: not reached in {1e3 * scenarios[0]["most_seconds"]:g} ms):

{table}

Measured by `tools/bench/speed-against-error.py` on an {measured(document)}, shared with other work. All but the
first row integrate the equations of any body, in body axes.
"""


def write_between(path, mark, text):
    """Replaces what is between the marks `<!-- MARK: begin -->` and `<!-- MARK: end -->`. Whether the file has them."""
    begin, end = f"<!-- {mark}: begin -->\n", f"<!-- {mark}: end -->\n"
    manual = path.read_text()
    if manual.count(begin) != 1 or manual.count(end) != 1:
        marks = f"{begin.strip()} and {end.strip()}"
        print(f"speed-against-error.py: {path.relative_to(ROOT)} does not have the marks {marks} once", file=sys.stderr)
        return False
    before, rest = manual.split(begin)
    path.write_text(before + begin + text + end + rest.split(end)[1])
    return True


def documents(arguments):
    """The benchmark of the drift, and of the rotating motion alone unless only the short table is wanted."""
    if arguments.source:
        names = ["drift"] if arguments.short else ["drift", "motion"]
        return [json.loads((arguments.source / f"{name}.json").read_text()) for name in names]
    program = str(arguments.program.resolve())
    if arguments.short:
        methods = dict.fromkeys(["auto", "taylor", "long_horizon"] + [method for _, method, _ in SHORT])
        built = subprocess.run([program, "bench", "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        asked = ",".join(method for method in methods if method in built)
        found = [bench(program, SCENARIOS[: len(SHORT_SCENARIOS)], "--methods", asked)]
    else:
        with tempfile.TemporaryDirectory() as directory:
            found = [bench(program, SCENARIOS, "--out", directory)]
            for scenario in found[0]["scenarios"]:
                name = f"{scenario['scenario']}.svg"
                shutil.copyfile(pathlib.Path(directory, name), HERE / f"pictures/speed-{name}")
        found.append(bench(program, SCENARIOS, "--workload", "motion", "--error", "axis"))
    for document in found:
        document["measured"] = f"{datetime.date.today():%B %Y}"
    if arguments.keep:
        arguments.keep.mkdir(parents=True, exist_ok=True)
        for name, document in zip(["drift", "motion"], found):
            (arguments.keep / f"{name}.json").write_text(json.dumps(document))
    return found


def main():
    parser = argparse.ArgumentParser(description="Makes the tables and pictures of speed against error.")
    parser.add_argument("--short", action="store_true", help="only the short table")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="keep the benchmark documents there")
    parser.add_argument("--from", dest="source", type=pathlib.Path, metavar="DIR", help="make the tables from documents kept there")
    parser.add_argument("program", nargs="?", type=pathlib.Path, default=ROOT / "build/bench/tools/earthtop/earthtop")
    arguments = parser.parse_args()
    found = documents(arguments)
    print(short_section(found[0]), end="")
    done = [write_between(ROOT / "README.md", "speed", short_section(found[0]))]
    if not arguments.short:
        done.append(write_between(HERE / "README.md", "speed against error", section(*found)))
    return 0 if all(done) else 1


if __name__ == "__main__":
    sys.exit(main())
