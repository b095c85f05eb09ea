// SPDX-License-Identifier: GPL-3.0-or-later
// The animated top, the axis of the prediction next to it, and the vectors that act. The unit of length is the stem.

const kDisc = { height: 0.58, radius: 0.4, thickness: 0.09 };
const kTorques = { gravity: "gravity", coriolis: "Coriolis", transverse: "transverse", centrifugal: "centrifugal" };

/** East and North, rotated by the smallest rotation that takes Up to the axis: unlike the line of nodes, they do not
 *  whirl when the axis passes the vertical. */
function across(axis) {
  const [x, y, z] = axis;
  if (z < -0.999999) return [[1, 0, 0], [0, -1, 0]];
  const f = 1 / (1 + z);
  return [[1 - x * x * f, -x * y * f, -x], [-x * y * f, 1 - y * y * f, -y]];
}

/** The torques over time, each with the power of ten that makes it comparable with the largest one. */
function readTorques(torques) {
  const moments = torques?.t_s ?? [];
  const all = Object.keys(kTorques).map((name) => {
    const numbers = torques?.[`${name}_N_m`] ?? [], count = Math.min(moments.length, Math.floor(numbers.length / 3));
    const row = (i) => numbers.slice(3 * i, 3 * i + 3).map((x) => (isNumber(x) ? x : 0));
    let largest = 0;
    for (let i = 0; i < count; ++i) largest = Math.max(largest, size(row(i)));
    const at = (time) => {
      if (count < 2) return row(0);
      const i = rowBefore(moments, time, count), step = moments[i + 1] - moments[i];
      const u = step > 0 ? clamp((time - moments[i]) / step, 0, 1) : 0;
      return combine(1 - u, row(i), u, row(i + 1));
    };
    return { name, count, largest, at };
  }).filter((torque) => torque.count);
  const unit = Math.max(0, ...all.map((torque) => torque.largest));
  for (const torque of all) {
    torque.decade = torque.largest > 0 ? Math.floor(Math.log10(unit / torque.largest) + 1e-9) : 0;
    torque.scale = torque.largest > 0 ? 10 ** torque.decade / unit : 0;
  }
  return all;
}

/** A place on the table over time, in lengths of the stem, with straight lines between the rows; always the origin for a
 *  fixed pivot. */
function makePlace(moments, numbers) {
  const count = Math.min(moments?.length ?? 0, Math.floor((numbers?.length ?? 0) / 3)), origin = [0, 0, 0];
  const rows = Array.from({ length: count }, (_, i) => {
    const place = numbers.slice(3 * i, 3 * i + 3);
    return place.every(isNumber) ? place : null;
  });
  const at = (time) => {
    if (count < 2) return rows[0] ?? origin;
    const i = rowBefore(moments, time, count), step = moments[i + 1] - moments[i], p = rows[i], q = rows[i + 1];
    const u = step > 0 ? clamp((time - moments[i]) / step, 0, 1) : 0;
    return p && q ? combine(1 - u, p, u, q) : p ?? q ?? origin;
  };
  /** The places of all rows up to a time, and that of the time itself. */
  const until = (time) => {
    const path = [];
    for (let i = 0; i < count && moments[i] <= time; ++i) if (rows[i]) path.push(rows[i]);
    if (count) path.push(at(time));
    return path;
  };
  return { count, at, until };
}

function torqueLabel({ name, largest, decade }) {
  if (largest === 0) return `${kTorques[name]} torque: zero`;
  return `${kTorques[name]} torque ×${decade === 0 ? "1" : `1e${decade}`}, at most ${format(largest, 3)} N m`;
}

function paintTop(pen, project, eye, scene) {
  const origin = [0, 0, 0];
  let place = origin;  // of what is drawn: the tip of a top on a table moves
  const put = (p) => project(combine(1, place, 1, p));
  const line = (from, to, name, width) => {
    pen.strokeStyle = kPalette[name];
    pen.lineWidth = width;
    pen.setLineDash(kDashes[name] ?? []);
    trace(pen, [put(from), put(to)]);
    pen.stroke();
    pen.setLineDash([]);
  };
  const write = (text, x, y) => {
    pen.strokeStyle = kPalette.bg;
    pen.lineWidth = 3;
    pen.strokeText(text, x, y + 4);
    pen.fillStyle = kPalette.text;
    pen.fillText(text, x, y + 4);
  };
  const arrow = (from, vector, name, text) => {
    const to = combine(1, from, 1, vector), [x0, y0] = put(from), [x, y] = put(to);
    const length = Math.hypot(x - x0, y - y0);
    if (length < 1) return;
    line(from, to, name, 2.5);
    const ux = (x - x0) / length, uy = (y - y0) / length, head = Math.min(10, length);
    pen.fillStyle = kPalette[name];
    const barb = (side) => [x - head * (ux - side * uy), y - head * (uy + side * ux)];
    trace(pen, [[x + 2 * ux, y + 2 * uy], barb(0.45), barb(-0.45)]);
    pen.fill();
    // Labels stand beyond the tip, on the side to which the arrow points, so that they seldom overlap; those of steep arrows
    // stand to the left, because "Up" stands to the right.
    pen.textAlign = ux < 0.2 ? "right" : "left";
    write(text, x + 7 * ux + (ux < 0.2 ? -5 : 5), y + 14 * uy);
    pen.textAlign = "left";
  };
  const ring = (centre, p, q, radius) => {
    const [x, y] = put(centre), [px, py] = put(combine(1, centre, radius, p)), [qx, qy] = put(combine(1, centre, radius, q));
    pen.beginPath();
    for (let k = 0; k < 48; ++k) {
      const c = Math.cos((k * Math.PI) / 24), s = Math.sin((k * Math.PI) / 24);
      pen.lineTo(x + c * (px - x) + s * (qx - x), y + c * (py - y) + s * (qy - y));
    }
    pen.closePath();
  };

  ring(origin, [1, 0, 0], [0, 1, 0], 0.75);
  pen.strokeStyle = kPalette.line;
  pen.lineWidth = 1;
  pen.stroke();
  for (const [name, tip] of [["East", [0.75, 0, 0]], ["North", [0, 0.75, 0]], ["Up", [0, 0, 1.25]]]) {
    line(origin, tip, "line", 1);
    const [x, y] = put(tip);
    write(name, x + 4, y);
  }
  if (scene.earth) arrow(origin, scene.earth, "earth", "Earth's rate");
  if (scene.precession) arrow(origin, times(1.1, scene.precession), "precession", "precession axis");
  const { axis, ref } = scene;
  if (scene.path.length > 1) {
    pen.strokeStyle = kPalette.axis;
    pen.lineWidth = 1;
    trace(pen, scene.path.map(put));
    pen.stroke();
  }
  place = scene.refTip;
  if (ref) line(origin, ref, "ref", 2);
  place = scene.tip;
  if (axis) {
    const [p, q] = across(axis), faceUp = dot(axis, eye) >= 0;
    const low = times(kDisc.height - kDisc.thickness / 2, axis);
    const high = times(kDisc.height + kDisc.thickness / 2, axis);
    const stem = (from, to) => line(from, to, "metal-dark", 6);
    const [near, far] = faceUp ? [high, low] : [low, high];
    if (faceUp) stem(origin, low); else stem(high, axis);
    // The rim of the disc: the far face, and the band between the outermost visible points of both faces.
    const edge = times(kDisc.radius, normalise(cross(axis, eye)) ?? origin);
    pen.fillStyle = kPalette["metal-dark"];
    ring(far, p, q, kDisc.radius);
    pen.fill();
    trace(pen, [[low, 1], [low, -1], [high, -1], [high, 1]].map(([face, side]) => put(combine(1, face, side, edge))));
    pen.fill();
    ring(near, p, q, kDisc.radius);
    pen.fillStyle = kPalette.metal;
    pen.fill();
    pen.strokeStyle = kPalette.fg;
    pen.lineWidth = 1;
    pen.stroke();
    pen.fillStyle = kPalette.axis;
    const spoke = (k) => {
      const angle = scene.turned + k * 0.12;
      return put(combine(1, near, 0.95 * kDisc.radius, combine(Math.cos(angle), p, Math.sin(angle), q)));
    };
    trace(pen, [put(near), ...[-3, -2, -1, 0, 1, 2, 3].map(spoke)]);
    pen.fill();
    if (faceUp) stem(high, axis); else stem(origin, low);
    spot(pen, put(axis), 4.5, kPalette.axis);
  }
  place = scene.refTip;
  if (ref) spot(pen, put(ref), 8, kPalette.ref, 2);
  place = scene.tip;
  const centre = times(kDisc.height, axis ?? ref ?? origin);
  for (const { name, vector } of scene.torques) arrow(centre, times(0.6, vector), name, kTorques[name]);
}

function startTop(data) {
  const canvas = byId("top");
  if (!canvas) return;
  // A control that the page does not have is replaced by one that is not shown.
  const control = (id, tag) => byId(id) ?? element(tag);
  const play = control("play", "button"), slider = control("time", "input"), clock = control("clock", "output");
  const arrows = byId("arrows") ?? { checked: true };
  const axis = makeTrack(data.t_s, data.axis_L), ref = makeTrack(data.t_s, data.ref_axis_L);
  const tip = makePlace(data.t_s, data.tip), refTip = makePlace(data.t_s, data.ref_tip);
  const torques = readTorques(data.torques);
  const earth = normalise(data.earth_rate_L), precession = normalise(data.precession_axis_L);
  const first = axis.first, last = axis.last, span = last - first;
  const spin = isNumber(data.spin_rad_s) ? data.spin_rad_s : 0;
  // The pivot is low in the picture unless the top hangs below it.
  const hangs = samplePath(axis, axis.at, 1).some((p) => p && p[2] < -0.2);
  // The animation takes at most a minute and at least ten seconds; between these it runs in real time.
  const pace = span > 60 ? 1 / roundDown(60 / span) : span > 0 && span < 10 ? roundDown(span / 10) : 1;
  const slowed = Math.max(1, Number(((Math.abs(spin) * pace) / Math.PI).toPrecision(2)));
  const apart = () => {
    const p = axis.at(time), q = ref.at(time);
    return p && q ? `, the two axes ${format(angleBetween(p, q), 3)} rad apart` : "";
  };
  let time = first, playing = false, before = 0, stamps = [], said = 0;

  const draw = () => {
    const page = penOf(canvas);
    if (!page) return;
    const { right, up, eye } = camera(), scale = (hangs ? 0.36 : 0.5) * page.height;
    const x0 = page.width / 2, y0 = (0.5 + (hangs ? 0 : 0.26 * up[2])) * page.height;
    const put = (p) => [x0 + scale * dot(right, p), y0 - scale * dot(up, p)];
    const shown = arrows.checked;
    paintTop(page.pen, put, eye, {
      axis: axis.at(time), ref: ref.at(time), tip: tip.at(time), refTip: refTip.at(time), path: tip.until(time), turned: ((spin / slowed) * (time - first)) % (2 * Math.PI),
      earth: shown ? earth : null, precession: shown ? precession : null,
      torques: shown ? torques.map((t) => ({ name: t.name, vector: times(t.scale, t.at(time)) })) : [],
    });
  };
  const tell = () => {
    slider.value = String(time);
    clock.textContent = axis.count ? `${time.toFixed(span < 10 ? 3 : 1)} s${apart()}` : "no rows to show";
  };
  const show = () => {
    kScene.time = time;
    draw();
    for (const follower of kScene.followers) follower();
  };
  const frame = (now) => {
    if (!playing) return;
    // Limits the step, so that the animation does not jump after its tab was hidden.
    time = Math.min(last, time + pace * Math.min(0.1, Math.max(0, now - before) / 1000));
    before = now;
    stamps.push(now);
    while (stamps[0] <= now - 1000) stamps.shift();
    window.earthtop.frames += 1;
    window.earthtop.fps = stamps.length;
    show();
    // Numbers cannot be read faster, and the layout of text takes longer than the drawing.
    if (now - said > 100) { said = now; tell(); }
    if (time >= last) return toggle(false);
    requestAnimationFrame(frame);
  };
  const toggle = (on) => {
    playing = kScene.playing = on && span > 0;
    play.textContent = playing ? "Pause" : "Play";
    // The clock is read out only while the animation stands still.
    clock.setAttribute("aria-live", playing ? "off" : "polite");
    if (playing && time >= last) time = first;
    stamps = [];
    before = performance.now();
    show();
    tell();
    if (playing) requestAnimationFrame(frame);
  };

  Object.assign(slider, { min: first, max: last, step: span / 1000 || 1, disabled: !(span > 0) });
  play.disabled = slider.disabled;
  slider.addEventListener("input", () => { time = clamp(Number(slider.value), first, last); show(); tell(); });
  play.addEventListener("click", () => toggle(!playing));
  byId("arrows")?.addEventListener("change", draw);
  canvas.addEventListener("keydown", (event) => {
    if (event.key !== " ") return;
    toggle(!playing);
    event.preventDefault();
  });

  const paceText = pace === 1 ? "in real time" :
    `${format(Math.max(pace, 1 / pace), 3)} times ${pace > 1 ? "faster" : "slower"} than it happens`;
  const shrunk = data.path_shrunk;
  const pathText = !tip.count ? "" : !isNumber(shrunk) || shrunk <= 0 ? " The line on the table is the path of the tip." :
    ` The line on the table is the path of the tip${shrunk > 1.005 ? `, drawn ${format(shrunk, 3)} times smaller than the top` : ""}.`;
  const note = element("p", "note", `Shown ${paceText}; the spin of ${format(spin)} rad/s drawn at 1/${format(slowed)} ` +
    "of its rate. The axes are drawn as they are, not magnified." + pathText);
  const entries = [["ref", "prediction, without Earth rotation"], ...torques.map((t) => [t.name, torqueLabel(t)])];
  if (earth) entries.push(["earth", `Earth's rate, its direction (${format(size(data.earth_rate_L), 4)} rad/s)`]);
  if (precession) entries.push(["precession", "precession axis"]);
  (play.closest(".controls") ?? canvas).after(note, legend(entries));
  makeTurnable(canvas);
  kViewers.push(draw);
  watch(canvas, draw);
  toggle(axis.count > 1 && !window.matchMedia("(prefers-reduced-motion: reduce)").matches);
}
