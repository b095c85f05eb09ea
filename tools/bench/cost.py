#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ladders: what a whole run costs as one key of a scenario goes up in small steps, and where the cost jumps.

    tools/bench/cost.py [--draw] [--only WORD] [EARTHTOP]      the program; default: build/release/tools/earthtop/earthtop

Prints the processor time of `earthtop run --jobs 1` at each step, least of three, and marks a factor above 3 between neighbours with `<--`.
--draw takes the first four alone and writes them to tools/bench/pictures/cost.svg; --only takes the ladders with this word in their names.
Exit status: 0, or 1 where there is a factor above 3 in another ladder than those whose cliffs the manual of speed names.
"""

import argparse
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLORS = {"taylor": "#0072b2", "long_horizon": "#d55e00", "closed_form": "#009e73", "dop853": "#cc79a7", "rkf78": "#e69f00"}
MOST_S = 4.0  # a line ends at the first point that takes longer


def decades(first, last, each=4):
    n = round(each * math.log10(last / first))
    return [float(f"{first * 10 ** (i / each):.3g}") for i in range(n + 1)]


# title, unit of the abscissa, scenario, key, values, other settings; the first four are drawn
PANELS = [
    ("duration", "s", "toy-top", "/motion/duration_s", decades(1, 10000), {}),
    ("duration, fast gyroscope", "s", "fast-gyro", "/motion/duration_s", decades(1, 100000), {}),
    ("spin, 60 s", "rad/s", "toy-top", "/release/spin_rad_s", decades(50, 5000), {}),
    ("viscous friction, 60 s", "N m s", "toy-top", "/effects/viscous_torque_N_m_s", decades(1e-10, 1e-3), {}),
]
HOUR = {"/motion/duration_s": 3600, "/motion/output_step_s": 6}
LADDERS = [
    *PANELS,
    ("spin, slow", "rad/s", "toy-top", "/release/spin_rad_s", [20 + 2.5 * i for i in range(29)], {}),
    ("tilt", "deg", "toy-top", "/release/tilt_deg", [0, 0.01, 0.03, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 40, 60, 80, 90, 100, 130, 150, 170, 175, 179, 179.9, 180], {}),
    ("small tilt, an hour", "deg", "fast-gyro", "/release/tilt_deg", [0.04 * i for i in range(1, 25)], HOUR),
    ("tilt, an hour", "deg", "fast-gyro", "/release/tilt_deg", [1, 2, 5, 10, 20, 30, 45, 60, 75, 90, 105, 120, 150, 170, 175, 178, 179, 179.9], HOUR),
    ("Earth rate", "rad/s", "toy-top", "/earth/rotation_rate_rad_s", decades(1e-14, 1, 1), {}),
    ("Earth rate, an hour", "rad/s", "fast-gyro", "/earth/rotation_rate_rad_s", decades(1e-14, 1e-2, 1), HOUR),
    ("time between rows", "s", "toy-top", "/motion/output_step_s", decades(0.01, 60), {}),
    ("tolerance", "1", "toy-top", "/numerics/relative_tolerance", decades(1e-14, 1e-5, 1), {}),
    ("tolerance, an hour", "1", "fast-gyro", "/numerics/relative_tolerance", decades(1e-14, 1e-5, 1), HOUR),
    ("inertia about axis 2, a minute", "kg m2", "toy-top", "/body/inertia/principal_kg_m2/1", [1.2e-4 * (1 - 10.0**e) for e in (-17, -15, -12, -9, -6, -5, -4, -3, -2, -1)], {}),
    ("offset, the pace of precession, an hour", "m", "unbalanced-gyro-hour", "/body/center_of_mass_m/2", decades(0.0005, 0.05, 6), {}),
    ("duration, table", "s", "tippe-top", "/motion/duration_s", decades(0.1, 10), {}),
]
CLIFF = 3
NAMED = {"toy-top: spin, 60 s", "fast-gyro: Earth rate, an hour", "toy-top: inertia about axis 2, a minute"}
UNNOTICED_S = 0.02  # a shorter run costs nobody anything


def cost(program, scenario, sets, out):
    """Processor time (s) of one run, and the method it took."""
    folder = next(folder for folder in (ROOT / "scenarios", ROOT / "tools/bench/scenarios") if (folder / f"{scenario}.json").exists())
    command = [program, "run", str(folder / f"{scenario}.json"), "--jobs", "1", "--force", "--quiet", "--out", out]
    for key, value in sets.items():
        command += ["--set", f"{key}={value}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        return None, ""
    summary = json.loads((pathlib.Path(out) / "summary.json").read_text())
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, summary["solution"]["method"]


def climbed(program, ladder):
    """The steps of a ladder: value, processor time, method; no time where the scenario is refused."""
    _, _, scenario, key, values, others = ladder
    points = []
    with tempfile.TemporaryDirectory() as folder:
        for value in values:
            sets = {**others, key: value}
            if key == "/motion/duration_s":
                sets["/motion/output_step_s"] = value / 200
            runs = [cost(program, scenario, sets, folder + "/out") for _ in range(3)]
            if runs[0][0] is not None:
                points.append((value, min(seconds for seconds, _ in runs), runs[0][1]))
            if points and points[-1][1] > MOST_S:
                break
    return points


def told(ladder, points):
    """Prints a ladder. @returns whether a step costs far more or less than its neighbour"""
    title, unit, scenario, *_ = ladder
    print(f"\n{scenario}: {title} ({unit})")
    jumps = False
    for i, (value, seconds, method) in enumerate(points):
        before = points[i - 1][1] if i else seconds
        ratio = max(seconds, UNNOTICED_S) / max(before, UNNOTICED_S)
        jump = max(ratio, 1 / ratio) > CLIFF
        jumps = jumps or jump
        print(f"  {value:<12.6g} {seconds:8.3f} s  {method:<14}{f'<-- {ratio:.2f}' if jump else ''}", flush=True)
    return jumps


def picture(lines):
    width, height, left, top, bottom = 420, 260, 52, 34, 40
    columns = 2
    low, high = 1e-3, 10.0
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {columns * width} {2 * height + 26}" '
        'font-family="sans-serif" font-size="12" role="img" aria-label="processor time of whole runs">',
        "<style>text{fill:#222}line,path{stroke:#bbb}</style>",
        f'<rect width="{columns * width}" height="{2 * height + 26}" fill="#fff"/>',
    ]
    for i, (title, unit, scenario, points) in enumerate(lines):
        x0, y0 = (i % columns) * width + left, (i // columns) * height + top
        w, h = width - left - 16, height - top - bottom
        xs = [p[0] for p in points]
        first, last = math.floor(math.log10(min(xs))), math.ceil(math.log10(max(xs)))

        def place(x, y):
            return (
                x0 + w * (math.log10(x) - first) / (last - first),
                y0 + h * (1 - (math.log10(max(y, low)) - math.log10(low)) / (math.log10(high) - math.log10(low))),
            )

        parts.append(f'<text x="{x0}" y="{y0 - 12}" font-weight="bold">{scenario}: {title}</text>')
        for power in range(-3, 2):
            _, y = place(10.0**first, 10.0**power)
            parts.append(f'<line x1="{x0}" x2="{x0 + w}" y1="{y:.1f}" y2="{y:.1f}"/>')
            parts.append(f'<text x="{x0 - 6}" y="{y + 4:.1f}" text-anchor="end">{10.0**power:g}</text>')
        for power in range(first, last + 1):
            x, _ = place(10.0**power, low)
            parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{y0}" y2="{y0 + h}"/>')
            parts.append(f'<text x="{x:.1f}" y="{y0 + h + 16}" text-anchor="middle">{10.0**power:g}</text>')
        parts.append(f'<text x="{x0 + w / 2}" y="{y0 + h + 32}" text-anchor="middle">{unit}</text>')
        for x, y, method in points:
            px, py = place(x, y)
            parts.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="4" fill="{COLORS.get(method, "#000")}"/>')
    x = left
    for method in sorted({p[2] for line in lines for p in line[3]}):
        y = 2 * height + 12
        parts.append(f'<circle cx="{x}" cy="{y}" r="4" fill="{COLORS.get(method, "#000")}"/>')
        parts.append(f'<text x="{x + 9}" y="{y + 4}">{method}</text>')
        x += 120
    parts.append(f'<text x="{columns * width - 16}" y="{2 * height + 16}" text-anchor="end">ordinate: s of one core</text>')
    return "\n".join([*parts, "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draw", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("program", nargs="?", default=str(ROOT / "build/release/tools/earthtop/earthtop"))
    given = parser.parse_args()
    jumped, drawn = [], []
    for ladder in PANELS if given.draw else LADDERS:
        title, unit, scenario, *_ = ladder
        name = f"{scenario}: {title}"
        if given.only not in name:
            continue
        points = climbed(given.program, ladder)
        if told(ladder, points):
            jumped.append(name)
        drawn.append((title, unit, scenario, points))
    if given.draw:
        (ROOT / "tools/bench/pictures/cost.svg").write_text(picture(drawn))
    if jumped:
        print("\na factor above 3 in: " + "; ".join(jumped))
    return 1 if set(jumped) - NAMED else 0


if __name__ == "__main__":
    sys.exit(main())
