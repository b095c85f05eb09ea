#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts hostile texts into every file and key of a results directory, loads it with the Python package, and looks at what a notebook
would show. Pickles with flipped bits are loaded, too.

usage: PYTHONPATH=BUILD/tools/python notebook_test.py PROGRAM [--seed N] [--flips N] [--browser]

Each must hold:
  - what is loaded without checksums warns, and what is not what was written is refused;
  - HTML for a notebook has no elements and attributes but those of a headline, a list, an image and a table, and its image is data;
  - with --browser: in a page that nbconvert makes of it, no script of the hostile texts runs and nothing is loaded from elsewhere; a
    control page with the same texts as they are sets off the alarm (status 77 without nbconvert or Chromium);
  - a pickle with a flipped bit is refused, or holds equal data.
"""
import contextlib
import html.parser
import io
import json
import os
import pathlib
import pickle
import shutil
import sys
import tempfile
import warnings

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "browser"))

import earthtop as et
from attack import Attack

SKIPPED = 77
ELSEWHERE = "http://canary.invalid/"
ALARM = "window.hacked=(window.hacked||0)+1"
HOSTILE = [
    f"<script>{ALARM}</script>", f"<img src=x onerror='{ALARM}'>", f"</title></svg></div><svg onload=\"{ALARM}\">",
    f"\"><script>{ALARM}</script><b a=\"", f"'><img src={ELSEWHERE}a onerror={ALARM}>", f"--><iframe src=\"javascript:parent.{ALARM}\">",
    f"<details open ontoggle={ALARM}>", f"]]><style>@import '{ELSEWHERE}b';</style><script>{ALARM}</script>",
    f"<math href=javascript:{ALARM}><mtext></math><object data={ELSEWHERE}c>", f"&lt;script&gt;<body onload={ALARM}>",
    f"$$\\href{{javascript:{ALARM}}}{{x}}$$<script>{ALARM}</script>",
]
SVG = ('<svg xmlns="http://www.w3.org/2000/svg" width="10" height="10" onload="{alarm}"><script>{alarm}</script>'
       '<image href="{elsewhere}d"/><foreignObject><body xmlns="http://www.w3.org/1999/xhtml"><img src="x" onerror="{alarm}"/></body>'
       '</foreignObject><a href="javascript:{alarm}"><text>{text}</text></a></svg>')
SHOWN = {"div", "p", "b", "ul", "li", "img", "table", "thead", "tbody", "tr", "th", "td", "style"}  # pandas has styles
ATTRIBUTES = {("div", "class"), ("img", "alt"), ("img", "src"), ("table", "border"), ("table", "class"), ("tr", "style"),
              ("style", "scoped")}


class Markup(html.parser.HTMLParser):
    """What in a text is markup that no notebook should be given."""

    def __init__(self, text):
        super().__init__()
        self.foreign = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        if tag not in SHOWN:
            self.foreign.append(f"<{tag}>")
        for name, value in attributes:
            if (tag, name) not in ATTRIBUTES:
                self.foreign.append(f"<{tag} {name}>")
            elif name == "src" and not value.startswith("data:image/svg+xml;base64,"):
                self.foreign.append(f"src={value[:30]}")

    def handle_comment(self, text):
        self.foreign.append("a comment")


def strings_in(value, path=()):
    """The paths of all keys and values of a document that may be replaced by a text."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in items:
        yield (*path, key)
        yield from strings_in(one, (*path, key))


def put(document, path, text, as_key):
    place = document
    for step in path[:-1]:
        place = place[step]
    if as_key and isinstance(place, dict):
        place[text] = place.pop(path[-1])
    else:
        place[path[-1]] = text


class Notebooks(Attack):
    shown = []  # (kind, case, HTML) of all that a notebook would show

    def make(self, folder):
        """Two results, one of them on a table."""
        top = {"name": "top", "title": "A top", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
               "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                        "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
               "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 1, "output_step_s": 0.2},
               "numerics": {"ledger": "laboratory"}}
        (folder / "top.json").write_text(json.dumps(top))
        for name, latitude in (("good", 45), ("other", 46)):
            end = self.run("run", "top.json", "--out", name, "--quiet", "--set", f"/site/latitude_deg={latitude}", cwd=folder)
            if end.status != 0:
                raise SystemExit(end.err)
        self.folder = folder

    # Hostile directories ----------------------------------------------------------------------------------------------

    def documents(self, name):
        """Hostile forms of a JSON file, without its checksums."""
        good = json.loads((self.folder / "good" / name).read_text())
        for key in ("checksum", "files"):
            good.pop(key, None)
        for path in strings_in(good):
            for as_key in (False, True):
                changed = json.loads(json.dumps(good))
                put(changed, path, self.random.choice(HOSTILE), as_key)
                yield f"{'key ' if as_key else ''}/{'/'.join(map(str, path))}", json.dumps(changed, indent=2) + "\n"

    def tables(self, name):
        lines = (self.folder / "good" / name).read_text().splitlines()
        for row, column in [(row, self.random.randrange(lines[0].count(",") + 1)) for row in range(len(lines)) for _ in range(3)]:
            cells = [line.split(",") for line in lines]
            cells[row][column] = self.random.choice(HOSTILE).replace(",", ";")
            yield f"line {row + 1}, cell {column + 1}", "\n".join(map(",".join, cells)) + "\n"

    def pictures(self, _name):
        for number, text in enumerate(HOSTILE):
            escaped = text.replace("&", "&amp;").replace("<", "&lt;")
            yield f"picture {number}", SVG.format(alarm=ALARM, elsewhere=ELSEWHERE, text=escaped)
            yield f"text {number}", text

    def unsealed(self):
        """A copy of the good results without checksums."""
        work = self.folder / "work"
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(self.folder / "good", work)
        for name in ("summary.json", "timing.json"):
            document = json.loads((work / name).read_text())
            for key in ("checksum", "files"):
                document.pop(key, None)
            (work / name).write_text(json.dumps(document, indent=2) + "\n")
        return work

    def show(self, kind, case, make, text=""):
        """Looks at the HTML of something. An exception is no fault: a notebook shows its words as text."""
        try:
            markup = make()
        except Exception:  # pylint: disable=broad-except
            return
        foreign = Markup(markup).foreign
        self.shown.append((kind, case, markup, text))
        self.note(kind, case, [f"a notebook is given {', '.join(foreign[:4])}"] if foreign else [])

    def load(self, kind, case, directory, must_warn=True):
        """Loads results, or nothing where they are refused."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                result = et.load_result(directory)
            except (et.Error, KeyError, ValueError, TypeError, AttributeError):
                return None
        if must_warn:
            words = [str(one.message) for one in caught if one.category.__name__ == "UnverifiedWarning"]
            good = any("has no checksums" in one for one in words)
            self.note("loading without checksums warns", f"{kind}, {case}", [] if good else ["no warning"])
        return result

    def attack_directories(self):
        other = et.load_result(self.folder / "other")
        for name, forms in (("summary.json", self.documents), ("timing.json", self.documents), ("drift.svg", self.pictures),
                            ("trajectory.csv", self.tables), ("torques.csv", self.tables)):
            for case, text in forms(name):
                work = self.unsealed()
                (work / name).write_text(text, encoding="utf-8")
                result = self.load(name, case, work)
                if result is None:
                    continue
                self.show(f"{name}, result", case, result._repr_html_, text)
                self.show(f"{name}, rows", case, lambda: result.to_pandas()._repr_html_(), text)
                with contextlib.suppress(et.Error, KeyError, ValueError, TypeError, AttributeError):
                    result.save(self.folder / "sealed", force=True)  # with right checksums, which are no secret
                    again = self.load(name, case, self.folder / "sealed", must_warn=False)
                    self.show(f"{name}, with checksums", case, again._repr_html_, text)
                with contextlib.suppress(et.Error, KeyError, ValueError, TypeError, AttributeError):
                    compared = et.compare(other, result)
                    self.show(f"{name}, comparison", case, compared._repr_html_, text)
                    self.show(f"{name}, quantities", case, lambda: compared.quantities._repr_html_(), text)
        for case, text in enumerate(HOSTILE):
            changes = {"title": text, "purpose": text}
            top = et.load(self.folder / "top.json").changed(changes)
            self.show("scenario, run", f"text {case}", lambda: et.run(top)._repr_html_(), text)
            self.show("scenario, explanation", f"text {case}", lambda: et.explain(top)._repr_html_(), text)
            planned = lambda: et.plan(top, {"azimuth_deg": 0.01}, every_s=0.5)._repr_html_()
            self.show("scenario, plan", f"text {case}", planned, text)

    # Pickles ----------------------------------------------------------------------------------------------------------

    def attack_pickles(self):
        result, other = et.load_result(self.folder / "good"), et.load_result(self.folder / "other")
        whole = [("result", result, lambda one: one.__getstate__()),
                 ("comparison", et.compare(result, other), lambda one: (one.text, one.svg, one.junit))]
        for kind, made, content in whole:
            good, wanted = pickle.dumps(made), content(made)
            ends = [8 * at + bit for at in (*range(60), *range(len(good) - 120, len(good))) for bit in range(8)]
            for bit in ends + [self.random.randrange(8 * len(good)) for _ in range(self.options.flips)]:
                flipped = bytearray(good)
                flipped[bit // 8] ^= 1 << bit % 8
                self.note(f"pickle, {kind}", f"bit {bit % 8} of byte {bit // 8}", self.pickled(bytes(flipped), type(made), content, wanted))

    @staticmethod
    def pickled(text, kind, content, wanted):
        try:
            with contextlib.redirect_stderr(io.StringIO()):
                again = pickle.loads(text)
                return [] if isinstance(again, kind) and content(again) == wanted else ["other data"]
        except BaseException as error:  # pylint: disable=broad-except  # SystemExit, too, may be what a flipped name names
            return ["ended by an interrupt"] if isinstance(error, KeyboardInterrupt) else []

    # In a browser -----------------------------------------------------------------------------------------------------

    def attack_browser(self):
        try:
            import devtools
            import nbformat
            from nbconvert import HTMLExporter
        except ImportError as missing:
            print(f"not run: {missing}")
            sys.exit(SKIPPED)
        chromium = devtools.find_chromium()
        if not chromium:
            print("not run: there is no Chromium")
            sys.exit(SKIPPED)

        def page_of(name, outputs):
            cells = [nbformat.v4.new_code_cell("result", outputs=[nbformat.v4.new_output("display_data", {"text/html": one})])
                     for one in outputs]
            text, _ = HTMLExporter().from_notebook_node(nbformat.v4.new_notebook(cells=cells))
            file = self.folder / f"{name}.html"
            file.write_text(text, encoding="utf-8")
            return file

        def alarms(browser, file):
            page = browser.new_page()
            page.open(file.as_uri())
            page.wait(0.3)
            found = [f"{page.evaluate('window.hacked || 0')} scripts ran"] if page.evaluate("window.hacked || 0") else []
            found += [f"{url} is asked for" for url in page.requests if url.startswith(ELSEWHERE)]
            found += page.dialogs
            page.close()
            return found

        with devtools.Browser(chromium) as browser:
            for number, text in enumerate([*HOSTILE, *(text for _, text in self.pictures(""))]):
                found = alarms(browser, page_of("control", [f"<div>{text}</div>"]))
                if not found and "\\href" not in text:
                    raise SystemExit(f"the control page {number} sets off no alarm: {text}")
            kinds = {}
            for kind, case, markup, _ in self.shown:
                kinds.setdefault(kind, []).append((case, markup))
            for kind, cases in kinds.items():
                for first in range(0, len(cases), 50):
                    part = cases[first:first + 50]
                    found = alarms(browser, page_of("shown", [markup for _, markup in part]))
                    self.note(f"in a browser, {kind}", f"{part[0][0]} to {part[-1][0]}", found)


def main():
    def describe(parser):
        parser.add_argument("--flips", type=int, default=300, help="bits of each pickle that are flipped, beside those at its ends")
        parser.add_argument("--browser", action="store_true")

    attack = Notebooks(__doc__, describe)
    with tempfile.TemporaryDirectory() as temporary:
        attack.make(pathlib.Path(temporary))
        attack.attack_directories()
        attack.attack_pickles()
        if attack.options.browser:
            attack.attack_browser()
    attack.end()


if __name__ == "__main__":
    main()
