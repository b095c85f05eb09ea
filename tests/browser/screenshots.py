#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the pages of `earthtop report` to be looked at, more runs among them than the tests open: each page at three
widths, light and dark, and printed on A4.
$CHROMIUM may name the browser; the printed pages need pdftoppm.

usage: screenshots.py PATH_OF_EARTHTOP OUT_DIRECTORY [PAGE.html ...]
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import devtools
from shipped_pages import SCENARIOS, Program, Report, shipped_pages

WIDTHS = (390, 820, 1280)  # px: a phone, a tablet, a desk
PRINTED_DPI = 60
MORE_RUNS = ("free-gyro", "hard/t08-gyrocompass", "sleeping-top-above-critical", "nesc-tumbling-brick", "rolling-ball",
             "southern-hemisphere", "ship-gyrocompass-turns")


def more_runs(program: Program) -> list[Report]:
    return [program.run_report(pathlib.Path(name).name, SCENARIOS / f"{name}.json", pathlib.Path(name).name) for name in MORE_RUNS]


def take(page: devtools.Page, name: str, file: pathlib.Path, out: pathlib.Path) -> None:
    page.resize(WIDTHS[-1])
    page.open(file.as_uri())
    for width in WIDTHS:
        page.resize(width)
        for dark in (False, True):
            page.emulate(dark=dark)
            page.frames(2)
            page.screenshot(out / f"{name}-{width}{'-dark' if dark else ''}.png")
    page.emulate()
    page.resize(WIDTHS[-1])
    printed = out / f"{name}.pdf"
    printed.write_bytes(page.pdf())
    subprocess.run(["pdftoppm", "-r", str(PRINTED_DPI), "-png", printed, out / f"{name}-print"], check=True)
    faults = page.complaints + page.dialogs
    print(f"{name}: {file.stat().st_size} bytes, {len(list(out.glob(f'{name}-print-*.png')))} printed pages"
          + (f"; {faults}" if faults else ""), flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("earthtop", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("pages", type=pathlib.Path, nargs="*")
    options = parser.parse_args()
    chromium = devtools.find_chromium()
    if not chromium:
        print("chromium is not found")
        return 1
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="earthtop-pages-") as directory:
        program = Program(options.earthtop, pathlib.Path(directory))
        reports = shipped_pages(program)
        files = [(report.name, report.page) for report in [*reports, *more_runs(program)]]
        files += [(page.stem, page.resolve()) for page in options.pages]
        with devtools.Browser(chromium) as browser:
            for name, file in files:
                page = browser.new_page()
                take(page, name, file, options.out)
                page.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
