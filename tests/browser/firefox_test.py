#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the pages of `earthtop report`, and the page to play with, in Firefox, opened from disk: they are silent and ask for
nothing, draw at the width of a desk and of a phone, show the summary's numbers, answer to the keyboard and print.
$FIREFOX may name the browser; status 77 if there is none.

usage: firefox_test.py PATH_OF_EARTHTOP [--play PAGE.html] [--screenshots DIRECTORY]
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
import time

import firefox
import layout
import play_test
from browser_process import Failure
from checks import SKIPPED, Checks
from shipped_pages import Program, Report, shipped_pages

WIDTHS = (1280, 390)  # px
DRAGGED_PX = 80
SAME = "compare-same"  # nothing differs, and what does not differ is drawn on request only

PAINTED = """[...document.querySelectorAll('canvas')].filter(c => c.checkVisibility()).map(c => {
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [c.width, c.height];
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(c, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, c.width, c.height).data.buffer)).size; })"""
PATHS = "[...document.querySelectorAll('svg path')].filter(p => p.checkVisibility()).map(p => p.getAttribute('d') ?? '')"
LEAST_LABEL = """Math.min(...[...document.querySelectorAll('figure svg text')].filter(t => t.checkVisibility() && t.textContent)
    .map(t => parseFloat(getComputedStyle(t).fontSize) * Math.hypot(t.getScreenCTM().a, t.getScreenCTM().b)))"""


def examine(page: firefox.Page, report: Report, checks: Checks, out: pathlib.Path | None) -> None:
    page.open(report.page.as_uri())
    for width in WIDTHS:
        page.resize(width)
        when = f"{report.name} at {width} px"
        checks.fits(page, when)
        colours = page.evaluate(PAINTED)
        checks.expect(all(count > 10 for count in colours), f"{when}: canvases with {colours} colours")
        for fault in layout.contrast_faults(page, dark=False):
            checks.expect(False, f"{when}: {fault}")
        paths = page.evaluate(PATHS)
        checks.expect(bool(paths or colours) or report.name == SAME, f"{when}: nothing is drawn")
        checks.expect(not any("NaN" in path or "Infinity" in path for path in paths), f"{when}: a curve without numbers")
        if width < 600 and paths:
            checks.expect(page.evaluate(LEAST_LABEL) >= 11.9, f"{when}: labels of {page.evaluate(LEAST_LABEL)} px")
        if out:
            page.screenshot(out / f"{report.name}-firefox-{width}.png")
    page.resize(WIDTHS[0])
    if report.summary:
        run_page(page, report, checks)
    words = pdf_words(page.pdf())
    checks.expect(all(count > 20 for count in words), f"{report.name}: words on the printed pages: {words}")
    checks.silent(page, report.page, report.name)


def run_page(page: firefox.Page, report: Report, checks: Checks) -> None:
    assert report.summary
    drift = report.summary["drift"]
    wanted = (drift.get("reliable") or {}).get("axis_rad") or drift["axis_final_rad"]
    shown = page.evaluate("[...document.querySelectorAll(':is(h1, .headline) data[value]')].map(e => Number(e.value))")
    checks.expect(wanted in shown, f"{report.name}: {wanted!r} is not among the headline's numbers {shown}")
    clock = "(e => e.value || e.textContent)(document.querySelector('#time'))"
    before = page.evaluate(clock)
    page.evaluate("document.querySelector('#play').focus()")
    page.key(" ")
    page.wait(0.4)
    checks.expect(page.evaluate(clock) != before, f"{report.name}: the space bar does not start the animation")
    page.key(" ")
    page.evaluate("document.querySelector('#section-protocol').open = true")
    canvas = "document.querySelector('canvas#sphere, #sphere canvas')"
    x, y = page.middle(canvas)
    before = page.evaluate(f"{canvas}.toDataURL()")
    page.drag(x, y, x + DRAGGED_PX, y)
    page.frames(2)
    checks.expect(page.evaluate(f"{canvas}.toDataURL()") != before, f"{report.name}: the sphere does not turn")


def pdf_words(pdf: bytes) -> list[int]:
    """The number of words on each printed page."""
    text = subprocess.run(["pdftotext", "-", "-"], input=pdf, capture_output=True, check=True).stdout.decode()
    return [len(page.split()) for page in text.split("\f")[:-1]]


def play_page(page: firefox.Page, html: pathlib.Path, program: Program, checks: Checks, out: pathlib.Path | None) -> None:
    page.open(html.as_uri())
    play_test.settled(page)
    for fragment, part in play_test.HOSTILE:
        play_test.refused(page, fragment, part)
    for name in play_test.COMPARED:
        play_test.choose(page, name)
        play_test.numbers(page, program.earthtop, f"{name} in Firefox", program.directory / f"play-{name}")
        for width in WIDTHS:
            page.resize(width)
            page.wait(0.2)
            checks.fits(page, f"{name} at {width} px")
            colours = page.evaluate(PAINTED)
            checks.expect(len(colours) > 0 and all(count > 10 for count in colours), f"{name} at {width} px: {colours} colours")
            if out:
                page.screenshot(out / f"play-{name}-firefox-{width}.png")
        page.resize(WIDTHS[0])
    before = page.evaluate("document.querySelector('#scenario').textContent")
    page.evaluate("document.querySelector('#slider-latitude').focus()")
    page.key("ArrowRight")
    page.wait(0.5)
    checks.expect(page.evaluate("document.querySelector('#scenario').textContent") != before, "no answer to the keyboard")
    checks.silent(page, html, "the page to play with")
    checks.count += play_test.checks
    checks.faults += play_test.faults


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("earthtop", type=pathlib.Path)
    parser.add_argument("--play", type=pathlib.Path, metavar="PAGE.html")
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="DIRECTORY")
    options = parser.parse_args()
    path = firefox.find_firefox()
    if not path:
        print("skipped: Firefox is not found")
        return SKIPPED
    if options.screenshots:
        options.screenshots.mkdir(parents=True, exist_ok=True)
    began, checks = time.monotonic(), Checks()
    with tempfile.TemporaryDirectory(prefix="earthtop-pages-", ignore_cleanup_errors=True) as directory:
        program = Program(options.earthtop, pathlib.Path(directory))
        try:
            with firefox.Firefox(path) as browser:
                print(browser.version)
                for report in shipped_pages(program):
                    examine(browser.page, report, checks, options.screenshots)
                if options.play:
                    play_page(browser.page, options.play.resolve(), program, checks, options.screenshots)
        except (Failure, OSError, RuntimeError) as failure:
            checks.expect(False, str(failure) or type(failure).__name__)
    print("".join(f"  {fault}\n" for fault in checks.faults), end="")
    print(f"{checks.count} checks, {len(checks.faults)} faults, {time.monotonic() - began:.1f} s")
    return 0 if checks.count and not checks.faults else 1


if __name__ == "__main__":
    sys.exit(main())
