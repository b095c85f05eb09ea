// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors, the camera and how it is turned, tracks of directions and attitudes over time. All in laboratory axes: East, North, Up.

const kRadian = Math.PI / 180;
const kHome = { azimuth_deg: -25, elevation_deg: 25, zoom: 1, whole: false };

/** At azimuth 0 the laboratory is seen from the South, with East to the right. The elevation raises the eye; Up stays up.
 *  `zoom` enlarges the sphere's frame, which is the path of the axis or, with `whole`, the sphere. */
const kView = { ...kHome };
const kViewers = [];
kStarts.push(() => { window.earthtop.view = kView; });

/** What both canvases show. The time: null (without an animation) stands for the last row. The magnification of the drift:
 *  `chosen` by the reader, or else the one that suits the data. `shows` are given new data, `followers` a new time. */
const kScene = { time: null, playing: false, chosen: null, suits: 1, shows: [], followers: [], changes: [] };

/** The magnifications to choose from; the one that suits a smaller drift may be larger. */
const kMagnifications = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];
const kShownDrift = 0.3;  // size (rad) to which the largest drift is magnified unless another magnification is chosen

function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
function combine(a, p, b, q) { return [a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]]; }
function times(a, p) { return [a * p[0], a * p[1], a * p[2]]; }
function size(a) { return Math.hypot(a[0], a[1], a[2]); }

/** The unit vector along a; null for the zero vector and if numbers are missing. */
function normalise(a) {
  const length = a && a.length === 3 && a.every(isNumber) ? size(a) : 0;
  return length > 0 ? times(1 / length, a) : null;
}

/** Uses the cross product, because the arc cosine loses half the digits of a small angle. */
function angleBetween(a, b) { return Math.atan2(size(cross(a, b)), dot(a, b)); }

/** The camera's directions right, up and towards the eye in laboratory axes; (right . p, up . p) is the orthographic
 *  projection of p. */
function camera() {
  const a = kView.azimuth_deg * kRadian, e = kView.elevation_deg * kRadian;
  return {
    right: [Math.cos(a), Math.sin(a), 0],
    up: [-Math.sin(e) * Math.sin(a), Math.sin(e) * Math.cos(a), Math.cos(e)],
    eye: [Math.cos(e) * Math.sin(a), -Math.cos(e) * Math.cos(a), Math.sin(e)],
  };
}

function turn(azimuth_deg, elevation_deg, factor = 1) {
  kView.azimuth_deg = ((kView.azimuth_deg + azimuth_deg + 540) % 360) - 180;
  kView.elevation_deg = clamp(kView.elevation_deg + elevation_deg, -90, 90);
  kView.zoom = clamp(kView.zoom * factor, 0.1, 1000);
  for (const viewer of kViewers) viewer();
}

/** Shows the whole sphere or only the path of the axis, with the picture as large as it fits. */
function frameWhole(whole) {
  Object.assign(kView, { whole, zoom: 1 });
  turn(0, 0);
}

/** Turns by dragging, zooms by two fingers. A finger that begins upwards or downwards scrolls the page (touch-action); one
 *  that begins sideways turns, and may then move in any direction. */
function turnByPointer(canvas) {
  // Movements are differences of positions, because movementX is in other units, or zero, in some browsers.
  const held = new Map();
  const spread = () => {
    const [[x, y], [u, v]] = [...held.values()];
    return Math.max(1, Math.hypot(x - u, y - v));
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const apart = held.size === 2 ? spread() : 0;
    held.set(event.pointerId, [event.clientX, event.clientY]);
    if (held.size === 1) turn((before[0] - event.clientX) / 2, (event.clientY - before[1]) / 2);
    else if (apart) turn(0, 0, spread() / apart);
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    canvas.addEventListener(end, (event) => held.delete(event.pointerId));
  // Two fingers on a touchpad; the wheel alone scrolls the page.
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;
    turn(0, 0, Math.exp(-event.deltaY / 100));
    event.preventDefault();
  }, { passive: false });
}

function makeTurnable(canvas) {
  canvas.tabIndex = 0;
  turnByPointer(canvas);
  const keys = {
    ArrowLeft: [5, 0], ArrowRight: [-5, 0], ArrowUp: [0, -5], ArrowDown: [0, 5],
    "+": [0, 0, 1.25], "=": [0, 0, 1.25], "-": [0, 0, 0.8], Home: [0, 0], w: [0, 0],
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    if (event.key === "Home") Object.assign(kView, kHome);
    if (event.key === "w") Object.assign(kView, { whole: !kView.whole, zoom: 1 });
    turn(...keys[event.key]);
    event.preventDefault();
  });
}

/** A unit vector over time. Between rows it is a cubic through the four nearest rows, projected onto the sphere; if
 *  neighbouring rows are more than 60 degrees apart, where a cubic could make loops, it is the great circle. */
function makeTrack(moments, numbers) {
  const count = Math.min(moments?.length ?? 0, Math.floor((numbers?.length ?? 0) / 3));
  const rows = Array.from({ length: count }, (_, i) => normalise(numbers.slice(3 * i, 3 * i + 3)));
  const slope = (i) => {
    const from = rows[i - 1] ? i - 1 : i, to = rows[i + 1] ? i + 1 : i;
    const step = moments[to] - moments[from];
    return step > 0 ? combine(1 / step, rows[to], -1 / step, rows[from]) : [0, 0, 0];
  };
  const at = (time) => {
    if (count === 0) return null;
    const i = rowBefore(moments, time, count), step = moments[i + 1] - moments[i];
    const p = rows[i], q = rows[i + 1];
    if (!(step > 0)) return p;
    const u = clamp((time - moments[i]) / step, 0, 1), v = 1 - u;
    if (u === 0 || u === 1) return u === 0 ? p : q;
    if (!p || !q) return null; // next to a missing row nothing is interpolated
    if (dot(p, q) < 0.5) {
      const angle = angleBetween(p, q);
      return normalise(combine(Math.sin(v * angle), p, Math.sin(u * angle), q)) ?? p;
    }
    const ends = combine(v * v * (1 + 2 * u), p, u * u * (1 + 2 * v), q);
    const slopes = combine(u * v * v * step, slope(i), -u * u * v * step, slope(i + 1));
    return normalise(combine(1, ends, 1, slopes)) ?? p;
  };
  return { count, at, moments, first: moments?.[0] ?? 0, last: moments?.[count - 1] ?? 0 };
}

/** The last row that is not later than `time` and has a row after it. */
function rowBefore(moments, time, count) {
  let low = 0, high = count - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (moments[middle] <= time) low = middle; else high = middle;
  }
  return low;
}

/** An attitude over time, as quaternions (w, x, y, z) that take body axes to laboratory axes; between rows the shortest way. */
function makeAttitude(moments, numbers) {
  const count = Math.min(moments?.length ?? 0, Math.floor((numbers?.length ?? 0) / 4));
  const row = (i) => numbers.slice(4 * i, 4 * i + 4);
  const at = (time) => {
    if (count < 2) return count ? row(0) : null;
    const i = rowBefore(moments, time, count), step = moments[i + 1] - moments[i], p = row(i), q = row(i + 1);
    const u = step > 0 ? clamp((time - moments[i]) / step, 0, 1) : 0;
    const same = p.reduce((sum, x, k) => sum + x * q[k], 0) >= 0 ? 1 : -1;
    const mixed = p.map((x, k) => (1 - u) * x + same * u * q[k]), length = Math.hypot(...mixed);
    return length > 0 ? mixed.map((x) => x / length) : null;
  };
  return { count, at };
}

/** A body's vector in laboratory axes. */
function turnedBy([w, x, y, z], vector) {
  const u = [x, y, z], t = times(2, cross(u, vector));
  return combine(1, combine(1, vector, w, t), 1, cross(u, t));
}

/** The rotation by `angle` (rad) about the unit vector `about`, of a vector. */
function rotated(vector, about, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return combine(1, combine(c, vector, s, cross(about, vector)), (1 - c) * dot(about, vector), about);
}

/** The smallest rotation that takes one unit vector to another, as a function of vectors. */
function carrier(from, to) {
  const about = normalise(cross(from, to)), angle = angleBetween(from, to);
  return (vector) => (about ? rotated(vector, about, angle) : vector);
}

/** Whether the axis would be drawn more than a right angle from the prediction: it is then drawn at a right angle. */
function isLimited(ref, axis, magnification) {
  return magnification > 1 && !!ref && !!axis && magnification * angleBetween(ref, axis) > Math.PI / 2;
}

/** The prediction, turned in the direction of the drift by `magnification` times its angle, or by a right angle at most. */
function magnified(ref, axis, magnification) {
  if (!ref || !axis || magnification === 1) return axis;
  const about = normalise(cross(ref, axis)), angle = magnification * angleBetween(ref, axis);
  return about ? rotated(ref, about, Math.min(angle, Math.PI / 2)) : ref;
}

function magnification() { return kScene.chosen ?? kScene.suits; }

/** The magnification that makes the largest drift visible: 1, 2 or 5 times a power of ten. */
function suitableMagnification(axis, ref) {
  let largest = 0;
  for (const time of axis.moments ?? []) {
    const p = axis.at(time), q = ref.at(time);
    if (p && q) largest = Math.max(largest, angleBetween(p, q));
  }
  return largest > 0 && largest < kShownDrift ? roundDown(kShownDrift / largest) : 1;
}

function timesText(factor) { return factor === 1 ? "at its true size" : `${factor.toLocaleString("en")} times as large`; }

/** A sentence on how the drift is drawn, and where it would be too large for that. */
function magnificationText(axis, ref) {
  const factor = magnification();
  if (factor === 1) return "The drift is drawn as large as it is, not magnified.";
  const from = (axis.moments ?? []).find((time) => isLimited(ref.at(time), axis.at(time), factor));
  return `The drift is drawn ${factor.toLocaleString("en")} times as large as it is.` +
    (from === undefined ? "" : ` Where that would be more than 90°, first at ${format(from, 4)} s, it is drawn as 90°.`);
}

/** Adds the choice of the magnification, the same one at both canvases. */
function addMagnification(controls) {
  const label = element("label", "", "Drift drawn "), select = element("select", "magnification");
  label.append(select);
  controls.append(label);
  select.addEventListener("change", () => {
    kScene.chosen = Number(select.value);
    for (const change of kScene.changes) change();
  });
  kScene.changes.push(() => {
    const list = [...new Set([...kMagnifications, kScene.suits, magnification()])].sort((a, b) => a - b);
    if (list.length !== select.length || list.some((factor, i) => Number(select[i].value) !== factor))
      select.replaceChildren(...list.map((factor) => new Option(timesText(factor), factor)));
    select.value = magnification();
  });
}

/** The row of controls that follows a canvas; made where the page has none. */
function controlsOf(canvas) {
  const there = canvas.parentElement.querySelector(".controls");
  if (there) return there;
  const made = element("div", "controls");
  canvas.after(made);
  return made;
}

/** Directions at every row and at times between the rows, about `wanted` in all (one to eight for each interval). */
function samplePath(track, direction, wanted = 4000) {
  const between = clamp(Math.round(wanted / Math.max(1, track.count)), 1, 8);
  const path = [];
  for (let i = 0; i + 1 < track.count; ++i) {
    const step = (track.moments[i + 1] - track.moments[i]) / between;
    for (let k = 0; k < between; ++k) path.push(direction(track.moments[i] + k * step));
  }
  if (track.count) path.push(direction(track.last));
  return path;
}

function legend(entries) {
  const list = element("ul", "legend");
  for (const [name, text] of entries) {
    const swatch = drawnElement("svg", { viewBox: "0 0 36 10", "aria-hidden": "true" });
    const line = drawnElement("path", { d: "M0 5h36", "stroke-dasharray": kDashes[name].join(" ") });
    line.style.stroke = `var(--${name})`;
    swatch.append(line);
    const item = element("li");
    item.append(swatch, text);
    list.append(item);
  }
  return list;
}
