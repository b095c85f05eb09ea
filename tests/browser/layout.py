# SPDX-License-Identifier: GPL-3.0-or-later
"""What a page must look like on a phone, on a tablet and on paper, measured in the browser."""

import collections
import pathlib
import re
import subprocess
import tempfile
from collections.abc import Iterator

import devtools
from browser_process import Tab

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


# Contrast by WCAG 2 of each visible text against what lies behind it, of each curve of a chart and of each colour of the canvases against
# the page. Broad curves are let through, which lie behind others and are seen by their width, and so is what is disabled.
CONTRASTS = """(() => {
    const pen = Object.assign(document.createElement('canvas'), { width: 1, height: 1 }).getContext('2d', { willReadFrequently: true });
    const rgba = colour => {
        pen.clearRect(0, 0, 1, 1);
        pen.fillStyle = colour;
        pen.fillRect(0, 0, 1, 1);
        return [...pen.getImageData(0, 0, 1, 1).data];
    };
    const luminance = colour => rgba(colour).slice(0, 3).map(c => c / 255)
        .map(c => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const contrast = (a, b) => {
        const [x, y] = [luminance(a), luminance(b)].sort((p, q) => q - p);
        return (x + 0.05) / (y + 0.05);
    };
    const behind = e => {
        for (; e; e = e.parentElement) {
            const colour = getComputedStyle(e).backgroundColor;
            if (rgba(colour)[3] === 255) return colour;
        }
        return '#ffffff';
    };
    const faults = [], page = behind(document.body);
    let count = 0;
    const look = (what, least, ratio) => {
        ++count;
        if (ratio < least - 0.005) faults.push(`${what}: ${ratio.toFixed(2)}`);
    };
    for (const e of document.querySelectorAll('body *')) {
        if (!e.checkVisibility() || e.closest('svg, script, option, :disabled')) continue;
        const words = [...e.childNodes].filter(n => n.nodeType === 3).map(n => n.data.trim()).join('');
        if (words) look(words.slice(0, 40), TEXT, contrast(getComputedStyle(e).color, behind(e)));
    }
    for (const svg of document.querySelectorAll('svg.et')) {
        if (!svg.checkVisibility()) continue;
        for (const text of svg.querySelectorAll('text')) look(text.textContent, TEXT, contrast(getComputedStyle(text).fill, page));
        for (const line of svg.querySelectorAll('g[clip-path] [stroke]:not([stroke-opacity])'))
            look(`a curve ${line.getAttribute('stroke')}`, CURVE, contrast(getComputedStyle(line).stroke, page));
    }
    const root = getComputedStyle(document.documentElement);
    for (const name of ['axis', 'ref', 'gravity', 'coriolis', 'transverse', 'centrifugal', 'fit', 'precession'])
        look(`--${name}`, CURVE, contrast(root.getPropertyValue(`--${name}`).trim(), page));
    return [count, [...new Set(faults)]];
})()"""
LEAST_CONTRAST = 4.5
LEAST_OF_CURVES_IN_LIGHT = 2.2  # Okabe and Ito's orange; no curves differ by their colour alone


def contrast_faults(page: Tab, dark: bool) -> Iterator[str]:
    curves = LEAST_CONTRAST if dark else LEAST_OF_CURVES_IN_LIGHT
    count, faults = page.evaluate(CONTRASTS.replace("TEXT", str(LEAST_CONTRAST)).replace("CURVE", str(curves)))
    when = "in the dark" if dark else "in the light"
    if count < 10:
        yield f"only {count} texts and lines {when}"
    if faults:
        yield f"{len(faults)} contrasts {when} are too low: {faults[:6]}"


def desk_faults(page: devtools.Page) -> Iterator[str]:
    """Contrast on both backgrounds, and labels, at the width of a desk. Leaves the page in the light."""
    page.resize(devtools.WIDTH)
    for dark in (True, False):
        page.emulate(dark=dark)
        page.frames(2)
        yield from contrast_faults(page, dark)
    _, faults = page.evaluate(TEXTS.replace("SMALLEST", str(SMALLEST_TEXT_PX - 1)))
    if faults:
        yield f"{len(faults)} labels on a desk: {faults[:6]}"


def phone_faults(page: devtools.Page, expects_charts: bool) -> Iterator[str]:
    """Looks at the desk first, and leaves the page at the width of a phone."""
    yield from desk_faults(page)
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
