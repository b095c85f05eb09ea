#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes README's tables and pictures of speed against error with `earthtop bench`: for the drift, and for one motion.

    tools/readme/speed-against-error.py [EARTHTOP]      the program; default: build/bench/tools/earthtop/earthtop

Writes tools/readme/speed-NAME.svg, and README.md between the two marks of this script.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = [
    "scenarios/toy-top.json",
    "scenarios/fast-gyro.json",
    "scenarios/asymmetric-top.json",
    "tools/readme/chaotic-top.json",
]
OPTIONS = ["--duration", "60", "--limit", "0.5"]
BEGIN, END = "<!-- speed against error: begin -->\n", "<!-- speed against error: end -->\n"


def bench(program, *more):
    """The document of one run."""
    command = [program, "bench", *SCENES, *OPTIONS, "--json", *more]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)


def head(document):
    lines = []
    for scene in document["scenarios"]:
        reference = scene["reference"]
        lines.append(
            f"- `{scene['scenario']}`, {scene['duration_s']:g} s, largest drift {scene['largest_drift_rad']:.3g} rad. "
            f"Reference: {reference['source']}, against {reference['witness']}: "
            f"the drift to {reference['error']['drift_rad']:.1e} rad."
        )
    return "\n".join(lines)


def cost(cell):
    if cell["seconds"] is None:
        return "-"
    return ("≤" if cell["at_most"] else "") + f"{1e3 * cell['seconds']:.3g}"


def equal_error(document):
    """A line for each method in double precision, three costs for each scene."""
    names = [scene["scenario"] for scene in document["scenarios"]]
    rows = {}
    for scene in document["scenarios"]:
        for family in scene["equal_error"]:
            if family["precision"] == "double":
                key = (family["method"], family["equations"])
                reached = any(c["seconds"] is not None for c in family["costs"])
                rows.setdefault(key, {})[scene["scenario"]] = " / ".join(cost(c) for c in family["costs"]) if reached else "-"
    lines = ["| method | equations | " + " | ".join(f"`{name}`" for name in names) + " |"]
    lines.append("| --- | --- |" + " ---: |" * len(names))
    for (method, equations), cells in rows.items():
        lines.append(f"| {method} | {equations} | " + " | ".join(cells.get(name, "") for name in names) + " |")
    return "\n".join(lines)


def setting(entry):
    if entry["relative_tolerance"] is not None:
        return f"{entry['relative_tolerance']:.0e}"
    return f"step {entry['step_s']:.3g} s" if entry["step_s"] is not None else "-"


def front(scene):
    lines = [
        f"| `{scene['scenario']}`: method | tolerance | equations | precision | milliseconds | least, most | right-hand sides | steps "
        "| axis error | attitude error | drift error (rad) |",
        "| --- | --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    shown = [entry for entry in scene["entries"] if entry["on_front"] or entry["auto"]]
    for entry in sorted(shown, key=lambda e: e["seconds"]):
        method = entry["method"] + (" (`auto`)" if entry["auto"] else "") + ("" if entry["on_front"] else ", not on the front")
        errors = [entry["error"][k] if entry["error"] else None for k in ("axis_rad", "attitude_rad", "drift_rad")]
        known = scene["reference"]["error"]
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
    names = [scene["scenario"] for scene in document["scenarios"]]
    images = [f"![{name}: error of the drift against processor time](tools/readme/speed-{name}.svg)" for name in names]
    return "| | |\n| --- | --- |\n" + "\n".join(f"| {a} | {b} |" for a, b in zip(images[::2], images[1::2]))


def section(document, motion):
    scenes = document["scenarios"]
    contenders = sum(len(scene["entries"]) for scene in scenes)
    slow = sum(entry["outcome"] in ("too_slow", "not_tried") for scene in scenes for entry in scene["entries"])
    return f"""Processor: **{document["processor"]}**, one core, processor time, shared with other work; peers: {document["peers"]}.
Of {contenders} contenders {slow} took more than {scenes[0]["most_seconds"]:g} s of it and were left out.

{head(document)}

Milliseconds for both motions and the drift, at a drift error of 1e-6 / 1e-9 / 1e-12 rad (≤: the cheapest tried is better already;
-: not reached in that time by the tolerances tried), in double precision:

{equal_error(document)}

{pictures(document)}

The rotating motion alone, at an axis error of 1e-6 / 1e-9 / 1e-12 rad; here a peer integrates one motion, as the others do:

{equal_error(motion)}

<details><summary>The Pareto fronts, and what auto takes</summary>

{chr(10).join(front(scene) + chr(10) for scene in scenes)}
</details>
"""


def main():
    program = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/bench/tools/earthtop/earthtop").resolve())
    with tempfile.TemporaryDirectory() as directory:
        document = bench(program, "--out", directory)
        for scene in document["scenarios"]:
            name = scene["scenario"]
            shutil.copyfile(pathlib.Path(directory, f"{name}.svg"), ROOT / f"tools/readme/speed-{name}.svg")
    motion = bench(program, "--workload", "motion", "--error", "axis")
    readme = ROOT / "README.md"
    before, rest = readme.read_text().split(BEGIN)
    readme.write_text(before + BEGIN + section(document, motion) + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
