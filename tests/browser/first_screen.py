# SPDX-License-Identifier: GPL-3.0-or-later
"""The first screen of a run's page, which a reader sees without scrolling, on a desk and on a phone: what drifts, by how much, and how sure that is, in
words that agree with summary.json."""

import math
import re
from collections.abc import Iterator
from typing import Any

import checks
import devtools

SCREENS = ((1280, 800), (390, 844))  # px
PER_RAD = {"degrees": 180 / math.pi, "arcseconds": 648000 / math.pi, "milliarcseconds": 648e6 / math.pi,
           "microarcseconds": 648e9 / math.pi}
SYMBOLS = {"°": "degrees", "″": "arcseconds", "milliarcsec": "milliarcseconds", "microarcsec": "microarcseconds"}
DURATIONS = {"a second": 1, "a minute": 60, "an hour": 3600, "a day": 86400}
UNITS_S = {"s": 1, "minutes": 60, "hours": 3600, "days": 86400}
MOST_DIGITS = 4

# The words that are wholly on the screen, as lines of elements; powers of ten as in numbers: 3.0e-9.
SEEN = """(() => {
    scrollTo(0, 0);
    const text = (element) => {
        const copy = element.cloneNode(true);
        for (const sup of copy.querySelectorAll('sup')) sup.textContent = '^' + sup.textContent;
        return copy.textContent.replace(/×10\\^(\\S?\\d+)/g, (_, e) => 'e' + e.replace('−', '-')).replace(/\\s+/g, ' ').trim();
    };
    const on_screen = (e) => {
        const box = e.getBoundingClientRect();
        return e.checkVisibility() && box.height > 0 && box.top >= 0 && box.bottom <= HEIGHT && box.left >= 0 && box.right <= WIDTH;
    };
    const seen = (selector) => [...document.querySelectorAll(selector)].filter(on_screen).map(text);
    const picture = document.querySelector('main figure').getBoundingClientRect();
    return {title: seen('h1'), sentence: seen('.headline'), verdict: document.querySelector('.verdict').className,
            trust: seen('.verdict summary, .verdict > p'), picture: Math.max(0, Math.min(HEIGHT, picture.bottom) - picture.top)};
})()"""


def significant(number: str) -> int:
    return len(re.sub(r"e.*|\D", "", number).lstrip("0"))


def expected(summary: dict[str, Any]) -> tuple[float, float, float] | None:
    """The number that the page tells, its bound (rad), and the time (s)."""
    drift, swing = summary["drift"], (summary.get("motion") or {}).get("swing") or {}
    known = drift.get("reliable") or {}
    if not known.get("at_s"):
        return None
    if "plane_rate_rad_s" in swing and drift["verdict"] == "reliable":
        reached = summary["outcome"]["reached_s"]
        return (abs(swing["plane_rate_rad_s"] - swing["apsidal_rate_rad_s"]) * reached,
                (swing["plane_rate_bound_rad_s"] + swing["apsidal_rate_bound_rad_s"]) * reached, reached)
    if known["axis_rad"] == 0 and known["attitude_rad"] > 0:
        return known["attitude_rad"], known["attitude_bound_rad"], known["at_s"]
    return known["axis_rad"], known["axis_bound_rad"], known["at_s"]


def title_faults(title: str, summary: dict[str, Any]) -> Iterator[str]:
    wanted, drift = expected(summary), summary["drift"]
    if wanted is None:
        if drift["verdict"] not in ("reliable", "noise_floor") and not title.endswith("axis is not known"):
            yield f"no drift is known, and the title is {title!r}"
        return
    rad, bound, at_s = wanted
    if rad == 0:
        if not re.search(r"^In \S+ \S+ nothing turns this \w+'s axis off course(; what comes later is not known)?$", title):
            yield f"nothing drifts, and the title is {title!r}"
        return
    agent = "the journey" if (summary.get("travel") or {}).get("reference") == "at_rest" else "the Earth"
    found = re.search(r"^In (?:(?P<words>an? \w+)|(?P<count>\S+) (?P<unit>\w+)) " + agent + r" turns this \w+'s "
                      r"(?:axis (?P<a>\S+) (?P<a_unit>\w+) off course|plane of swing by (?P<p>\S+) (?P<p_unit>\w+))(?P<rest>.*)$"
                      r"|^In (?P<t>\S+) s " + agent + r" turns this \w+ (?P<n>\S+) (?P<n_unit>\w+) about its axis$", title)
    if not found:
        yield f"the title does not say what drifts by how much: {title!r}"
        return
    seconds = float(found["t"]) if found["t"] else DURATIONS[found["words"]] if found["words"] else float(found["count"]) * UNITS_S[found["unit"]]
    if abs(seconds / at_s - 1) > 1e-3:
        yield f"the title speaks of {seconds} s, the summary of {at_s} s"
    if bool(found["p"]) != ("swing" in (summary.get("motion") or {})) or bool(found["n"]) != (drift["reliable"]["axis_rad"] == 0):
        yield f"the title tells another thing: {title!r}"
    number, unit = next((found[k], found[f"{k}_unit"]) for k in "pan" if found[k])
    in_unit, error = rad * PER_RAD[unit], bound * PER_RAD[unit]
    last = 10.0 ** -len(number.partition(".")[2]) if "." in number else 1.0
    if abs(float(number) - in_unit) > 0.5001 * last:
        yield f"the title says {number} {unit}, the summary {in_unit}"
    if significant(number) > MOST_DIGITS or significant(number) < min(MOST_DIGITS, math.log10(in_unit / max(error, 1e-300))):
        yield f"{number} {unit} ± {error}: too many digits, or too few"
    if drift["verdict"] == "reliable" and found["rest"]:
        yield f"a reliable drift is doubted: {title!r}"
    if drift["verdict"] != "reliable" and not found["rest"]:
        yield f"a drift that is {drift['verdict']} is told as a reliable one: {title!r}"


def trust_faults(seen: dict[str, Any], summary: dict[str, Any]) -> Iterator[str]:
    verdict, wanted = summary["drift"]["verdict"], expected(summary)
    text = " ".join(seen["trust"])
    if verdict not in seen["verdict"].split():
        yield f"the verdict's colour is that of {seen['verdict']!r}"
    if ("This number can be trusted" in text) != (verdict == "reliable"):
        yield f"{verdict}, and the page says {text!r}"
    if verdict != "reliable" and summary["drift"]["verdict_reason"] not in text:
        yield f"the reason is not in sight: {text!r}"
    if wanted is None:
        return
    found = re.search(r"± ([0-9.]+(?: × 10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?) ?(°|″|milliarcsec|microarcsec)", text)
    if not found:
        yield f"how sure it is does not stand there: {text!r}"
    elif abs(checks.number(found[1]) - wanted[1] * PER_RAD[SYMBOLS[found[2]]]) > 0.06 * checks.number(found[1]):
        yield f"the error is said to be {found[0]}, the summary's is {wanted[1]} rad"


def faults(page: devtools.Page, summary: dict[str, Any]) -> Iterator[str]:
    """Leaves the page at the size of a phone."""
    for width, height in SCREENS:
        page.resize(width)
        page.frames(2)
        seen = page.evaluate(SEEN.replace("HEIGHT", str(height)).replace("WIDTH", str(width)))
        for fault in here(seen, summary):
            yield f"at {width} x {height} px: {fault}"


def here(seen: dict[str, Any], summary: dict[str, Any]) -> Iterator[str]:
    if len(seen["title"]) != 1 or len(seen["sentence"]) != 1 or not seen["trust"]:
        yield f"not all on the screen: {seen}"
        return
    yield from title_faults(seen["title"][0], summary)
    yield from trust_faults(seen, summary)
    if seen["picture"] < 150 and summary["drift"]["verdict"] == "reliable":  # of others the reason takes room
        yield f"{seen['picture']} px of the first picture"
    if expected(summary) and expected(summary)[0] > 0 and not re.search(r"[0-9.]+ (km|m|mm|µm|nm)\b", seen["sentence"][0]):
        yield f"no length: {seen['sentence'][0]!r}"
