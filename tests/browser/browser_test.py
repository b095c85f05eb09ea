#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the pages of `earthtop report` in a real browser: they load without an error, their controls work, text of others
is shown as text, they print, and can be used without a mouse. $CHROMIUM may name the browser; status 77 if there is none.

usage: browser_test.py PATH_OF_EARTHTOP [--screenshots DIRECTORY]
"""

import argparse
import collections
import dataclasses
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable
from typing import Any

import devtools
import first_screen
import layout
from browser_process import Failure
from shipped_pages import SCENARIOS, Program, Report

RUNS = ["toy-top", "foucault-pendulum", "sleeping-top-below-critical", "turntable", "ship-gyrocompass-turns"]
SKIPPED = 77  # SKIP_RETURN_CODE of ctest
PAGE_LIMIT = 450_000  # bytes without the data; each chart is drawn twice
FRAMES_PER_SECOND = 30
DRAGGED_PX = 80

# What a scenario's author may write; control characters may be shown as something else, so text is looked for in parts.
HOSTILE_PARTS = ["<script>alert(1)</script>\"'&", "</title><img src=x onerror=alert(2)>"]
HOSTILE_TITLE = "\u0007".join(HOSTILE_PARTS)
HOSTILE_PURPOSE = ("<!--<script></script><script>window.hacked=1</script>\u2028--><svg onload=window.hacked=2>"
                   "<img src=x onerror=window.hacked=3>")
HOSTILE_DIRECTORY = "x</title><img src=x onerror=alert(3)>\"'&#?%3C"  # one in another: the slash is in the path

GROUPS = {1: "loads in silence", 2: "first screen", 3: "sphere turns", 4: "animation", 5: "charts and keyboard",
          6: "foreign text is text", 7: "print, dark, reduced motion", 8: "accessible", 9: "phone, tablet and paper"}

SPHERE = "document.querySelector('canvas#sphere, #sphere canvas')"
PLAY = "document.querySelector('#play')"
CHARTS = "document.querySelectorAll('figure.chart')"
CURVES = "document.querySelectorAll('figure.chart[data-chart]')"  # the others are pictures of bars, nothing to read off
PROTOCOL = """(e => ({open: e.open, shown: e.querySelector('#section-provenance').checkVisibility()}))(document.querySelector('#section-protocol'))"""
MOST_BEFORE_PROTOCOL_PX = 4000  # on a phone
SCRIPT_LIKE = "script, img, iframe, object, embed, link, style, base, meta, [onerror], [onload]"


class Faults:
    """The faults found, by groups of checks."""

    def __init__(self) -> None:
        self.by_group: dict[int, list[str]] = collections.defaultdict(list)
        self.checks: collections.Counter[int] = collections.Counter()

    def expect(self, group: int, holds: bool, where: str, text: str) -> bool:
        self.checks[group] += 1
        if not holds:
            self.by_group[group].append(f"{where}: {text if len(text) < 600 else text[:600] + ' ...'}")
        return holds

    def print(self) -> bool:
        for group, title in GROUPS.items():
            found = self.by_group[group]
            verdict = f"{len(found)} FAULTS" if found else "ok" if self.checks[group] else "NOTHING CHECKED"
            print(f"{group} {title}: {self.checks[group]} checks, {verdict}")
        texts = [f"{group} {text}" for group in GROUPS for text in self.by_group[group]]
        print("".join(f"  {text}\n" for text in texts), end="")
        return not texts and all(self.checks[group] for group in GROUPS)


# --- the pages


def make_pages(program: Program, faults: Faults) -> list[Report]:
    """Makes all pages; one that cannot be made counts as a fault."""
    toy_top = json.loads((SCENARIOS / "toy-top.json").read_text())
    hostile_top = program.write("hostile.json", {**toy_top, "title": HOSTILE_TITLE, "purpose": HOSTILE_PURPOSE})
    elsewhere = program.write("elsewhere.json", {**toy_top, "site": {**toy_top["site"], "latitude_deg": 46}})
    study = json.loads((SCENARIOS / "studies/latitude.json").read_text())
    hostile_study = {key: value for key, value in study.items() if key != "figures"} | {
        "title": HOSTILE_TITLE, "purpose": HOSTILE_PURPOSE, "finding": HOSTILE_PURPOSE, "base": hostile_top.name}
    benches: list[str] = []

    def bench() -> Report:
        benches.append(program.run("bench", SCENARIOS / "toy-top.json", "--duration", "2", "--repetitions", "1",
                                   "--methods", "taylor,rkf78,dopri5", "--json"))
        return program.document_report("bench", "bench", benches[0])

    def hostile_bench() -> Report:
        document = json.loads(benches[0])  # measured once, it takes the longest
        for scenario in document["scenarios"]:
            scenario["title"] = HOSTILE_TITLE
        return program.document_report("hostile-bench", "bench", json.dumps(document), hostile=True)

    def comparison() -> Report:
        program.run("run", elsewhere, "--out", "elsewhere", "--quiet")
        return program.document_report("comparison", "comparison", program.compare("toy-top", "elsewhere"))

    def measurement() -> Report:
        measured = program.write("measured.csv", "t_s,azimuth_deg,azimuth_se_deg\n" + "".join(
            f"{t},{90 + 0.1 * (-1) ** t},0.1\n" for t in range(30)))
        return program.document_report("measurement", "measurement", program.run(
            "compare", SCENARIOS / "free-gyro.json", measured, "--estimate", "omega_sin_latitude_rad_s",
            "--estimate", "/release/azimuth_deg", "--json"))

    makers: list[Callable[[], Report]] = [
        *[lambda name=name: program.run_report(name, SCENARIOS / f"{name}.json", name) for name in RUNS],
        lambda: program.study_report("study", SCENARIOS / "studies/latitude.json"),
        comparison,
        measurement,
        bench,
        lambda: program.run_report("hostile-run", hostile_top, HOSTILE_DIRECTORY, hostile=True),
        lambda: program.study_report("hostile-study", program.write("hostile-study.json", hostile_study), hostile=True),
        lambda: program.document_report("hostile-comparison", "comparison",
                                        program.compare(HOSTILE_DIRECTORY, "elsewhere"), hostile=True),
        hostile_bench,
    ]
    reports = []
    for make in makers:
        try:
            report = make()
            if faults.expect(1, report.page.is_file(), report.name, f"no page {report.page}"):
                reports.append(report)
        except (RuntimeError, OSError, subprocess.TimeoutExpired, ValueError, KeyError, IndexError) as error:
            faults.expect(1, False, "page not made", str(error))
    return reports


# --- one page


class Examination:
    """The checks of one page, in an order in which none disturbs the next."""

    def __init__(self, page: devtools.Page, report: Report, faults: Faults) -> None:
        self.page = page
        self.report = report
        self._faults = faults

    def expect(self, group: int, holds: bool, text: str) -> bool:
        return self._faults.expect(group, holds, self.report.name, text)

    def examine(self, elements_of_kind: dict[str, int], screenshots: pathlib.Path | None) -> None:
        self.page.open(self.report.page.as_uri())
        self.loading()
        if self.report.kind == "run":
            self.headline()
            self.first_screen()
            if not self.report.hostile:
                self.animation()
            if self.exists(3, SPHERE):
                self.sphere()
        self.charts()
        self.keyboard()
        self.accessible()
        self.foreign_text(elements_of_kind)
        self.media(screenshots)
        self.phone_and_paper()
        self.silence()
        if self.report.kind == "run" and not self.report.hostile:
            self.reduced_motion()
            self.silence()

    def exists(self, group: int, element: str) -> bool:
        return self.expect(group, self.page.evaluate(f"!!{element}"), f"there is no {element}")

    def silence(self) -> None:
        self.expect(1, not self.page.complaints, f"complaints: {self.page.complaints}")
        self.expect(1 if not self.report.hostile else 6, not self.page.dialogs, f"dialogs: {self.page.dialogs}")
        own = self.report.page.as_uri()  # data: and blob: addresses are in the page, no request goes out
        others = [url for url in self.page.requests if url != own and not url.startswith(("data:", "blob:"))]
        self.expect(1, not others, f"requests: {others}")

    def loading(self) -> None:
        policy = self.page.evaluate("""(() => {
            const meta = document.querySelector('meta[http-equiv="Content-Security-Policy" i]');
            const script = document.querySelector('script, style');
            return meta && {content: meta.content, first: !script
                || !!(meta.compareDocumentPosition(script) & Node.DOCUMENT_POSITION_FOLLOWING)};
        })()""")
        if self.expect(1, policy is not None, "no Content-Security-Policy"):
            self.expect(1, policy["content"].startswith("default-src 'none'"), f"policy: {policy['content']}")
            self.expect(1, policy["first"], "the policy comes after a script or style, which it does not rule")
        page = self.report.page.read_bytes()
        data = re.findall(rb"<script\b[^>]*application/json[^>]*>(.*?)</script>", page, re.DOTALL)
        size = len(page) - sum(map(len, data))
        self.expect(1, size < PAGE_LIMIT, f"{size} bytes without the data, of {PAGE_LIMIT}")

    def headline(self) -> None:
        assert self.report.summary
        drift = self.report.summary["drift"]
        number = (drift.get("reliable") or {}).get("axis_rad")
        number = drift["axis_final_rad"] if number is None else number
        shown = self.page.evaluate("[...document.querySelectorAll(':is(h1, .headline) data[value]')]"
                                   ".map(e => [e.getAttribute('value'), e.textContent, e.checkVisibility()])")
        found = [text for value, text, visible in shown if visible and as_double(value) == number]
        self.expect(2, bool(found), f"title and headline have no visible <data value> of exactly {number!r}: {shown}")
        self.expect(2, all(re.search(r"\d", text) for text in found), f"title and headline show no number: {found}")

    def first_screen(self) -> None:
        assert self.report.summary
        found = list(first_screen.faults(self.page, self.report.summary))
        self.expect(2, not found, f"{found}")
        self.page.resize(devtools.WIDTH)
        folded = self.page.evaluate(PROTOCOL)
        self.expect(2, folded == {"open": False, "shown": False}, f"the protocol: {folded}")
        self.page.resize(layout.PHONE_PX)
        self.page.frames(2)
        place = self.page.evaluate("document.querySelector('#section-protocol').getBoundingClientRect().top + scrollY")
        self.expect(2, place <= MOST_BEFORE_PROTOCOL_PX, f"{place} px before the protocol on a phone")
        self.page.resize(devtools.WIDTH)
        # A link to a part of it opens it.
        self.page.evaluate("document.querySelector('nav a[href=\"#section-protocol\"]').click()")
        self.page.frames(2)
        opened = self.page.evaluate(PROTOCOL)
        self.expect(2, opened == {"open": True, "shown": True}, f"the protocol after a click on its link: {opened}")
        self.page.evaluate("document.querySelector('#section-protocol').open = false; location.hash = '#section-torques'")
        self.page.frames(3)
        self.expect(2, self.page.evaluate(PROTOCOL)["open"], "a link to a section of the protocol does not open it")

    def moves(self, milliseconds: int) -> bool:
        """Whether #time changes within the given time; returns as soon as it does."""
        return self.page.evaluate(f"""new Promise(done => {{
            const element = document.querySelector('#time');
            const read = () => element.value || element.textContent;
            const first = read(), end = performance.now() + {milliseconds};
            const look = () => read() !== first ? done(true)
                : performance.now() > end ? done(false) : requestAnimationFrame(look);
            look();
        }})""")

    def press_play(self) -> None:
        self.page.click(*self.page.middle(PLAY))

    def animation(self) -> None:
        if not (self.exists(4, "document.querySelector('#time')") and self.exists(4, PLAY)):
            return
        frames = 0.0
        for _ in range(2):  # the second time because the machine may have been busy, or the motion over
            if not self.moves(600):
                self.press_play()
            self.expect(4, self.moves(1000), "#time stands still while it plays")
            self.page.wait(2.2)
            frames = float(self.page.evaluate("window.earthtop?.fps") or 0)
            if frames >= FRAMES_PER_SECOND:
                break
        self.expect(4, frames >= FRAMES_PER_SECOND, f"{frames:g} pictures a second, not {FRAMES_PER_SECOND}")
        if self.moves(600):
            self.press_play()
            self.expect(4, not self.moves(500), "#play does not pause it")

    def sphere(self) -> None:
        if self.report.hostile and self.moves(600):  # of the others, animation() has paused it
            self.press_play()
        look = f"[JSON.stringify(window.earthtop.view), {SPHERE}.toDataURL()]"
        x, y = self.page.middle(SPHERE)
        self.page.frames(3)
        before = self.page.evaluate(look)
        self.page.frames(3)
        self.expect(3, self.page.evaluate(look) == before, "it changes by itself, paused and untouched")

        self.page.drag(x, y, x + DRAGGED_PX, y)
        self.page.frames(3)
        dragged = self.page.evaluate(look)
        self.expect(3, dragged[0] != before[0], f"the view is still {before[0]} after a drag")
        self.expect(3, dragged[1] != before[1], "the picture is the same after a drag")

        self.page.evaluate(f"{SPHERE}.focus()")
        self.expect(3, self.page.evaluate(f"document.activeElement === {SPHERE}"), "it cannot be focused")
        for _ in range(3):
            self.page.key("ArrowRight")
        self.page.frames(3)
        turned = self.page.evaluate(look)
        self.expect(3, turned[0] != dragged[0], f"the view is still {dragged[0]} after ArrowRight")
        self.expect(3, turned[1] != dragged[1], "the picture is the same after ArrowRight")

    def charts(self) -> None:
        opened = self.page.evaluate("""(() => {
            for (const e of document.querySelectorAll('details:not([open]) > summary')) e.click();
            return [...document.querySelectorAll('details')].filter(e => !e.open).length;
        })()""")
        self.expect(5, opened == 0, f"{opened} details do not open")
        self.page.frames(2)  # tables may be made when their details open
        rows = self.page.evaluate(f"[...{CHARTS}].map(e => [...(e.querySelector('details') ?? e.closest('section')).querySelectorAll('tr')]"
                                  ".filter(r => r.querySelector('td') && r.checkVisibility()).length)")
        for index, count in enumerate(rows):
            self.expect(5, count >= 2, f"chart {index} has a table of {count} rows")
        curves = self.page.evaluate(f"{CURVES}.length")
        if self.report.kind != "comparison":  # of which some have nothing to draw
            self.expect(5, curves > 0, "no figure.chart with data")
        for index in range(curves):
            self.readout(f"{CURVES}[{index}]", f"chart {index}")

    def readout(self, chart: str, name: str, group: int = 5) -> None:
        """Checks that the readout changes; before, it may say how to use it."""
        read = f"""(e => e && e.checkVisibility({{opacityProperty: true, visibilityProperty: true}})
                   ? e.textContent.trim() : '')({chart}.querySelector('.readout'))"""
        picture = f"""[...{chart}.querySelectorAll('svg, canvas')].sort((a, b) => b.clientWidth - a.clientWidth)[0]"""
        if not self.exists(group, picture):
            return
        self.page.move(1, 1)
        before = self.page.evaluate(read)
        self.page.move(*self.page.middle(picture))
        self.page.frames(2)
        pointed = self.page.evaluate(read)
        self.expect(group, pointed not in ("", before) and bool(re.search(r"\d", pointed)),
                    f"{name}: .readout is {pointed!r} under the mouse, {before!r} before")
        if self.page.evaluate(f"({chart}.focus(), document.activeElement === {chart})"):
            self.page.key("ArrowRight")
            self.page.frames(2)
            self.expect(group, self.page.evaluate(read) != pointed, f"{name}: .readout is the same after ArrowRight")

    def keyboard(self) -> None:
        """Presses Tab from the top of the page until the focus begins again, or more often than there are stops."""
        self.page.evaluate("document.activeElement?.blur(); scrollTo(0, 0);"
                           "getSelection().removeAllRanges(); document.body.tabIndex = -1; document.body.focus();"
                           "document.body.removeAttribute('tabindex'); window.stops = new Set()")
        limit = 10 + self.page.evaluate("document.querySelectorAll('a, button, input, select, textarea, summary,"
                                        "[tabindex], [contenteditable], canvas, svg, figure, table').length")
        for _ in range(limit):
            self.page.key("Tab")
            state = self.page.evaluate("""(() => {
                const now = document.activeElement;
                if (now && now === window.lastStop && now !== document.body)
                    return 'trap: ' + now.outerHTML.slice(0, 80);
                const again = !now || now === document.body || window.stops.has(now);
                window.stops.add(now);
                window.lastStop = now;
                return again && window.stops.size > 1 ? 'round' : '';
            })()""")
            if state:
                self.expect(5, state == "round", f"Tab does not get on: {state}")
                break
        else:
            self.expect(5, False, f"{limit} Tabs do not lead round the page")
        missed = self.page.evaluate(f"""(() => {{
            const stops = [...window.stops];
            const usable = e => e.checkVisibility({{visibilityProperty: true}}) && !e.disabled;
            const controls = [...document.querySelectorAll('button, canvas')].filter(usable)
                .filter(e => !stops.includes(e) && !e.closest('figure.chart'));
            const buttons = [...document.querySelectorAll('figure.chart button')].filter(usable)
                .filter(e => !stops.includes(e));
            // The summary of a chart's table is no way to the chart. (The chart itself may stand in details.)
            const charts = [...{CURVES}]
                .filter(c => !stops.some(e => c.contains(e) && !c.contains(e.closest('details, button'))));
            return [...controls, ...buttons, ...charts].map(e => e.cloneNode().outerHTML.slice(0, 100));
        }})()""")
        self.expect(5, not missed, f"not reached by Tab: {missed}")

    def foreign_text(self, elements_of_kind: dict[str, int]) -> None:
        """A hostile page has as many elements of these kinds as the honest one of its kind, which comes first."""
        count = self.page.evaluate(f"document.querySelectorAll('{SCRIPT_LIKE}').length")
        if not self.report.hostile:
            elements_of_kind.setdefault(self.report.kind, count)
            return
        honest = elements_of_kind.get(self.report.kind)
        self.expect(6, count == honest, f"{count} elements of {SCRIPT_LIKE}, {honest} in an honest page")
        self.expect(6, self.page.evaluate("document.querySelectorAll('img[src=x], [onerror], [onload]').length") == 0,
                    "foreign text became an element")
        self.expect(6, self.page.evaluate("window.hacked === undefined"), "foreign text was executed")
        if self.report.kind in ("run", "study"):
            text = self.page.evaluate("""(() => {
                const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
                let text = '';
                while (walker.nextNode())
                    if (!walker.currentNode.parentElement.closest('script, style, template'))
                        text += walker.currentNode.data;
                return text;
            })()""")
            for part in HOSTILE_PARTS:
                self.expect(6, part in text, f"the title is not shown as it is written: {part}")

    def media(self, screenshots: pathlib.Path | None) -> None:
        background = "getComputedStyle(document.body).backgroundColor"
        light = self.page.evaluate(background)
        if screenshots:
            self.page.move(1, 1)
            self.page.evaluate("for (const e of document.querySelectorAll('details')) e.open = false; scrollTo(0, 0)")
            self.page.screenshot(screenshots / f"{self.report.name}.png")
        self.page.emulate(dark=True)
        self.page.frames(2)
        self.expect(7, self.page.evaluate(background) != light, f"the background is {light}, light or dark")
        if screenshots:
            self.page.screenshot(screenshots / f"{self.report.name}-dark.png")
        self.page.emulate()

    def phone_and_paper(self) -> None:
        printed = list(layout.print_faults(self.page))
        self.expect(9, not printed, f"{printed}")
        # The explorer of a study draws on a canvas; a comparison may have nothing to draw.
        has_charts = self.page.evaluate(f"{CURVES}.length") > 0
        on_phone = list(layout.phone_faults(self.page, has_charts))
        self.expect(9, not on_phone, f"{on_phone}")
        for index in range(self.page.evaluate(f"{CURVES}.length")):
            self.readout(f"{CURVES}[{index}]", f"chart {index} on a phone", 9)
        on_tablet = list(layout.tablet_faults(self.page))
        self.expect(9, not on_tablet, f"{on_tablet}")
        self.page.resize(devtools.WIDTH)

    def reduced_motion(self) -> None:
        if not self.page.evaluate(f"!!document.querySelector('#time') && !!{PLAY}"):
            return  # said before
        self.page.emulate(reduced_motion=True)
        self.page.open(self.report.page.as_uri())
        self.expect(7, not self.moves(500), "plays by itself, though reduced motion is asked for")
        self.press_play()
        self.expect(7, self.moves(1000), "#play does not start it where reduced motion is asked for")

    def accessible(self) -> None:
        facts = self.page.evaluate("""(() => {
            const name = e => e.getAttribute('aria-label')
                || [...e.children].find(c => c.localName === 'title')?.textContent
                || (e.getAttribute('aria-labelledby') ?? '').split(/\\s+/)
                    .map(id => document.getElementById(id)?.textContent ?? '').join('');
            const pictures = [...document.querySelectorAll('canvas, svg')]
                .filter(e => !e.parentElement.closest('svg') && !e.closest('[aria-hidden=true]'));
            return {
                nameless: pictures.filter(e => !e.hasAttribute('role') || !name(e).trim())
                    .map(e => e.cloneNode().outerHTML.slice(0, 100)),
                language: document.documentElement.lang,
                title: document.title.trim(),
                headings: [...document.querySelectorAll('h1, h2, h3, h4, h5, h6')].map(e => +e.localName[1]),
            };
        })()""")
        self.expect(8, not facts["nameless"], f"without role or name: {facts['nameless']}")
        self.expect(8, bool(facts["language"]), "html has no lang")
        self.expect(8, bool(facts["title"]), "no title")
        levels = facts["headings"]
        self.expect(8, levels.count(1) == 1 and levels[0] == 1, f"not one h1, which comes first: {levels}")
        skips = [(a, b) for a, b in zip(levels, levels[1:]) if b > a + 1]
        self.expect(8, not skips, f"heading levels skipped: {skips}")
        controls = {"button", "link", "slider", "checkbox", "radio", "combobox", "listbox", "textbox", "searchbox",
                    "spinbutton", "switch", "tab", "menuitem", "disclosuretriangle"}
        unlabelled = [role for role, name in self.page.accessible_nodes()
                      if role.lower() in controls and not name.strip()]
        self.expect(8, not unlabelled, f"controls without a label: {unlabelled}")


def as_double(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("earthtop", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="DIRECTORY")
    options = parser.parse_args()
    chromium = devtools.find_chromium()
    if not chromium:
        print("skipped: chromium is not found")
        return SKIPPED
    if options.screenshots:
        options.screenshots.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that the browser is closed and nothing is left in /tmp

    began = time.monotonic()
    faults = Faults()
    with tempfile.TemporaryDirectory(prefix="earthtop-pages-", ignore_cleanup_errors=True) as directory:
        reports = make_pages(Program(options.earthtop, pathlib.Path(directory)), faults)
        made = time.monotonic()
        try:
            with devtools.Browser(chromium) as browser:
                print(f"{browser.version}, {len(reports)} pages, made in {made - began:.1f} s", flush=True)
                elements_of_kind: dict[str, int] = {}
                given_up = 0
                for report in reports:
                    page = browser.new_page()
                    try:
                        Examination(page, report, faults).examine(elements_of_kind, options.screenshots)
                    except Failure as failure:  # the other pages may still be fine
                        faults.expect(1, False, report.name, f"given up: {failure}; {page.complaints}")
                        given_up += 1
                    if given_up > 2:
                        raise Failure("three pages given up, the rest is left out")
                    page.close()
        except (Failure, OSError) as failure:
            faults.expect(1, False, "browser", str(failure) or type(failure).__name__)
    passed = faults.print()
    print(f"{'passed' if passed else 'FAILED'} in {time.monotonic() - began:.1f} s")
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
