#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the page of a study in a real browser: round ticks, a scale that one value far away does not take, each point's
scenario by mouse, finger and keys, many points as cells, and that both commands to paste give the same digits again.
$CHROMIUM may name the browser; status 77 if there is none.

usage: study_page_test.py PATH_OF_EARTHTOP
"""

import csv
import json
import math
import os
import pathlib
import subprocess
from typing import Any

import checks
import devtools
import layout
from shipped_pages import SCENARIOS, Program, Report, monte_carlo

HOSTILE = "</script><img src=x onerror=window.hacked=1>'\"&\nEOF\n"
CANVAS = "document.querySelector('#explorer canvas')"
STATE = "document.querySelector('#explorer .state').textContent"
SHOWN = "document.querySelector('#explorer .scenario').textContent"
DATA = "JSON.parse(document.querySelector('#earthtop-data').textContent)"

# Notes down what is written on the canvas, and where, since it was last cleared.
SPY = """(() => {
    window.written = [];
    const pen = CanvasRenderingContext2D.prototype, fillText = pen.fillText, clearRect = pen.clearRect;
    pen.clearRect = function (...box) {
        if (this.canvas.className === 'plane') window.written = [];
        return clearRect.apply(this, box);
    };
    pen.fillText = function (text, x, y) {
        if (this.canvas.className === 'plane')
            window.written.push({ text, x, y, size: parseFloat(this.font), align: this.textAlign, width: this.measureText(text).width });
        return fillText.call(this, text, x, y);
    };
})()"""


def small_grid() -> dict[str, Any]:
    """A free gyroscope released at three azimuths and four latitudes: at the equator, to the North, next to nothing drifts."""
    base = json.loads((SCENARIOS / "free-gyro.json").read_text())
    base = {key: value for key, value in base.items() if key not in ("headline", "title", "purpose")}
    return {"$schema": "earthtop-study-1.json", "name": "grid", "title": HOSTILE, "finding": HOSTILE, "purpose": HOSTILE,
            "base": {**base, "title": HOSTILE}, "set": {"/motion/duration_s": 60, "/motion/output_step_s": 60},
            "axes": [{"name": "latitude_deg", "pointer": "/site/latitude_deg", "values": [-37.3, 0, 22.22, 61.7]},
                     {"name": "azimuth_deg", "pointer": "/release/azimuth_deg", "values": [0, 33.3, 66.6]}],
            "collect": ["drift.axis_final_rad", "drift.verdict"]}


def listed() -> dict[str, Any]:
    """A list of pairs of values, which vary together."""
    study = small_grid()
    return {**study, "name": "listed", "axes": [
        {"name": "place", "pointers": ["/site/latitude_deg", "/release/azimuth_deg"], "values": [[10, 1], [20, 2], [50, 90]]}],
        "fits": [{"kind": "power_law", "axis": "place", "quantity": "drift.axis_final_rad"}]}


def pasted(program: Program, command: str, directory: str) -> pathlib.Path:
    """Runs a text as a shell would, in an empty directory."""
    where = program.directory / directory
    where.mkdir()
    tool = program.directory / "bin"
    tool.mkdir(exist_ok=True)
    if not (tool / "earthtop").exists():
        (tool / "earthtop").symlink_to(program.earthtop)
    done = subprocess.run(["bash", "-eu"], input=command, text=True, cwd=where, capture_output=True, timeout=100, check=False,
                          env={**os.environ, "PATH": f"{tool}:{os.environ['PATH']}"})
    if done.returncode != 0:
        raise RuntimeError(f"pasted command: status {done.returncode}: {done.stderr[:300]}")
    return where


def rows(store: pathlib.Path) -> list[dict[str, str]]:
    with (store / "study.csv").open(newline="") as table:
        return list(csv.DictReader(table))


def round_numbers(texts: list[str]) -> bool:
    """Whether labels are 1, 2 or 5 times a power of ten apart, or powers of ten."""
    values = [checks.number(text) for text in texts]
    steps = {round(math.log10(abs(b - a)) % 1, 3) for a, b in zip(values, values[1:]) if a != b}
    decades = all(value > 0 and abs(math.log10(value) % 1) < 1e-9 for value in values)
    return decades or (len(steps) == 1 and any(abs(step - math.log10(lead)) < 2e-3 for step in steps for lead in (1, 2, 5, 9.999)))


def labels(page: devtools.Page, checks_: checks.Checks, when: str, width: int) -> None:
    """Ticks at round numbers, large enough to read, not on top of each other, inside of the picture."""
    page.evaluate(SPY)
    page.evaluate(f"{CANVAS}.focus()")
    page.key("ArrowRight")
    page.frames(2)
    written = page.evaluate("window.written")
    checks_.expect(len(written) > 6, f"{when}: only {len(written)} labels")
    page_width, page_height = page.evaluate(f"[{CANVAS}.clientWidth, {CANVAS}.clientHeight]")
    bottom = [one for one in written if page_height - 40 < one["y"] < page_height - 20]
    checks_.expect(len(bottom) > 1 and round_numbers([one["text"] for one in bottom]), f"{when}: ticks {[o['text'] for o in bottom]}")
    side = [one for one in written if one["align"] == "right"]
    checks_.expect(len(side) > 1 and round_numbers([one["text"] for one in side]), f"{when}: ticks {[o['text'] for o in side]}")
    checks_.expect(min(one["size"] for one in written) >= 12, f"{when}: labels of {min(one['size'] for one in written)} px")

    def box(one: dict[str, Any]) -> tuple[float, float, float, float]:
        left = one["x"] - {"left": 0, "center": 0.5, "right": 1}[one["align"]] * one["width"]
        return left, left + one["width"], one["y"] - 10, one["y"] + 2
    boxes = {json.dumps(one, sort_keys=True): box(one) for one in written}
    touching = [(a, b) for a in boxes for b in boxes if a < b and boxes[a][0] < boxes[b][1] and boxes[b][0] < boxes[a][1]
                and boxes[a][2] < boxes[b][3] and boxes[b][2] < boxes[a][3]]
    checks_.expect(not touching, f"{when}: labels on each other: {touching[:2]}")
    outside = [one for one in boxes.values() if one[0] < -1 or one[1] > page_width + 1]
    checks_.expect(not outside, f"{when}: labels cut in {width} px: {outside}")


def scenario_of_a_point(page: devtools.Page, program: Program, report: Report, checks_: checks.Checks) -> None:
    """A tap shows the scenario of a point; pasted, it gives the point's values again."""
    page.resize(390)
    checks_.fits(page, f"{report.name} at 390 px")
    if page.evaluate(f"Boolean({CANVAS})"):
        x, y = page.middle(CANVAS)
        page.tap(x, y)
    else:  # the curve is drawn above: a point is chosen from a list
        page.evaluate("(s => { s.selectedIndex = 1; s.dispatchEvent(new Event('change', { bubbles: true })); })"
                      "(document.querySelector('#explorer select'))")
    page.frames(3)
    command = page.evaluate(SHOWN)
    if not checks_.expect(command.startswith("earthtop run -"), f"{report.name}: a tap shows {command[:80]!r}"):
        return
    where = pasted(program, command, f"{report.name}-point")
    summary = json.loads((where / "point/summary.json").read_text())
    drift = summary["drift"]["axis_final_rad"]
    # A study computes only the rows that it needs; with more of them, a run's last digits may differ.
    found = [row for row in rows(report.page.parent) if math.isclose(float(row["drift.axis_final_rad"]), drift, rel_tol=1e-13)]
    checks_.expect(len(found) >= 1, f"{report.name}: the point's scenario drifts by {drift}, none of the study's points does")
    text = page.evaluate(STATE)
    named = [row for row in found if all(f"{float(row[axis]):.6g}" in text for axis in page.evaluate(f"{DATA}.axes.map(a => a.name)"))]
    checks_.expect(report.name == "many" or len(named) >= 1, f"{report.name}: {text!r} names none of {found}")


def again(page: devtools.Page, program: Program, report: Report, checks_: checks.Checks) -> None:
    """The command at the page's end makes the same study in an empty directory."""
    where = pasted(program, page.evaluate("document.querySelector('#section-command code').textContent"), f"{report.name}-again")
    checks_.expect((where / "again/report.html").exists(), f"{report.name}: no page was made again")
    checks_.expect(rows(where / "again") == rows(report.page.parent), f"{report.name}: made again, it has other points")


def same_bits(page: devtools.Page, report: Report, checks_: checks.Checks) -> None:
    """Each point's numbers on the page are those of the table."""
    data = page.evaluate(DATA)
    table = rows(report.page.parent)
    checks_.expect(len(data["points"]) == len(table), f"{report.name}: {len(data['points'])} points of {len(table)}")
    for point, row in zip(data["points"], table):
        for name, value in zip(data["quantities"], point["values"]):
            same = row[name] == value if isinstance(value, str) else float(row[name]) == value
            checks_.expect(same, f"{report.name}, point {row['point']}: {name} {value!r}, in the table {row[name]}")
        for axis, index in zip(data["axes"], point["axes"]):
            checks_.expect(float(row[axis["name"]]) == axis["values"][index], f"{report.name}, point {row['point']}: {axis['name']}")


def keyboard(page: devtools.Page, report: Report, checks_: checks.Checks) -> None:
    """The arrow keys reach every point of a grid, Enter opens its scenario."""
    page.evaluate(f"{CANVAS}.focus()")
    for key in ("ArrowLeft", "ArrowLeft", "ArrowLeft", "ArrowDown", "ArrowDown"):
        page.key(key)
    seen = set()
    for upward in range(3):
        for _ in range(4):
            seen.add(page.evaluate(STATE).split(":")[0])
            page.key("ArrowRight" if upward % 2 == 0 else "ArrowLeft")
        page.key("ArrowUp")
    checks_.expect(len(seen) == 12, f"{report.name}: the arrow keys reached {len(seen)} of 12 points: {sorted(seen)}")
    page.key("Enter")
    page.frames(2)
    checks_.expect(page.evaluate(SHOWN).startswith("earthtop run -"), f"{report.name}: Enter shows no scenario")


def found(page: devtools.Page, report: Report, checks_: checks.Checks) -> None:
    """The heading says what the table says: numbers computed here from study.csv."""
    heading, table = page.evaluate("document.querySelector('h1').textContent"), rows(report.page.parent)
    drift = "drift.azimuth_final_rad" if report.name == "drawn" else "drift.axis_final_rad"
    values = [float(row[drift]) for row in table]

    def arcseconds(rad: float) -> str:
        size = abs(math.degrees(rad)) * 3600
        return f"{'−' if rad < 0 else ''}{size:.4g}″"
    if report.name == "drawn":
        ranked = sorted(values)
        wanted = [arcseconds(ranked[math.floor(share * (len(ranked) - 1) + 0.5)]) for share in (0.05, 0.5, 0.95)]
        wanted += ["median", "nine tenths", "azimuth"]
    elif report.name == "listed":
        laws = page.evaluate("document.querySelector('#section-fits').innerText")
        checks_.expect("drift of the axis at the end = a × (place to the power b)" in laws and "The fits are of numbers in SI units" in laws,
                       f"{report.name}: the fit is told as {laws!r}")
        wanted = [f"from {arcseconds(values[0])} at {float(table[0]['place']):g}", f"to {arcseconds(values[-1])} at {float(table[-1]['place']):g}"]
    else:
        def means(axis: str) -> dict[float, float]:
            levels = {float(row[axis]) for row in table}
            return {level: math.fsum(v for v, row in zip(values, table) if float(row[axis]) == level)
                    / sum(float(row[axis]) == level for row in table) for level in sorted(levels)}
        spreads = {axis: max(means(axis).values()) - min(means(axis).values()) for axis in ("latitude_deg", "azimuth_deg")}
        axis = max(spreads, key=lambda name: spreads[name])
        wanted = [f"depends most on the {axis.removesuffix('_deg')}"]
        wanted += [f"{mean_text} at {level:g}°" if mean_text in heading else mean_text for level, mean in means(axis).items()
                   if mean in (min(means(axis).values()), max(means(axis).values())) for mean_text in [arcseconds(mean)]]
        wanted = [text.replace("-", "−") for text in wanted]
    checks_.expect(all(text.split(" at ")[0] in heading for text in wanted), f"{report.name}: the heading {heading!r} lacks one of {wanted}")
    keys = page.evaluate("[...document.querySelectorAll('main, header')].map(e => e.innerText).join(' ')")
    shown = [key for key in ("drift.axis_final_rad", "latitude_deg", "/site/latitude_deg") if key in keys.split("earthtop study -")[0]
             and report.name in ("listed", "drawn")]
    checks_.expect(report.name == "listed" or not shown, f"{report.name}: keys in place of words: {shown}")


def many(page: devtools.Page, program: Program, report: Report, points: int, checks_: checks.Checks) -> None:
    """Cells: every point is in one of them, the means are the table's, and an example of each can be run."""
    data = page.evaluate(DATA)
    table = rows(report.page.parent)
    checks_.expect("points" not in data and len(data["pictures"]) == 6, f"{report.name}: {len(data.get('pictures', []))} pictures")
    for picture in data["pictures"]:
        name = data["quantities"][picture["quantity"]]
        count = sum(cell[2] for cell in picture["cells"])
        checks_.expect(count == points, f"{report.name}: {count} of {points} points in the cells")
        mean = sum(cell[2] * cell[3] for cell in picture["cells"]) / count
        true = math.fsum(float(row[name]) for row in table) / len(table)
        checks_.expect(math.isclose(mean, true, rel_tol=1e-9), f"{report.name}: mean of {name} {mean}, in the table {true}")
        if picture["up"] is not None:
            continue
        low, high, cells = (data["scales"][picture["quantity"]][key] for key in ("low", "high", "cells"))
        for i, j, number, _, example in picture["cells"]:
            place = (float(table[example][name]) - low) / (high - low) * cells
            checks_.expect(j - 1e-9 <= place <= j + 1 + 1e-9, f"{report.name}: the example of cell {i}, {j} ({number}) lies at {place}")
    checks_.expect(report.page.stat().st_size < 400_000, f"{report.name}: {report.page.stat().st_size} bytes")
    scenario_of_a_point(page, program, report, checks_)


def test(browser: devtools.Browser, program: Program, checks_: checks.Checks) -> None:
    points = 3000
    reports = [program.study_report("grid", program.write("grid.json", small_grid())),
               program.study_report("listed", program.write("listed.json", listed())),
               program.study_report("drawn", program.write("drawn.json", {**monte_carlo(40), "name": "drawn"})),
               program.study_report("many", program.write("many.json", {**monte_carlo(points), "name": "many"}))]
    for report in reports:
        page = browser.new_page()
        page.resize(1280)
        page.open(report.page.as_uri())
        if report.name == "many":
            many(page, program, report, points, checks_)
        else:
            same_bits(page, report, checks_)
            if report.name == "grid":
                keyboard(page, report, checks_)
                told = page.evaluate("document.querySelector('#explorer .outside').textContent")
                checks_.expect("1 point lies below the scale" in told, f"{report.name}: of the point far below the scale it says {told!r}")
                title = page.evaluate("document.querySelector('.subject').textContent")
                checks_.expect(title == HOSTILE, f"{report.name}: the title is {title!r}")
            found(page, report, checks_)
            scenario_of_a_point(page, program, report, checks_)
        for width in (1280, 820, 390):
            page.resize(width)
            page.frames(2)
            if report.name != "listed":  # whose curve is drawn above
                labels(page, checks_, f"{report.name} at {width} px", width)
            checks_.fits(page, f"{report.name} at {width} px")
        for fault in [*layout.phone_faults(page, False), *layout.tablet_faults(page)]:
            checks_.expect(False, f"{report.name}: {fault}")
        again(page, program, report, checks_)
        checks_.silent(page, report.page, report.name)
        page.close()


if __name__ == "__main__":
    checks.run(__doc__, test)
