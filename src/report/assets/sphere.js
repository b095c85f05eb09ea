// SPDX-License-Identifier: GPL-3.0-or-later
// The path of the axis on the unit sphere: the camera frames the cone on which the axis moves, or the whole sphere.

const kWholeFrom = 0.8;  // radius of a path from which on the whole sphere is shown
const kParted = 200;     // magnification from which on only the first and the last turn of a path are drawn
const kSmallest = 1e-8;  // radius of the smallest frame (rad)

/** Steps (degrees) between the lines of the grid. */
const kGridSteps = [30, 10, 5, 2, 1, ...[30, 10, 5, 2, 1].map((x) => x / 60), ...[30, 10, 5, 2, 1].map((x) => x / 3600)];
for (let decade = 0.1; decade > 1e-6; decade /= 10) for (const lead of [5, 2, 1]) kGridSteps.push((lead * decade) / 3600);

function angleText(degrees) {
  if (degrees >= 1 - 1e-9) return `${format(degrees, 3)}°`;
  return degrees >= 1 / 60 - 1e-9 ? `${format(degrees * 60, 3)}′` : `${format(degrees * 3600, 3)}″`;
}

/** The middle of a path and the largest distance from it; the whole sphere for a long path and for one without extent. */
function extentOf(paths) {
  const low = [1, 1, 1], high = [-1, -1, -1];
  for (const path of paths) for (const p of path) if (p) for (let k = 0; k < 3; ++k) {
    low[k] = Math.min(low[k], p[k]);
    high[k] = Math.max(high[k], p[k]);
  }
  const whole = { centre: [0, 0, 0], radius: 1, whole: true };
  if (low[0] > high[0]) return whole;
  const centre = times(0.5, combine(1, low, 1, high));
  let radius = 0;
  for (const path of paths) for (const p of path) if (p) radius = Math.max(radius, size(combine(1, p, -1, centre)));
  return radius > kWholeFrom || radius < kSmallest ? whole : { centre, radius, whole: false };
}

/** Lines of equal azimuth and of equal elevation about a direction, as far as `reach` (rad), `step` degrees apart. */
function gridAbout(focus, reach, step) {
  const lines = [], at = (azimuth, elevation) =>
    [Math.cos(elevation) * Math.sin(azimuth), Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation)];
  const path = (point) => Array.from({ length: 73 }, (_, i) => point(i / 72));
  const e0 = Math.asin(clamp(focus[2], -1, 1)), a0 = Math.atan2(focus[0], focus[1]);
  const low = Math.max(-Math.PI / 2, e0 - reach), high = Math.min(Math.PI / 2, e0 + reach);
  const round = reach > 0.7 * Math.cos(e0);  // the pole is near: all azimuths
  const half = round ? Math.PI : reach / Math.cos(e0), across = (round ? Math.max(step, 30) : step) * kRadian;
  for (let k = Math.ceil((a0 - half) / across + 1e-6); k * across <= a0 + half + 1e-9; ++k)
    lines.push(path((u) => at(k * across, low + u * (high - low))));
  for (let k = Math.ceil(low / (step * kRadian)); k * step * kRadian <= high; ++k)
    lines.push(path((u) => at(a0 + (2 * u - 1) * half, k * step * kRadian)));
  return lines;
}

/** Strokes a path on the sphere, its hidden part pale. */
function strokeOnSphere(pen, put, path, colour, width, hiddenAlpha, alpha = 1) {
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
}

/** The laboratory's axes from the sphere's centre. */
function paintAxes(pen, put, named) {
  const [x0, y0] = put([0, 0, 0]);
  for (const [name, direction] of [["East", [1, 0, 0]], ["North", [0, 1, 0]], ["Up", [0, 0, 1]]]) {
    const [x, y, depth] = put(times(1.12, direction));
    pen.globalAlpha = depth < 0 ? 0.55 : 1;
    pen.strokeStyle = pen.fillStyle = kPalette.text;
    pen.lineWidth = 1;
    trace(pen, [[x0, y0], [x, y]]);
    pen.stroke();
    pen.textAlign = x < x0 ? "right" : "left";
    pen.fillText(named ? name : name[0], x + (x < x0 ? -4 : 4), y + 4);
    pen.globalAlpha = 1;
  }
  pen.textAlign = "left";
}

/** A small whole sphere in the corner, with a ring where the frame is. */
function paintInset(pen, width, frame) {
  const { right, up, eye } = camera(), radius = 30, x0 = width - radius - 26, y0 = radius + 22;
  const put = (p) => [x0 + radius * dot(right, p), y0 - radius * dot(up, p), dot(eye, p)];
  pen.fillStyle = kPalette.bg;
  pen.fillRect(x0 - radius - 22, 0, 2 * radius + 48, y0 + radius + 18);
  spot(pen, [x0, y0], radius, kPalette.muted, 1);
  const equator = Array.from({ length: 49 }, (_, i) => [Math.cos(7.5 * i * kRadian), Math.sin(7.5 * i * kRadian), 0]);
  strokeOnSphere(pen, put, equator, kPalette.line, 1, 0.4);
  paintAxes(pen, put, false);
  spot(pen, put(frame.centre), Math.max(4, radius * frame.radius), kPalette.axis, 2);
}

kStarts.push(startSphere);

function startSphere(data) {
  const canvas = byId("sphere");
  if (!canvas) return;
  const still = document.createElement("canvas");
  const state = byId("sphere-state") ?? element("p");
  const note = element("p", "note");
  let axis = makeTrack([], []), ref = axis, paths = [], extent = extentOf([]), recent = 1, paleness = 1, telling = 0;
  const now = () => kScene.time ?? ref.last;

  /** What the camera frames. Zooming keeps the prediction's last point in its place on the screen, because the drift is
   *  visible there. */
  const frameNow = () => (kView.whole ? { centre: [0, 0, 0], radius: 1, whole: true } : extent);
  const frame = (width, height) => {
    const { right, up, eye } = camera(), { centre, radius, whole } = frameNow();
    const away = 1 - 1 / Math.max(1, kView.zoom), last = ref.at(ref.last) ?? centre;
    const focus = combine(1 - away, centre, away, last);
    const scale = (0.4 * Math.min(width, height) * kView.zoom) / (whole ? 1 : 1.05 * radius);
    const x0 = width / 2, y0 = height / 2;
    const put = (p) => {
      const q = combine(1, p, -1, focus);
      return [x0 + scale * dot(right, q), y0 - scale * dot(up, q), dot(eye, p)];
    };
    return { eye, scale, focus, put, reach: Math.hypot(width, height) / (2 * scale) };
  };
  const gridStep = (reach) => kGridSteps.find((step) => step * kRadian <= reach / 1.5) ?? kGridSteps.at(-1);

  /** Draws everything that changes only with the camera to a separate canvas, so that each frame of the animation draws
   *  only two dots. */
  const drawStill = () => {
    Object.assign(still, { width: canvas.width, height: canvas.height, ratio: canvas.ratio });
    const page = penOf(still);
    if (!page) return;
    const { pen } = page, { scale, focus, put, reach } = frame(page.width, page.height), framed = frameNow();
    // A path that lies on the far side altogether is looked at through the sphere.
    const through = paths.every(([, path]) => path.every((p) => !p || put(p)[2] < 0)) ? 1 : 0.4;
    const middle = normalise(focus);
    const lines = reach > 0.9 || !middle ? gridAbout([0, 1, 0], Math.PI, 30) : gridAbout(middle, 1.2 * reach, gridStep(reach));
    for (const line of lines) strokeOnSphere(pen, put, line, kPalette.line, 1, through === 1 && reach <= 0.9 ? 1 : 0.35);
    const [x0, y0] = put([0, 0, 0]);
    if (scale < 1e5) spot(pen, [x0, y0], scale, kPalette.muted, 1);
    if (reach > 0.9) paintAxes(pen, put, true);
    for (const [name, path] of paths) {
      pen.setLineDash(kDashes[name]);
      strokeOnSphere(pen, put, path, kPalette[name], paleness < 1 ? 1 : 2, through, paleness);
    }
    pen.setLineDash([]);
    if (reach <= 0.9) paintInset(pen, page.width, framed);
  };

  const draw = () => {
    const page = penOf(canvas);
    if (!page || !still.width) return;
    const { pen } = page, { put } = frame(page.width, page.height);
    pen.drawImage(still, 0, 0, page.width, page.height);
    const from = Math.max(ref.first, now() - recent * (ref.last - ref.first));
    const rows = ref.count * Math.min(1, (now() - from) / (ref.last - ref.first || 1)), pieces = clamp(Math.round(2 * rows), 60, 600);
    for (const [name, , at] of paths) {
      const trail = Array.from({ length: pieces + 1 }, (_, i) => at(from + (i / pieces) * (now() - from)));
      pen.setLineDash(kDashes[name]);
      strokeOnSphere(pen, put, trail, kPalette[name], 2, 0.6);
    }
    pen.setLineDash([]);
    for (const [name, , at] of paths) {
      const p = at(now()), here = p && put(p);
      if (here) spot(pen, here, name === "ref" ? 8 : 5, kPalette[name], name === "ref" ? 2 : 0);
    }
    if (!kScene.playing) tellSoon();
  };

  const tell = () => {
    const p = ref.at(now()), q = axis.at(now()), { reach } = frame(canvas.clientWidth || 640, canvas.clientHeight || 480);
    const bearing = Math.round(540 - kView.azimuth_deg) % 360, framed = frameNow();
    const lines = reach > 0.9 ? 30 : gridStep(reach);
    const shows = framed.whole ? "The whole sphere" : `The part of the sphere that the path fills, ${angleText((2 * framed.radius) / kRadian)} across`;
    state.textContent = `${shows}, seen from bearing ${bearing}°, clockwise from North, ${Math.round(kView.elevation_deg)}° above ` +
      `the horizon, zoom ${format(kView.zoom, 3)}; the lines are ${angleText(lines)} apart. At ${format(now(), 5)} s the two axes stand ` +
      `${p && q ? `${format(angleBetween(p, q), 4)} rad` : "an unknown angle"} apart.`;
  };
  // A screen reader is told the state only after eye and motion have come to rest, not at every step.
  const tellSoon = () => {
    clearTimeout(telling);
    telling = setTimeout(tell, 400);
  };
  const view = () => {
    button.setAttribute("aria-pressed", String(kView.whole));
    button.hidden = extent.whole;
    drawStill();
    draw();
    tellSoon();
  };
  /** Lays the paths out again, with the magnification that is chosen now. */
  const layOut = () => {
    const factor = magnification(), drawn = (time) => magnified(ref.at(time), axis.at(time), factor);
    // A path that is magnified much would be a smear: of it the first and the last turn are drawn.
    const turn = turnOf(ref), parted = factor >= kParted && ref.last - ref.first > 2.5 * turn;
    const shown = (at) => (time) => (parted && time > ref.first + turn && time < ref.last - turn ? null : at(time));
    // The prediction is drawn last: where the two coincide, its dashes lie on the motion's line.
    paths = [["axis", samplePath(axis, shown(drawn)), drawn], ["ref", samplePath(ref, shown(ref.at)), ref.at]];
    extent = extentOf(paths.map(([, path]) => path));
    // Many turns would fill a band. The path is then drawn pale, and only about its latest turn strongly.
    let length = 0;
    paths[1][1].forEach((p, i, all) => { if (p && all[i - 1]) length += angleBetween(p, all[i - 1]); });
    const reach = 2.5 * (extent.whole ? 1 : Math.max(0.1, extent.radius));
    recent = Math.min(1, reach / length);
    paleness = clamp((2 * reach) / length, 0.22, 1);
    note.textContent = magnificationText(axis, ref) + (parted ? " Of each path its first and last turn are drawn." : "");
    view();
  };
  const show = (data) => {
    axis = makeTrack(data.t_s, data.axis_L);
    ref = makeTrack(data.t_s, data.ref_axis_L);
    kScene.suits = suitableMagnification(axis, ref);
    for (const change of kScene.changes) change();
    if (data.keeps_view) return;
    // A small cone about the vertical is looked at from higher up, so that a circle is seen as one.
    kHome.elevation_deg = !extent.whole && Math.abs(extent.centre[2]) > 0.9 ? 50 : 25;
    Object.assign(kView, kHome);
    turn(0, 0);
  };

  const controls = controlsOf(canvas), button = element("button", "", "Whole sphere");
  button.type = "button";
  button.addEventListener("click", () => frameWhole(!kView.whole));
  controls.append(button);
  addMagnification(controls);
  controls.after(note);
  note.after(legend([["ref", `prediction, without ${data.cause} (ring)`], ["axis", `with ${data.cause} (dot)`]]));
  makeTurnable(canvas);
  kViewers.push(view);
  kScene.changes.push(layOut);
  kScene.followers.push(draw);
  kScene.shows.push(show);
  show(data);
  watch(canvas, view);
}
