#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the page to play with in a real browser, opened from disk: its policy and size, that it is silent and asks for
nothing, its keyboard and labels, and that it shows the numbers that the program computes from the scenario it shows.
$CHROMIUM may name the browser; status 77 if there is none.

usage: play_test.py PATH_OF_EARTHTOP PAGE.html [--screenshots DIRECTORY]
"""

import argparse
import base64
import hashlib
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
from typing import Any

import devtools
from browser_process import Tab

SKIPPED = 77
SIZE_LIMIT = 3_000_000
WIDTHS = (390, 820, 1280)
HOSTILE = [(f"#{fragment}", part) for fragment, part in json.loads(
    (pathlib.Path(__file__).resolve().parents[1] / "play/hostile_links.json").read_text())]
LIMIT_MS = 300.0  # of processor time: twice what a shared machine takes for a move
MOVES = 40  # of a slider, timed
WARM_UP = 5
FIRST = "toy-top"
# Scenes of every kind that the program runs in a moment; engine_test.mjs has all of them.
COMPARED = ("toy-top", "foucault-pendulum", "free-gyro", "gyrocompass-in-gimbals", "dzhanibekov", "rolling-ball", "tippe-top",
            "rate-gyro-on-turntable", "tumbling-gyrostat")
PICTURES = ["top", "sphere"]

faults: list[str] = []
checks = 0


def expect(holds: bool, text: str) -> None:
    global checks
    checks += 1
    if not holds:
        faults.append(text[:500])


def policy(html: str) -> None:
    """The policy allows the hashes of the page's own scripts and style, WebAssembly, and nothing else."""
    def hashes(tag: str) -> str:
        return " ".join(f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
                        for text in re.findall(rf"<{tag}>(.*?)</{tag}>", html, re.DOTALL))
    wanted = (f"default-src 'none'; script-src {hashes('script')} 'wasm-unsafe-eval'; style-src {hashes('style')}; "
              "img-src data:; base-uri 'none'; form-action 'none'")
    found = re.search(r'Content-Security-Policy" content="([^"]*)"', html)
    expect(found is not None and found.group(1) == wanted, f"the policy is {found and found.group(1)}, not {wanted}")
    expect(len(re.findall(r"<script>", html)) == 2, "not two scripts")


def silence(page: devtools.Page, own: str, when: str) -> None:
    expect(not page.complaints, f"{when}: complaints {page.complaints}")
    expect(not page.dialogs, f"{when}: dialogs {page.dialogs}")
    others = [url for url in page.requests if url.split("#")[0] != own and not url.startswith(("data:", "blob:"))]
    expect(not others, f"{when}: requests {others}")


def settled(page: Tab) -> None:
    """Waits for the first answer, or for an error in words."""
    page.evaluate("""new Promise((done, fail) => { const end = performance.now() + 9000, look = () =>
        document.querySelector('#headline data') || !document.querySelector('#alert').hidden ? done()
            : performance.now() > end ? fail(new Error('no answer')) : setTimeout(look, 20); look(); })""")
    page.frames(3)


def program_summary(earthtop: pathlib.Path, command: str, directory: pathlib.Path) -> Any:
    """What the program gives for the text of the page, as a shell would read it."""
    found = re.fullmatch(r"earthtop run - --out play <<'EOF'\n(.*)\nEOF\nearthtop report play\n", command, re.DOTALL)
    expect(found is not None, f"not a command to paste: {command[:80]}")
    if not found:
        return None
    done = subprocess.run([earthtop, "run", "-", "--out", directory, "--quiet"], input=found.group(1), text=True,
                          capture_output=True, timeout=60, check=False)
    expect(done.returncode == 0, f"the program refuses the page's scenario: {done.stderr}")
    return json.loads((directory / "summary.json").read_text()) if done.returncode == 0 else None


def numbers(page: Tab, earthtop: pathlib.Path, name: str, directory: pathlib.Path) -> None:
    """The answer's digits: equal to the program's, or both within their bounds of each other."""
    alert = page.evaluate("document.querySelector('#alert').hidden ? '' : document.querySelector('#alert').textContent")
    expect(not alert, f"{name}: {alert}")
    summary = program_summary(earthtop, page.evaluate("document.querySelector('#scenario').textContent"), directory)
    if not summary or alert:
        return
    reliable = summary["drift"]["reliable"]
    at, drift, bound = page.evaluate("[...document.querySelectorAll('#headline data')].slice(0, 3).map(e => Number(e.value))")
    equal = (at, drift, bound) == (reliable["at_s"], reliable["axis_rad"], reliable["axis_bound_rad"])
    near = at == reliable["at_s"] and abs(drift - reliable["axis_rad"]) <= bound + reliable["axis_bound_rad"]
    print(f"{name}: {drift!r} rad, the program {reliable['axis_rad']!r}: {'equal' if equal else 'within bounds' if near else 'APART'}")
    expect(near, f"{name}: {at, drift, bound} on the page, {reliable} from the program")
    expect(page.evaluate("document.querySelector('#verdict strong').textContent") == summary["drift"]["verdict"].replace("_", " "),
           f"{name}: another verdict than {summary['drift']['verdict']}")


def draws(page: devtools.Page, name: str) -> None:
    for canvas in PICTURES:
        colours = page.evaluate(f"""(c => {{
            const copy = new OffscreenCanvas(c.width, c.height).getContext('2d', {{ willReadFrequently: true }});
            copy.drawImage(c, 0, 0);
            return new Set(new Uint32Array(copy.getImageData(0, 0, c.width, c.height).data.buffer)).size;
        }})(document.querySelector('#{canvas}'))""")
        expect(colours > 10, f"{name}: canvas {canvas} has {colours} colours")
    curves = page.evaluate("[...document.querySelectorAll('#drift-chart .wide svg g[clip-path] path')].map(e => e.getAttribute('d'))")
    expect(len(curves) >= 1 and all("L" in curve for curve in curves), f"{name}: the chart draws {curves}")
    expect(not any("NaN" in curve for curve in curves), f"{name}: NaN in the chart")
    drawn = page.evaluate("[...document.querySelectorAll('#drift-chart figcaption, .played')].map(e => e.textContent)")
    expect(len(drawn) == 3 and all("Drawn: the motion" in text or "drawn is its mean" in text for text in drawn),
           f"{name}: it is not said what is drawn: {drawn}")


def bands(page: devtools.Page, reply: Any) -> None:
    """Swings that are too fast for the picture are bands, the legend says so, and the largest angle is the summary's."""
    legend = page.evaluate("[...document.querySelectorAll('#drift-chart .wide svg text')].map(e => e.textContent)")
    expect(any("band: least to most" in text for text in legend), f"it is not said that there is a band: {legend}")
    most = page.evaluate("[...document.querySelectorAll('#drift-chart figcaption data')].map(e => Number(e.value))")
    expect(most == [reply["drift"]["axis_max_rad"], reply["drift"]["axis_max_at_s"]], f"at most {most}, not the summary's")


def keyboard(page: devtools.Page) -> None:
    """An arrow key on a slider changes setting, scenario and answer; the true Earth is left in words and out of the text."""
    read = "[document.querySelector('#scenario').textContent, document.querySelector('#headline data:nth-of-type(2)').value]"
    before = page.evaluate(read)
    page.evaluate("document.querySelector('#slider-latitude').focus()")
    page.key("ArrowRight")
    page.wait(1.0)
    after = page.evaluate(read)
    expect('"latitude_deg": 45.5' in after[0], "ArrowRight on the latitude is not in the scenario")
    expect(before[1] != after[1], "the answer is the same after ArrowRight on the latitude")
    expect(page.evaluate("document.querySelector('#slider-latitude').getAttribute('aria-valuetext')") == "45.5°",
           "the slider's value is not told in words")
    expect("rotation_rate" not in after[0], "a rate of the true Earth is written")
    expect(not page.evaluate("document.querySelector('#earth-banner').checkVisibility()"), "a banner on the true Earth")
    page.evaluate("document.querySelector('#slider-earth').focus()")
    page.key("End")
    page.wait(1.0)
    banner = page.evaluate("document.querySelector('#earth-banner').checkVisibility() && document.querySelector('#earth-banner').textContent")
    expect("10,000 times" in (banner or ""), f"the multiplied Earth is not stated: {banner}")
    expect('"rotation_rate_rad_s": 0.7292115' in page.evaluate("document.querySelector('#scenario').textContent"),
           "the multiplied Earth is not in the scenario")
    roles = {"button", "link", "slider", "checkbox", "combobox", "textbox", "disclosuretriangle"}
    nameless = [role for role, name in page.accessible_nodes() if role.lower() in roles and not name.strip()]
    expect(not nameless, f"controls without a name: {nameless}")


def magnification(page: devtools.Page) -> None:
    """The choice changes the words and both pictures; a factor that is too large is said to be limited."""
    words = page.evaluate("""(() => { const select = document.querySelector('select.magnification');
        const said = v => { select.value = v; select.dispatchEvent(new Event('change'));
            return [...document.querySelectorAll('.note')].map(e => e.textContent).join(' '); };
        return [said(1), said(500), said(10000)]; })()""")
    expect("not magnified" in words[0], f"once: {words[0]}")
    expect("500 times as large" in words[1] and "90°" not in words[1], f"500 times: {words[1]}")
    expect("10,000 times as large" in words[2] and "drawn as 90°" in words[2], f"10,000 times: {words[2]}")


def choose(page: Tab, name: str) -> None:
    page.evaluate(f"(e => {{ e.value = '{name}'; e.dispatchEvent(new Event('change')); }})(document.querySelector('#preset'))")
    page.wait(0.3)


def tab_order(page: devtools.Page) -> None:
    """The Tab key visits every control that is shown, in the order of the page, each with a ring that shows it."""
    wanted = page.evaluate("""[...document.querySelectorAll('a[href], button, select, input, summary, [tabindex="0"]')]
        .filter(e => e.checkVisibility() && !e.disabled).map((e, k) => (e.dataset.order = k, e.id || e.className || e.tagName))""")
    page.evaluate("document.querySelector('a.skip').focus({ focusVisible: true })")
    found, without = [], []
    for k in range(len(wanted)):
        if k > 0:
            page.key("Tab")
        at, ring = page.evaluate("""(e => { const s = getComputedStyle(e);
            return [Number(e.dataset.order ?? -1), s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) >= 1]; })(document.activeElement)""")
        found.append(at)
        if not ring:
            without.append(wanted[at])
    expect(found == list(range(len(wanted))), f"the Tab key visits {found} of {wanted}")
    expect(not without, f"no ring around {without}")


def camera(page: devtools.Page) -> None:
    """Keys, a mouse, a finger and two fingers turn and enlarge both pictures; the choice of speed is the clock's."""
    page.evaluate("document.querySelector('#play').textContent === 'Pause' && document.querySelector('#play').click()")
    picture = "document.querySelector('#sphere').toDataURL()"
    state = "document.querySelector('#sphere-state').textContent"

    def changes(what: str, act: Any) -> None:
        before = page.evaluate(picture)
        act()
        page.frames(3)
        expect(page.evaluate(picture) != before, f"{what} does not change the path's picture")

    page.evaluate("document.querySelector('#sphere').focus()")
    for key in ("ArrowLeft", "ArrowUp", "Home"):
        changes(key, lambda key=key: page.key(key))
    x, y = page.middle("document.querySelector('#sphere')")
    changes("a mouse", lambda: page.drag(x, y, x + 60, y + 10))
    page.resize(390)
    x, y = page.middle("document.querySelector('#sphere')")

    def fingers(*paths: tuple[float, float]) -> None:
        """One path for each finger: from and to, sideways from the middle."""
        for kind, part in (("touchStart", 0.0), ("touchMove", 0.5), ("touchMove", 1.0), ("touchEnd", None)):
            points = [] if part is None else [
                {"x": x + a + part * (b - a), "y": y, "id": k} for k, (a, b) in enumerate(paths)]
            page.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)

    changes("a finger", lambda: fingers((-40, 40)))
    page.wait(1.0)  # told once eye and motion have come to rest
    before = re.search(r"zoom [0-9.]+", page.evaluate(state))
    changes("two fingers", lambda: fingers((-30, -100), (30, 100)))
    page.wait(1.0)
    after = re.search(r"zoom [0-9.]+", page.evaluate(state))
    expect(bool(before and after) and before.group() != after.group(), f"the enlargement is not told: {before}, {after}")
    page.resize(1280)

    def pace() -> float:
        page.evaluate("((t) => { t.value = t.min; t.dispatchEvent(new Event('input')); })(document.querySelector('#time'))")
        page.evaluate("document.querySelector('#play').click()")
        first = page.evaluate("[performance.now(), Number(document.querySelector('#time').value)]")
        page.wait(0.8)
        last = page.evaluate("[performance.now(), Number(document.querySelector('#time').value)]")
        page.evaluate("document.querySelector('#play').click()")
        return 1000 * (last[1] - first[1]) / (last[0] - first[0])

    offered = page.evaluate("[...document.querySelector('select.speed').options].map(e => Number(e.value))")
    expect(len(offered) >= 3, f"speeds: {offered}")
    for speed in offered[:3]:
        page.evaluate(f"(s => {{ s.value = {speed}; s.dispatchEvent(new Event('change')); }})(document.querySelector('select.speed'))")
        found = pace()
        expect(abs(found / speed - 1) < 0.3, f"at speed {speed} the clock runs at {found}")


def tumbles(page: devtools.Page) -> None:
    """A body that turns over is drawn as one: along the motion its picture has the two sides of a box, not one shape."""
    choose(page, "dzhanibekov")
    page.evaluate("document.querySelector('#play').textContent === 'Pause' && document.querySelector('#play').click()")
    areas = page.evaluate("""(async () => { const t = document.querySelector('#time'), c = document.querySelector('#top'), found = [];
        for (let k = 0; k <= 40; ++k) { t.value = Number(t.min) + (k / 40) * (t.max - t.min); t.dispatchEvent(new Event('input'));
            await new Promise(requestAnimationFrame);
            const copy = new OffscreenCanvas(c.width, c.height).getContext('2d', { willReadFrequently: true });
            copy.drawImage(c, 0, 0);
            const count = {};
            for (const p of new Uint32Array(copy.getImageData(0, 0, c.width, c.height).data.buffer)) count[p] = (count[p] ?? 0) + 1;
            found.push(Object.values(count).sort((a, b) => b - a).slice(1, 4).reduce((a, b) => a + b)); } return found; })()""")
    expect(max(areas) > 1.5 * min(areas), f"the wing nut's faces do not change: {areas}")


def failures(browser: devtools.Browser, page: devtools.Page, own: str) -> None:
    """What cannot be computed is said in words, and the page works on; a page that cannot start says why."""
    choose(page, "toy-top")
    good = page.evaluate("document.querySelector('#headline').textContent")
    page.evaluate("""(s => { earthtop.play.took = 0; earthtop.play.values.tilt = 1e9; s.dispatchEvent(new Event('input')); })(document.querySelector('#slider-latitude'))""")
    page.wait(0.3)
    alert = page.evaluate("(e => [e.hidden, e.getAttribute('role'), e.textContent])(document.querySelector('#alert'))")
    expect(not alert[0] and alert[1] == "alert" and "/release/tilt_deg" in alert[2], f"a refused scenario: {alert}")
    expect(page.evaluate("document.querySelector('#results').classList.contains('stale')"), "old pictures are not marked")
    page.evaluate("document.querySelector('#reset').click()")
    page.wait(0.3)
    expect(page.evaluate("document.querySelector('#alert').hidden && !document.querySelector('#results').classList.contains('stale')"),
           "the alert stays")
    expect(page.evaluate("document.querySelector('#headline').textContent") == good, "another answer after the alert")
    for missing in ("DecompressionStream", "WebAssembly"):
        poor = browser.new_page()
        poor.call("Page.addScriptToEvaluateOnNewDocument", source=f"delete globalThis.{missing};")
        poor.open(own)
        poor.wait(1.0)
        text = poor.evaluate("document.querySelector('#alert').hidden ? '' : document.querySelector('#alert').textContent")
        expect("WebAssembly and DecompressionStream" in text, f"without {missing}: '{text}'")
        poor.close()


def reduced_motion(browser: devtools.Browser, own: str) -> None:
    """Whoever asks for less motion gets a picture that stands still until it is started."""
    for reduced in (False, True):
        page = browser.new_page()
        page.emulate(reduced_motion=reduced)
        page.open(own)
        settled(page)
        page.wait(0.5)
        word = page.evaluate("document.querySelector('#play').textContent")
        expect(word == ("Play" if reduced else "Pause"), f"reduced motion {reduced}: the button says {word}")
        page.close()


def refused(page: Tab, fragment: str, part: str) -> None:
    """A hostile link is refused in a sentence, nothing of it runs, and the page goes on with its first scene."""
    page.evaluate(f"(() => {{ document.querySelector('#link-alert').hidden = true; location.hash = {json.dumps(fragment)};"
                  "window.dispatchEvent(new Event('hashchange')); })()")
    page.evaluate("""new Promise(done => { const end = performance.now() + 3000, look = () => !document.querySelector('#link-alert').hidden ||
        performance.now() > end ? done() : setTimeout(look, 5); look(); })""")
    said, hidden = page.evaluate("(e => [e.textContent, e.hidden])(document.querySelector('#link-alert'))")
    expect(not hidden and part in said, f"{fragment}: {hidden}, '{said}'")
    expect(page.evaluate("window.hacked === undefined && ({}).hacked === undefined && !document.querySelector('img')"), f"{fragment}: foreign text ran")
    expect(page.evaluate("document.querySelector('#preset').value") == FIRST, f"{fragment}: not the first scene")
    expect(page.evaluate("document.querySelector('#headline data') !== null"), f"{fragment}: no answer")


def links(page: devtools.Page, own: str) -> None:
    """What the page gives as the link of a scene brings that scene back."""
    choose(page, "free-gyro")
    page.evaluate("(s => { s.value = 12.5; s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); })"
                  "(document.querySelector('#slider-latitude'))")
    page.wait(0.5)
    link, scenario = page.evaluate("[document.querySelector('#link').textContent, document.querySelector('#scenario').textContent]")
    expect(link == "#top=free-gyro&latitude=12.5", f"the link is {link}")
    page.open("about:blank")
    page.open(own + link)
    settled(page)
    expect(page.evaluate("document.querySelector('#scenario').textContent") == scenario, "the link brings another scene")
    expect(page.evaluate("document.querySelector('#link-alert').hidden"), "the page's own link is refused")
    button = page.evaluate("(e => [e.className, e.textContent])(document.querySelector('#link + button'))")
    expect(button == ["copy", "Copy the link"], f"no button copies the link: {button}")


def sheets(page: devtools.Page, own: str, directory: pathlib.Path) -> None:
    """Each sheet asks before it tells, and is one printed page."""
    shown = "s => [...document.querySelectorAll(s)].some(e => e.checkVisibility())"
    for level in ("school", "undergraduate", "laboratory"):
        page.open("about:blank")
        page.open(f"{own}#top=toy-top&latitude=30&sheet={level}")
        settled(page)
        expect(page.evaluate(f"({shown})('#section-sheet') && !({shown})('#headline, #results, #sheet .answer')"), f"{level}: the answer is shown first")
        expect(page.evaluate("document.querySelector('#predict').disabled"), f"{level}: it runs without a prediction")
        asked = page.pdf()
        page.evaluate("document.querySelector('#sheet input[type=radio]').click(); document.querySelector('#predict').click()")
        page.frames(2)
        expect(page.evaluate(f"({shown})('#headline') && ({shown})('#results') && ({shown})('#sheet .answer')"), f"{level}: no answer")
        said, number = page.evaluate("[document.querySelector('#sheet .answer').textContent, Number(document.querySelectorAll('#headline data')[1].value)]")
        plain = said.replace(" × 10", "e").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        told = [float(text) for text in re.findall(r"([0-9.e-]+) rad", plain)]
        expect(any(abs(one / number - 1) < 1e-3 for one in told), f"{level}: {number} is not in '{said}'")
        for name, pdf in ((f"sheet-{level}", asked), (f"sheet-{level}-told", page.pdf())):
            (directory / f"{name}.pdf").write_bytes(pdf)
            expect(len(re.findall(rb"/Type\s*/Page[^s]", pdf)) == 1, f"{name} is not one printed page")
        page.evaluate("document.querySelector('#close-sheet').click()")
        expect(page.evaluate(f"!({shown})('#section-sheet') && ({shown})('#headline')"), f"{level}: the sheet does not close")
    silence(page, own, "sheets")


def phone(browser: devtools.Browser, own: str) -> None:
    """At a phone's size with a finger: nothing is wider than the screen, a finger moves a slider, opens the sheet and predicts."""
    page = browser.new_page()
    page.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=2, mobile=True)
    page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    page.open(own)
    settled(page)
    expect(page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "wider than a phone")

    def touch(x: float, y: float, to: float | None = None) -> None:
        page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        if to is not None:
            for part in (0.5, 1.0):
                page.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x + part * (to - x), "y": y}])
        page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        page.wait(0.4)

    def tap(selector: str) -> None:
        page.evaluate(f"document.querySelector('{selector}').scrollIntoView({{ block: 'center' }})")
        page.wait(0.2)
        touch(*page.middle(f"document.querySelector('{selector}')"))

    before = page.evaluate("document.querySelector('#headline').textContent")
    page.evaluate("document.querySelector('#slider-latitude').scrollIntoView({ block: 'center' })")
    page.wait(0.2)
    x, y = page.middle("document.querySelector('#slider-latitude')")
    touch(x, y, x + 60)
    expect(page.evaluate("document.querySelector('#headline').textContent") != before, "a finger on a slider changes nothing")
    small = page.evaluate("""[...document.querySelectorAll('.play button, .play select, .play input[type=range]')].filter(e => e.checkVisibility())
        .map(e => [e.id || e.textContent, e.getBoundingClientRect().height]).filter(([, height]) => height < 24)""")
    expect(not small, f"too low for a finger: {small}")
    tap("#open-sheet")
    expect(page.evaluate("document.querySelector('#section-sheet').checkVisibility()"), "a finger does not open the sheet")
    expect(page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the sheet is wider than a phone")
    tap("#sheet .choice")
    tap("#predict")
    expect(page.evaluate("document.querySelector('#sheet .answer').checkVisibility()"), "a finger does not predict")
    silence(page, own, "on a phone")
    page.close()


def moves(page: devtools.Page) -> None:
    """How long it takes from a slider's move until the picture that it makes has been drawn."""
    def busy() -> float:
        """The processor time of the page's thread (s), which other work on the machine stretches less."""
        metrics = page.call("Performance.getMetrics")["metrics"]
        return float(next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration"))

    page.call("Performance.enable", timeDomain="threadTicks")
    before_s = busy()
    took = page.evaluate(f"""(async () => {{ const list = []; const s = document.querySelector('#slider-latitude');
        for (let k = 0; k < {WARM_UP + MOVES}; ++k) {{ earthtop.play.took = 0; s.value = 20 + k; const began = performance.now();
            s.dispatchEvent(new Event('input'));
            await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
            list.push([performance.now() - began, earthtop.play.took, earthtop.play.computed]); }} return list.slice({WARM_UP}); }})()""", timeout_s=120)
    busy_s = busy() - before_s
    picture, work, engine = (statistics.quantiles(column, n=4) for column in zip(*took))
    print(f"slider to picture, {len(took)} moves: median {picture[1]:.0f} ms, quartiles {picture[0]:.0f} and {picture[2]:.0f} ms, "
          f"least {min(took)[0]:.0f} and most {max(took)[0]:.0f} ms; of the median, work {work[1]:.0f} ms, of which engine {engine[1]:.0f} ms; "
          f"processor time of the page {1e3 * busy_s / (WARM_UP + MOVES):.0f} ms a move")
    expect(1e3 * busy_s < LIMIT_MS * (WARM_UP + MOVES), f"{1e3 * busy_s / (WARM_UP + MOVES):.0f} ms of processor time a move")


def look(page: devtools.Page, directory: pathlib.Path) -> None:
    for width in WIDTHS:
        for dark in (False, True):
            page.call("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1, mobile=width < 500)
            page.emulate(dark=dark)
            page.wait(0.4)
            expect(page.evaluate("document.documentElement.scrollWidth <= innerWidth"), f"wider than {width} px")
            page.call("Emulation.setDeviceMetricsOverride", width=width, height=800, deviceScaleFactor=1, mobile=False)
            height = page.evaluate("document.documentElement.scrollHeight")
            shot = page.call("Page.captureScreenshot", captureBeyondViewport=True,
                             clip={"x": 0, "y": 0, "width": width, "height": height, "scale": 1})
            (directory / f"play-{width}{'-dark' if dark else ''}.png").write_bytes(base64.b64decode(shot["data"]))
    page.emulate()
    (directory / "play.pdf").write_bytes(page.pdf())


def examine(browser: devtools.Browser, page: devtools.Page, html: pathlib.Path, earthtop: pathlib.Path, directory: pathlib.Path) -> None:
    own = html.as_uri()
    page.open("about:blank")
    page.open(own + HOSTILE[0][0])
    settled(page)
    for fragment, part in HOSTILE:
        refused(page, fragment, part)
    silence(page, own, "hostile links")
    page.open("about:blank")
    page.open(own)
    settled(page)
    names = page.evaluate("[...document.querySelector('#preset').options].map(e => e.value)")
    print(f"{len(names)} scenes")
    expect(names[0] == FIRST and set(COMPARED) <= set(names), f"scenes: {names}")
    for name in COMPARED:
        choose(page, name)
        numbers(page, earthtop, name, directory / name)
        draws(page, name)
    choose(page, "toy-top")
    bands(page, json.loads((directory / "toy-top/summary.json").read_text()))
    magnification(page)
    keyboard(page)
    page.evaluate("document.querySelector('#reset').click()")
    page.wait(0.3)
    tab_order(page)
    camera(page)
    tumbles(page)
    silence(page, own, "used")
    failures(browser, page, own)
    reduced_motion(browser, own)
    links(page, own)
    sheets(page, own, directory)
    phone(browser, own)
    choose(page, FIRST)
    moves(page)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("earthtop", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="DIRECTORY")
    options = parser.parse_args()
    chromium = devtools.find_chromium()
    if not chromium:
        print("skipped: chromium is not found")
        return SKIPPED
    html = options.page.resolve()
    size = html.stat().st_size
    print(f"{size} bytes")
    expect(size < SIZE_LIMIT, f"{size} bytes, of {SIZE_LIMIT}")
    policy(html.read_text())
    with tempfile.TemporaryDirectory(prefix="earthtop-play-") as directory, devtools.Browser(chromium) as browser:
        page = browser.new_page()
        examine(browser, page, html, options.earthtop.resolve(), pathlib.Path(directory))
        if options.screenshots:
            options.screenshots.mkdir(parents=True, exist_ok=True)
            look(page, options.screenshots)
    print(f"{checks} checks, {len(faults)} faults")
    print("".join(f"  {fault}\n" for fault in faults), end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
