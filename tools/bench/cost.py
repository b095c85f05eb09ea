#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what a whole run costs against duration, spin and friction: processor time of `earthtop run --jobs 1`, median of three.

    tools/bench/cost.py [EARTHTOP]      the program; default: build/release/tools/earthtop/earthtop

Writes tools/bench/pictures/cost.svg.
"""

import json
import math
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLORS = {"taylor": "#0072b2", "long_horizon": "#d55e00", "closed_form": "#009e73", "dop853": "#cc79a7", "rkf78": "#e69f00"}
MOST_S = 4.0  # a line ends at the first point that takes longer


def decades(first, last, each=4):
    n = round(each * math.log10(last / first))
    return [float(f"{first * 10 ** (i / each):.3g}") for i in range(n + 1)]


# title, unit of the abscissa, scenario, key, values, other settings
PANELS = [
    ("duration", "s", "toy-top", "/motion/duration_s", decades(1, 10000), {}),
    ("duration, fast gyroscope", "s", "fast-gyro", "/motion/duration_s", decades(1, 100000), {}),
    ("spin, 60 s", "rad/s", "toy-top", "/release/spin_rad_s", decades(50, 5000), {}),
    ("viscous friction, 60 s", "N m s", "toy-top", "/effects/viscous_torque_N_m_s", decades(1e-10, 1e-3), {}),
]


def cost(program, scenario, sets, out):
    """Processor time (s) of one run, and the method it took."""
    command = [program, "run", str(ROOT / "scenarios" / (scenario + ".json")), "--jobs", "1", "--force", "--quiet", "--out", out]
    for key, value in sets.items():
        command += ["--set", f"{key}={value}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        return None, ""
    summary = json.loads((pathlib.Path(out) / "summary.json").read_text())
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, summary["solution"]["method"]


def measured(program):
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        for title, unit, scenario, key, values, others in PANELS:
            points = []
            for value in values:
                sets = {key: value, **others}
                if key == "/motion/duration_s":
                    sets["/motion/output_step_s"] = value / 200
                runs = [cost(program, scenario, sets, folder + "/out") for _ in range(3)]
                if runs[0][0] is None:
                    continue
                points.append((value, statistics.median(seconds for seconds, _ in runs), runs[0][1]))
                if points[-1][1] > MOST_S:
                    break
            lines.append((title, unit, scenario, points))
    return lines


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
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/tools/earthtop/earthtop")
    lines = measured(program)
    (ROOT / "tools/bench/pictures/cost.svg").write_text(picture(lines))
    for title, unit, scenario, points in lines:
        print(f"{scenario}, {title}:", ", ".join(f"{x:g} {unit} {y:.3g} s {m}" for x, y, m in points))


if __name__ == "__main__":
    main()
