// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that all parts share, and the start of every part that the page has. The files are joined into one script,
// and its functions are hoisted, so that the other files can use these.

/** Functions that redraw something, called when the colours change. */
const kRedraws = [];

/** The colours of page.css as plain strings, read once per change of theme. */
const kPalette = {};

function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const names = ["bg", "fg", "text", "muted", "line", "grid", "metal", "metal-dark", ...Object.keys(kDashes)];
  for (const name of names) kPalette[name] = style.getPropertyValue(`--${name}`).trim() || "#888";
}

function byId(id) { return document.getElementById(id); }

/** Text from the data may be hostile, so it is only ever set as textContent. */
function element(tag, className = "", text = "") {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== "") made.textContent = text;
  return made;
}

function drawnElement(tag, attributes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

function isNumber(value) { return typeof value === "number" && Number.isFinite(value); }

/** Whether there is a mouse, and so most likely a keyboard, too. */
const kHasPointer = window.matchMedia("(hover: hover)").matches;

/** A power of ten in raised digits: "10⁻⁷". */
function powerOfTen(exponent) { return `10${String(exponent).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit])}`; }

/** A number for the eye: "0.25", "5.5 × 10⁻⁷". */
function format(value, digits = 6) {
  if (typeof value === "string") return value;
  if (!isNumber(value)) return value === null || typeof value !== "object" ? "none" : JSON.stringify(value);
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 10 ** digits) return String(Number(value.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return Number(mantissa) === 1 ? powerOfTen(Number(exponent)) : `${Number(mantissa)} × ${powerOfTen(Number(exponent))}`;
}

function clamp(value, low, high) { return Math.min(high, Math.max(low, value)); }

/** Rounds down to 1, 2 or 5 times a power of ten. */
function roundDown(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  const lead = value / decade;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * decade;
}

/** Gives the canvas the resolution of the screen and draws, at once and at every change of size. More than two pixels
 *  per CSS pixel would cost time and show no more. */
function watch(canvas, draw) {
  const resize = () => {
    canvas.ratio = Math.min(2, window.devicePixelRatio || 1);
    canvas.width = Math.round(canvas.clientWidth * canvas.ratio);
    canvas.height = Math.round(canvas.clientHeight * canvas.ratio);
    draw();
  };
  new ResizeObserver(resize).observe(canvas);
  kRedraws.push(resize);
}

/** Clears the canvas and returns a drawing context in CSS pixels; null while the canvas is not shown. */
function penOf(canvas) {
  const pen = canvas.width && canvas.height ? canvas.getContext("2d") : null;
  if (!pen) return null;
  const ratio = canvas.ratio ?? 1;
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, canvas.width / ratio, canvas.height / ratio);
  pen.font = "13px system-ui, 'DejaVu Sans', sans-serif";
  pen.lineJoin = "round";
  return { pen, width: canvas.width / ratio, height: canvas.height / ratio };
}

function trace(pen, points) {
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x, y);
}

/** Draws a ring for the prediction or a dot for the motion, which can be told apart without their colours. */
function spot(pen, [x, y], radius, colour, ringWidth = 0) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = pen.strokeStyle = colour;
  pen.lineWidth = ringWidth;
  if (ringWidth) pen.stroke(); else pen.fill();
}

function startTheme() {
  const changed = () => { readPalette(); for (const redraw of kRedraws) redraw(); };
  const queries = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "(forced-colors: active)", "print"];
  for (const query of queries) window.matchMedia(query).addEventListener("change", changed);
  readPalette();
}

/** Makes a button copy the text before it. If the browser denies a page on disk the clipboard, the text is at least selected. */
function makeCopying(button) {
  const source = button.previousElementSibling, name = button.textContent;
  const say = (text) => {
    button.textContent = text;
    setTimeout(() => { button.textContent = name; }, 2500);
  };
  const select = () => {
    window.getSelection().selectAllChildren(source);
    say("Selected: now copy");
  };
  button.setAttribute("aria-live", "polite");
  button.addEventListener("click", () => {
    if (navigator.clipboard) navigator.clipboard.writeText(source.textContent.trim()).then(() => say("Copied"), select);
    else select();
  });
}

/** A link into the folded part opens it, and paper has all of it. */
function startFolds() {
  const openTo = (target) => {
    for (let at = target?.closest("details"); at; at = at.parentElement?.closest("details")) at.open = true;
  };
  const follow = () => {
    let id = "";
    try { id = decodeURIComponent(window.location.hash.slice(1)); } catch { /* no id of this page */ }
    const target = byId(id);
    if (!target) return;
    openTo(target);
    target.scrollIntoView();
  };
  for (const link of document.querySelectorAll("nav a"))
    link.addEventListener("click", () => openTo(byId(link.hash.slice(1))));
  window.addEventListener("hashchange", follow);
  if (window.location.hash) follow();
  let closed = [];
  window.addEventListener("beforeprint", () => {
    closed = [...document.querySelectorAll(":is(details.folded, .verdict details):not([open])")];
    for (const fold of closed) fold.open = true;
  });
  window.addEventListener("afterprint", () => { for (const fold of closed) fold.open = false; });
}

document.documentElement.classList.add("js");
window.earthtop = { frames: 0, fps: 0 };
startTheme();
for (const button of document.querySelectorAll("button.copy")) makeCopying(button);
// All digits of a number on demand, and what is copied has them with an exponent that programs read.
for (const number of document.querySelectorAll("data")) number.title ||= number.value;
const kData = unpacked(JSON.parse(byId("earthtop-data")?.textContent || "{}"));
for (const start of kStarts) start(kData);
startFolds();
