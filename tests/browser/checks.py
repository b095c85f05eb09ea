# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of single pages share: counted checks, and a browser with the program's pages."""

import argparse
import pathlib
import re
import sys
import tempfile
import time
from collections.abc import Callable

import devtools
from browser_process import Failure, Tab
from shipped_pages import Program

SKIPPED = 77  # SKIP_RETURN_CODE of ctest
SENTINEL = "window.hacked"  # set by a script that should not have run


RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"


def with_powers(text: str) -> str:
    """A number as a page writes it: "5.5e-07" is 5.5 × 10⁻⁷, "1e-07" 10⁻⁷."""
    mantissa, e, exponent = text.partition("e")
    if not e:
        return text
    power = "10" + "".join("⁻" if c == "-" else RAISED[int(c)] for c in str(int(exponent)))
    return power if mantissa == "1" else f"{mantissa} × {power}"


def powers_in(text: str) -> str:
    """A text in which all numbers are written so."""
    return re.sub(r"(?<![\w.])\d+(?:\.\d+)?e[-+]\d+", lambda found: with_powers(found[0]), text)


def number(text: str) -> float:
    """The number that a page writes so."""
    mantissa, times, power = text.replace("−", "-").rpartition(" × ")
    if not (power.startswith("10") and power[2:].strip("⁻" + RAISED) == "" and power[2:]):
        return float(power)
    exponent = int("".join("-" if c == "⁻" else str(RAISED.index(c)) for c in power[2:]))
    return (float(mantissa) if times else 1.0) * 10.0 ** exponent


class Checks:
    """Counts checks and keeps what failed."""

    def __init__(self) -> None:
        self.count = 0
        self.faults: list[str] = []

    def expect(self, holds: bool, text: str) -> bool:
        self.count += 1
        if not holds:
            self.faults.append(text if len(text) < 600 else text[:600] + " ...")
        return holds

    def silent(self, page: Tab, file: pathlib.Path, when: str) -> None:
        """No complaint, no dialogue, no request but for the page itself."""
        own = file.as_uri()
        others = [url for url in page.requests if url.split("#")[0] != own and not url.startswith(("data:", "blob:"))]
        self.expect(not page.complaints, f"{when}: complaints {page.complaints}")
        self.expect(not page.dialogs, f"{when}: dialogs {page.dialogs}")
        self.expect(not others, f"{when}: requests {others}")
        self.expect(page.evaluate(f"typeof {SENTINEL}") == "undefined", f"{when}: foreign script ran")

    def fits(self, page: Tab, when: str) -> None:
        """Nothing makes the page scroll sideways."""
        wide, room = page.evaluate("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
        self.expect(wide <= room, f"{when}: {wide} px wide in {room} px")


def main(description: str, test: Callable[[devtools.Browser, Program, Checks], None]) -> int:
    """Runs a test with the program that the command line names; its exit status is that of the process."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("earthtop", type=pathlib.Path)
    options = parser.parse_args()
    chromium = devtools.find_chromium()
    if not chromium:
        print("skipped: chromium is not found")
        return SKIPPED
    began, checks = time.monotonic(), Checks()
    with tempfile.TemporaryDirectory(prefix="earthtop-pages-", ignore_cleanup_errors=True) as directory:
        try:
            with devtools.Browser(chromium) as browser:
                test(browser, Program(options.earthtop, pathlib.Path(directory)), checks)
        except (Failure, OSError, RuntimeError) as failure:
            checks.expect(False, str(failure) or type(failure).__name__)
    for fault in checks.faults:
        print(f"  {fault}")
    print(f"{checks.count} checks, {len(checks.faults)} faults, {time.monotonic() - began:.1f} s")
    return 0 if checks.count and not checks.faults else 1


def run(description: str | None, test: Callable[[devtools.Browser, Program, Checks], None]) -> None:
    sys.exit(main(description or "", test))
