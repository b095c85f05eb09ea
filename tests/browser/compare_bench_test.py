#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the pages of comparisons and benchmarks in a real browser: the conclusion first and the same as in the terminal, only what
failed unless asked for; marks of a benchmark that say what they are by mouse, finger and keys, and none that looks like another.
$CHROMIUM may name the browser; status 77 if there is none.

usage: compare_bench_test.py PATH_OF_EARTHTOP
"""

import json
import math
import pathlib
from typing import Any

import checks
import devtools
from shipped_pages import SCENARIOS, Program

HOSTILE = "</script><img src=x onerror=window.hacked=1>'\"&"
READOUT = "document.querySelector('figure.chart .readout').textContent"
DATA = "JSON.parse(document.querySelector('#earthtop-data').textContent)"
SHOWN = "[...document.querySelectorAll('figure.chart svg.et')].find(e => e.checkVisibility())"


def compared(program: Program, checks_: checks.Checks, page: devtools.Page, new: str) -> None:
    """A comparison of the toy top with other results."""
    text = program.run("compare", "toy-top", new, statuses=(0, 1))
    document = json.loads(program.compare("toy-top", new))
    file = program.document_report(f"compare-{new}", "comparison", json.dumps(document)).page
    page.open(file.as_uri())
    lines = text.splitlines()
    conclusion = " ".join(document["conclusion"])
    said = " ".join(text.split()).split(" rows) ", 1)[1]  # the terminal's lines may end within a sentence
    checks_.expect(said.startswith(conclusion), f"{new}: the terminal says {said[:400]}, the document {conclusion}")
    headline = page.evaluate("document.querySelector('.headline').textContent")
    checks_.expect(headline == checks.powers_in(conclusion), f"{new}: the page says {headline}")
    quantities = document["pairs"][0]["quantities"]
    failed = [quantity for quantity in quantities if not quantity["passed"]]
    visible = page.evaluate("[...document.querySelectorAll('tbody tr')].filter(e => e.checkVisibility()).map(e => e.cells[1].firstElementChild?.title)")
    checks_.expect(visible == [quantity["name"] for quantity in failed], f"{new}: the page lists {visible[:5]} ... before it is asked")
    checks_.expect(sum("FAILED" in line for line in lines) >= len(failed) and not any(line.startswith("  ok") for line in lines),
                   f"{new}: the terminal lists what passed, too")
    everything = program.run("compare", "toy-top", new, "--all", statuses=(0, 1)).splitlines()
    checks_.expect(sum(line.startswith(("  ok", "  FAILED")) for line in everything) >= len(quantities), f"{new}: --all leaves some out")
    page.evaluate("[...document.querySelectorAll('details')].forEach(e => { e.open = true; })")
    page.frames(2)
    table = page.evaluate("""[...document.querySelectorAll('details tr')].filter(e => e.cells.length === 10)
        .map(e => [e.cells[1].firstElementChild?.title, e.querySelector('data')?.value])""")
    shown = {name: float(value) for name, value in table if value}
    for quantity in quantities:
        checks_.expect(shown.get(quantity["name"]) == quantity["largest_difference"],
                       f"{new}: {quantity['name']} is {shown.get(quantity['name'])}, in the document {quantity['largest_difference']}")
    titles = page.evaluate("[...document.querySelectorAll('figure.chart .wide .et-h')].map(e => e.textContent)")
    checks_.expect(not any("_" in title for title in titles), f"{new}: titles that are names: {titles}")
    if failed:
        worst = max((q for q in failed if not q["reason"]), key=lambda q: q["share_used"])
        checks_.expect(worst["name"] in headline and f"{len(failed)} of {len(quantities)} quantities" in headline, f"{new}: {headline}")
        checks_.expect(len(titles) > 0, f"{new}: nothing is drawn")
    for width in (1280, 820, 390):
        page.resize(width)
        checks_.fits(page, f"{new} at {width} px")
    checks_.silent(page, file, new)


def looks(page: devtools.Page) -> list[Any]:
    """The look of each line of the visible chart: colour, dashes, and the first mark's shape and filling."""
    return page.evaluate(f"""(() => {{
        const drawn = [...{SHOWN}.querySelector('g[clip-path]').children];
        const lines = [];
        for (const e of drawn) {{
            if (e.getAttribute('stroke-linecap')) lines.push({{ stroke: e.getAttribute('stroke'), dash: e.getAttribute('stroke-dasharray') }});
            else if (lines.length && !lines.at(-1).mark)
                lines.at(-1).mark = e.getAttribute('d').replace(/^M[-0-9. ]+?(?=m)/, '') + (e.getAttribute('fill') ? ' filled' : ' hollow');
        }}
        return lines;
    }})()""")


def bench(program: Program, checks_: checks.Checks, page: devtools.Page) -> None:
    document = json.loads(program.run("bench", SCENARIOS / "toy-top.json", "--duration", "2", "--repetitions", "1", "--json"))
    file = program.document_report("bench-page", "bench", json.dumps(document)).page
    scene = document["scenarios"][0]
    page.resize(1280)
    page.open(file.as_uri())
    lines = looks(page)
    families = {(entry["method"], entry["equations"], entry["precision"]) for entry in scene["entries"] if entry["seconds"] and entry["error"]}
    checks_.expect(len(lines) >= len(families), f"{len(lines)} lines of {len(families)} families")
    seen = [json.dumps(line, sort_keys=True) for line in lines]
    again = sorted({line for line in seen if seen.count(line) > 1})
    checks_.expect(not again, f"lines that look the same: {again}")
    dashless = [(line["stroke"], (line.get("mark") or "").split(" ")[0]) for line in lines if line["stroke"] != "currentColor"]
    methods = {entry["method"] for entry in scene["entries"]}
    checks_.expect(len(set(dashless)) == len(methods), f"{len(set(dashless))} looks of {len(methods)} methods")
    front = [k for k, line in enumerate(lines) if line["stroke"] == "currentColor"]
    checks_.expect(front == [len(lines) - 1], f"the front is line {front} of {len(lines)}")

    # Each mark says what it is, with the document's numbers.
    marks = page.evaluate(f"{DATA}.charts.bench0.marks")
    entries = sorted((entry for entry in scene["entries"] if entry["seconds"] and entry["error"]), key=lambda entry: entry["seconds"])
    checks_.expect(len(marks) == len(entries), f"{len(marks)} marks of {len(entries)} entries")
    floor = scene["reference"]["error"][f"{scene['compared_error']}_rad"]
    for (seconds, error, text), entry in zip(marks, entries):
        wanted = max(entry["error"][f"{scene['compared_error']}_rad"], floor)
        checks_.expect(seconds == entry["seconds"] and error == wanted, f"a mark at {seconds, error}, in the document {entry['seconds'], wanted}")
        said = [entry["method"], f"{checks.with_powers(f'{seconds:.3g}')} s", f"error {checks.with_powers(f'{error:.3g}')} rad"]
        tolerance = entry["relative_tolerance"]
        said += [f"tolerance {checks.with_powers(f'{tolerance:g}')}"] if tolerance else []
        checks_.expect(all(words in text for words in said), f"{text!r} does not say {said}")
    for width, touch in ((1280, False), (390, True)):
        page.resize(width)
        page.frames(2)
        checks_.fits(page, f"bench at {width} px")
        plot = page.evaluate(f"(c => c.{'narrow' if touch else 'plot'})({DATA}.charts.bench0)")
        page.evaluate(f"{SHOWN}.scrollIntoView({{ block: 'center' }})")
        box = page.evaluate(f"(r => [r.x, r.y, r.width])({SHOWN}.getBoundingClientRect())")
        scale = box[2] / plot["width"]
        for at in (0, len(marks) // 2, len(marks) - 1):
            def along(value: float, low: float, high: float) -> float:
                return (math.log10(value) - math.log10(low)) / (math.log10(high) - math.log10(low))
            x = plot["left"] + along(marks[at][0], plot["x_min"], plot["x_max"]) * (plot["right"] - plot["left"])
            y = plot["floor"] + along(marks[at][1], plot["y_min"], plot["y_max"]) * (plot["top"] - plot["floor"])
            drawn = page.evaluate(f"""[...{SHOWN}.querySelectorAll('g[clip-path] path')].some(e => {{
                const [, u, v] = /^M([-0-9.]+) ([-0-9.]+)m/.exec(e.getAttribute('d')) ?? [];
                return Math.hypot(u - {x}, v - {y}) < 0.1; }})""")
            checks_.expect(drawn, f"bench at {width} px: no mark is drawn at {x, y}, where mark {at} is found")
            (page.tap if touch else page.move)(box[0] + x * scale, box[1] + y * scale)
            page.frames(2)
            text = page.evaluate(READOUT)
            same_place = [mark[2] for mark in marks if math.dist(mark[:2], marks[at][:2]) < 1e-3 * marks[at][0]]
            checks_.expect(text == marks[at][2] or text in same_place, f"bench at {width} px: at mark {at} it says {text!r}, not {marks[at][2]!r}")
        legend, high = page.evaluate(f"""(svg => {{ const clip = svg.querySelector('clipPath rect'), texts = [...svg.querySelectorAll('text')],
            top = Math.min(...texts.filter(e => {sorted(methods)}.includes(e.textContent)).map(e => +e.getAttribute('y')));
            return [+clip.getAttribute('y') - top, +clip.getAttribute('height')]; }})({SHOWN})""")
        checks_.expect(0 < legend < 0.6 * high, f"bench at {width} px: a legend of {legend} px above a chart of {high} px")
        cut = page.evaluate(f"[...{SHOWN}.querySelectorAll('text')].map(e => e.textContent).filter(t => t.endsWith('\\u2026'))")
        checks_.expect(not cut, f"bench at {width} px: names are cut: {cut}")
    page.evaluate("document.querySelector('figure.chart').focus()")
    page.key("Home")
    checks_.expect(page.evaluate(READOUT) == marks[0][2], "Home does not tell the fastest mark")
    page.key("ArrowRight")
    checks_.expect(page.evaluate(READOUT) == marks[1][2], "ArrowRight does not tell the next mark")
    checks_.silent(page, file, "bench")

    # Methods of any name.
    for entry in scene["entries"][::3]:
        entry["method"] = HOSTILE + entry["method"]
    scene["scenario"] = HOSTILE
    file = program.document_report("hostile-bench-page", "bench", json.dumps(document)).page
    page.open(file.as_uri())
    page.evaluate("document.querySelector('figure.chart').focus()")
    for _ in range(6):
        page.key("ArrowRight")
    page.frames(2)
    checks_.expect(HOSTILE in page.evaluate("document.querySelector('main').textContent"), "a method's name is not shown as it is")
    checks_.silent(page, file, "hostile bench")


def planned(program: Program, checks_: checks.Checks, page: devtools.Page) -> None:
    """The heading of a plan has the document's standard error and its share of the value."""
    text = program.run("plan", SCENARIOS / "free-gyro.json", "--measure", "azimuth_deg", "--sigma", "0.05", "--every", "1", "--json")
    first = json.loads(text)["estimates"][0]
    page.open(program.document_report("plan-page", "plan", text).page.as_uri())
    heading = page.evaluate("document.querySelector('h1').textContent")
    share = 100 * first["standard_error"] / first["value"]
    wanted = (f"This measurement would tell the Earth's rate times sin(latitude) to ±{checks.with_powers(format(first['standard_error'], '.2g'))} "
              f"rad/s, {checks.with_powers(format(share, '.2g'))} % of its value.")
    checks_.expect(heading == wanted, f"the plan's heading is {heading!r}, not {wanted!r}")
    shown = page.evaluate("document.querySelector('header').innerText")
    checks_.expect("omega_sin" not in shown, f"a name in place of words: {shown[:300]}")


def test(browser: devtools.Browser, program: Program, checks_: checks.Checks) -> None:
    toy_top = json.loads((SCENARIOS / "toy-top.json").read_text())
    for name, changed in (("toy-top", toy_top), ("elsewhere", {**toy_top, "site": {**toy_top["site"], "latitude_deg": 46}}),
                          ("hostile", {**toy_top, "title": HOSTILE, "site": {**toy_top["site"], "latitude_deg": -20}})):
        program.run("run", program.write(f"{name}.json", changed), "--out", name, "--quiet")
    page = browser.new_page()
    for new in ("toy-top", "elsewhere", "hostile"):
        compared(program, checks_, page, new)
    bench(program, checks_, page)
    planned(program, checks_, page)
    page.close()


if __name__ == "__main__":
    checks.run(__doc__, test)
