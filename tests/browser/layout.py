# SPDX-License-Identifier: GPL-3.0-or-later
"""What a page must look like on a phone, on a tablet and on paper, measured in the browser."""

import collections
import pathlib
import re
import subprocess
import tempfile
from collections.abc import Iterator

import devtools

PHONE_PX = 390
TABLET_PX = 820
SMALLEST_TEXT_PX = 12.0
LEAST_FILLED = 0.6  # share of the printed height of each page but the last: figures are whole, so something may not fit
LEAST_OF_LAST = 0.04  # more than a line
PRINTED_DPI = 40
WHITE = 250

# Each visible text of each chart: its size on the screen, and whether it is cut or lies on another one.
TEXTS = """(() => {
    const faults = [], visible = e => e.checkVisibility() && e.getBoundingClientRect().width > 0;
    let count = 0;
    for (const svg of document.querySelectorAll('svg.et')) {
        if (!visible(svg)) continue;
        const frame = svg.getBoundingClientRect(), scale = frame.width / svg.viewBox.baseVal.width;
        const boxes = [];
        for (const text of svg.querySelectorAll('text')) {
            const box = text.getBoundingClientRect(), words = text.textContent.slice(0, 60);
            ++count;
            const size = parseFloat(getComputedStyle(text).fontSize) * scale;
            if (size < SMALLEST) faults.push(`${words}: ${size} px`);
            if (box.left < frame.left - 1 || box.right > frame.right + 1) faults.push(`${words}: cut off`);
            // A box is higher than its letters.
            const touches = b => box.left < b.right && b.left < box.right && box.top + 3 < b.bottom - 3 && b.top + 3 < box.bottom - 3;
            const other = boxes.find(([b]) => touches(b));
            if (other) faults.push(`${words}: lies on ${other[1]}`);
            boxes.push([box, words]);
        }
    }
    return [count, faults];
})()"""


def phone_faults(page: devtools.Page, expects_charts: bool) -> Iterator[str]:
    """Leaves the page at the width of a phone."""
    page.resize(PHONE_PX)
    page.evaluate("for (const e of document.querySelectorAll('details')) e.open = true")
    page.frames(2)
    width = page.evaluate("document.documentElement.scrollWidth")
    if width > PHONE_PX:
        wide = page.evaluate(f"""[...document.querySelectorAll('main *, header *')]
            .filter(e => e.getBoundingClientRect().right > {PHONE_PX} && !e.closest('.scroll, pre, svg'))
            .slice(0, 3).map(e => e.outerHTML.slice(0, 120))""")
        yield f"the page is {width} px wide on a phone of {PHONE_PX} px: {wide}"
    count, faults = page.evaluate(TEXTS.replace("SMALLEST", str(SMALLEST_TEXT_PX)))
    if faults:
        yield f"{len(faults)} labels on a phone: {faults[:6]}"
    if expects_charts and count < 5:
        yield f"only {count} labels in charts on a phone"
    boxes = page.evaluate("""[...document.querySelectorAll('table')].filter(t => {
        const box = t.closest('.scroll');
        return !box || box.getAttribute('role') !== 'region' || !box.getAttribute('aria-label') || box.tabIndex !== 0
            || !['auto', 'scroll'].includes(getComputedStyle(box).overflowX);
    }).length""")
    if boxes:
        yield f"{boxes} tables in no box that scrolls, has a name and takes the focus"


def tablet_faults(page: devtools.Page) -> Iterator[str]:
    """Leaves the page at the width of a tablet."""
    page.resize(TABLET_PX)
    page.frames(2)
    width = page.evaluate("document.documentElement.scrollWidth")
    if width > TABLET_PX:
        yield f"the page is {width} px wide on a tablet of {TABLET_PX} px"
    _, faults = page.evaluate(TEXTS.replace("SMALLEST", str(SMALLEST_TEXT_PX)))
    if faults:
        yield f"{len(faults)} labels on a tablet: {faults[:6]}"


def filled_shares(pdf: bytes) -> list[float]:
    """The share of each printed page's height, between its margins, that has ink or white between ink."""
    shares = []
    with tempfile.TemporaryDirectory(prefix="earthtop-print-") as directory:
        file = pathlib.Path(directory) / "page.pdf"
        file.write_bytes(pdf)
        subprocess.run(["pdftoppm", "-r", str(PRINTED_DPI), "-gray", file, file.with_suffix("")], check=True)
        for picture in sorted(file.parent.glob("*.pgm")):
            magic, width, height, most, data = picture.read_bytes().split(maxsplit=4)
            assert magic == b"P5" and most == b"255"
            columns, rows = int(width), int(height)
            data = picture.read_bytes()[-columns * rows:]
            inked = [row for row in range(rows) if min(data[row * columns:(row + 1) * columns]) < WHITE]
            margin = rows * 14 / 297
            shares.append(max(0.0, (inked[-1] + 1 - margin) / (rows - 2 * margin)) if inked else 0.0)
    return shares


def words_of(text: str) -> list[str]:
    return re.findall(r"[^\W\d_]{4,}", text)


def cut_figures(page: devtools.Page, pdf: bytes) -> Iterator[str]:
    """The charts whose words are not all on one of the printed pages; long titles of others may be shortened."""
    printed = subprocess.run(["pdftotext", "-raw", "-", "-"], input=pdf, capture_output=True, check=True).stdout.decode()
    pages = [collections.Counter(words_of(text)) for text in printed.split("\f")]
    for text in page.evaluate("""[...document.querySelectorAll('svg.et')].filter(svg => !svg.closest('.narrow, details'))
            .map(svg => [...svg.querySelectorAll('text')]
                .map(t => t.textContent).filter(t => t.length < 60).join(' '))"""):
        wanted = collections.Counter(words_of(text))
        if not any(wanted <= there for there in pages):
            yield f"a figure is cut on paper: {text[:80]}"


def print_faults(page: devtools.Page) -> Iterator[str]:
    pdf = page.pdf()
    if not pdf.startswith(b"%PDF-"):
        yield f"printed: {pdf[:20]!r}"
        return
    yield from cut_figures(page, pdf)
    shares = filled_shares(pdf)
    if not shares:
        yield "no printed page"
    for number, share in enumerate(shares[:-1], start=1):
        if share < LEAST_FILLED:
            yield f"printed page {number} of {len(shares)} is filled to {share:.0%}"
    if shares and shares[-1] < LEAST_OF_LAST:
        yield f"the last of {len(shares)} printed pages is filled to {shares[-1]:.0%}"
