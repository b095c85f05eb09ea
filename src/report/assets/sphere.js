// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors, the camera, tracks of the axis over time, the unit sphere. All in laboratory axes: East, North, Up.

const kRadian = Math.PI / 180;
const kHome = { azimuth_deg: -25, elevation_deg: 25, zoom: 1 };

/** At azimuth 0 the laboratory is seen from the South, with East to the right. The elevation raises the eye; Up stays up. */
const kView = { ...kHome };
const kViewers = [];

/** The time that both canvases show; null (without an animation) stands for the last row. */
const kScene = { time: null, playing: false, followers: [] };

const kDashes = {
  axis: [], ref: [7, 4], gravity: [], coriolis: [11, 4], transverse: [2, 4], centrifugal: [11, 4, 2, 4], earth: [6, 6],
  precession: [2, 6],
};

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
  kView.zoom = clamp(kView.zoom * factor, 1, 1000);
  for (const viewer of kViewers) viewer();
}

function makeTurnable(canvas) {
  canvas.tabIndex = 0;
  // Movements are differences of positions, because movementX is in other units, or zero, in some browsers.
  let x = 0, y = 0;
  const place = (event) => { [x, y] = [event.clientX, event.clientY]; };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    place(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    turn((x - event.clientX) / 2, (event.clientY - y) / 2);
    place(event);
  });
  const keys = {
    ArrowLeft: [5, 0], ArrowRight: [-5, 0], ArrowUp: [0, -5], ArrowDown: [0, 5],
    "+": [0, 0, 1.25], "=": [0, 0, 1.25], "-": [0, 0, 0.8],
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Home") Object.assign(kView, kHome);
    else if (!keys[event.key]) return;
    turn(...(keys[event.key] ?? [0, 0]));
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
    // Next to a missing row nothing is interpolated.
    if (!p || !q) return u === 0 ? p : u === 1 ? q : null;
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

function magnified(ref, axis, magnification) {
  if (!ref || !axis) return null;
  return normalise(combine(1 - magnification, ref, magnification, axis));
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

function graticule() {
  const circle = (point) => Array.from({ length: 73 }, (_, i) => point(Math.cos(5 * i * kRadian), Math.sin(5 * i * kRadian)));
  return [0, 1, 2, 3, 4, 5].flatMap((k) => {
    const east = Math.cos(30 * k * kRadian), north = Math.sin(30 * k * kRadian);
    const out = Math.cos(30 * (k - 2) * kRadian), up = Math.sin(30 * (k - 2) * kRadian);
    return [circle((c, s) => [east * c, north * c, s]), circle((c, s) => [out * c, out * s, up])];
  });
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

function startSphere(data) {
  const canvas = byId("sphere");
  if (!canvas) return;
  const axis = makeTrack(data.t_s, data.axis_L), ref = makeTrack(data.t_s, data.ref_axis_L);
  const factor = isNumber(data.magnification) ? data.magnification : 1;
  const drawn = (time) => magnified(ref.at(time), axis.at(time), factor);
  // The prediction is drawn last: where the two coincide, its dashes lie on the motion's line.
  const paths = [["axis", samplePath(axis, drawn), drawn], ["ref", samplePath(ref, ref.at), ref.at]];
  // Many turns would fill a band. The path is then drawn pale, and only about its latest turn strongly.
  let length = 0;
  paths[1][1].forEach((p, i, all) => { if (p && all[i - 1]) length += angleBetween(p, all[i - 1]); });
  const recent = Math.min(1, 2.5 / length), paleness = clamp(5 / length, 0.22, 1);
  const lines = graticule();
  const still = document.createElement("canvas");
  const state = byId("sphere-state") ?? element("p");
  const now = () => kScene.time ?? ref.last;
  let telling = 0;

  /** Zooming keeps the prediction's last point in its place on the screen, because the drift is visible there. */
  const frame = (width, height) => {
    const { right, up, eye } = camera(), focus = ref.at(ref.last) ?? [0, 0, 0], away = 1 - 1 / kView.zoom;
    const scale = 0.4 * Math.min(width, height) * kView.zoom;
    const x0 = width / 2 - scale * away * dot(right, focus), y0 = height / 2 + scale * away * dot(up, focus);
    return { eye, scale, x0, y0, put: (p) => [x0 + scale * dot(right, p), y0 - scale * dot(up, p), dot(eye, p)] };
  };

  const stroke = (pen, put, path, colour, width, hiddenAlpha, alpha = 1) => {
    const front = new Path2D(), back = new Path2D();
    let before = null, side = null;
    for (const p of path) {
      const here = p && put(p);
      if (here && before) {
        const next = here[2] + before[2] >= 0 ? front : back;
        if (next !== side) next.moveTo(before[0], before[1]);
        next.lineTo(here[0], here[1]);
        side = next;
      } else side = null;
      before = here;
    }
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.globalAlpha = alpha * hiddenAlpha;
    pen.stroke(back);
    pen.globalAlpha = alpha;
    pen.stroke(front);
    pen.globalAlpha = 1;
  };

  /** Draws everything that changes only with the camera to a separate canvas, so that each frame of the animation draws
   *  only two dots. */
  const drawStill = () => {
    still.width = canvas.width;
    still.height = canvas.height;
    still.ratio = canvas.ratio;
    const page = penOf(still);
    if (!page) return;
    const { pen } = page, { scale, x0, y0, put } = frame(page.width, page.height);
    for (const line of lines) stroke(pen, put, line, kPalette.line, 1, 0.35);
    spot(pen, [x0, y0], scale, kPalette.muted, 1);
    for (const [name, direction] of [["East", [1, 0, 0]], ["North", [0, 1, 0]], ["Up", [0, 0, 1]]]) {
      const [x, y, depth] = put(times(1.12, direction));
      pen.globalAlpha = depth < 0 ? 0.55 : 1;
      pen.strokeStyle = pen.fillStyle = kPalette.text;
      trace(pen, [[x0, y0], [x, y]]);
      pen.stroke();
      pen.textAlign = x < x0 ? "right" : "left";
      pen.fillText(name, x + (x < x0 ? -5 : 5), y + 4);
      pen.globalAlpha = 1;
    }
    for (const [name, path] of paths) {
      pen.setLineDash(kDashes[name]);
      stroke(pen, put, path, kPalette[name], paleness < 1 ? 1 : 2, 0.4, paleness);
    }
  };

  const draw = () => {
    const page = penOf(canvas);
    if (!page || !still.width) return;
    const { pen } = page, { eye, put } = frame(page.width, page.height);
    pen.drawImage(still, 0, 0, page.width, page.height);
    const from = Math.max(ref.first, now() - recent * (ref.last - ref.first));
    for (const [name, , at] of paths) {
      const trail = Array.from({ length: 61 }, (_, i) => at(from + (i / 60) * (now() - from)));
      pen.setLineDash(kDashes[name]);
      stroke(pen, put, trail, kPalette[name], 2, 0.4);
    }
    pen.setLineDash([]);
    for (const [name, , at] of paths) {
      const p = at(now());
      pen.globalAlpha = p && dot(eye, p) < 0 ? 0.45 : 1;
      if (p) spot(pen, put(p), name === "ref" ? 8 : 5, kPalette[name], name === "ref" ? 2 : 0);
    }
    pen.globalAlpha = 1;
    if (!kScene.playing) tellSoon();
  };

  const tell = () => {
    const p = ref.at(now()), q = axis.at(now());
    const bearing = Math.round(540 - kView.azimuth_deg) % 360;
    state.textContent = `Seen from bearing ${bearing}°, clockwise from North, ${Math.round(kView.elevation_deg)}° above ` +
      `the horizon, zoom ${format(kView.zoom, 3)}. At ${format(now(), 5)} s the two axes stand ` +
      `${p && q ? `${format(angleBetween(p, q), 4)} rad` : "an unknown angle"} apart.`;
  };
  // A screen reader is told the state only after eye and motion have come to rest, not at every step.
  const tellSoon = () => {
    clearTimeout(telling);
    telling = setTimeout(tell, 400);
  };
  const view = () => {
    drawStill();
    draw();
    tellSoon();
  };
  const entries = [["ref", "prediction, without Earth rotation (ring)"],
    ["axis", `with Earth rotation (dot), its distance from the prediction drawn ${format(factor)} times`]];
  canvas.after(legend(entries));
  makeTurnable(canvas);
  kViewers.push(view);
  kScene.followers.push(draw);
  watch(canvas, view);
}
