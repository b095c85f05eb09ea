// SPDX-License-Identifier: GPL-3.0-or-later
// The animation: both tops, the vectors that act, the clock, and the reader's choices of speed and magnification.

const kTorques = { gravity: "gravity", coriolis: "Coriolis", transverse: "transverse", centrifugal: "centrifugal" };

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
    return { name, says: name === "gravity" && torques?.others_applied ? "applied" : kTorques[name], count, largest, at };
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

/** A number over time, with straight lines between the rows; 0 where there are none. */
function makeNumber(moments, numbers) {
  const count = Math.min(moments?.length ?? 0, numbers?.length ?? 0);
  return (time) => {
    if (count < 2) return numbers?.[0] ?? 0;
    const i = rowBefore(moments, time, count), step = moments[i + 1] - moments[i];
    const u = step > 0 ? clamp((time - moments[i]) / step, 0, 1) : 0;
    return (1 - u) * numbers[i] + u * numbers[i + 1];
  };
}

/** The rotor in the body, if there is one, and the angles in each motion of the rotor in the body and of the body about its axis 3. None
 *  where its axis is another than that of the disc as which the body is drawn. */
function readRotor({ t_s, rotor, rotor_angle, ref_rotor_angle, body_angle, ref_body_angle }, shape) {
  if (!rotor || (shape.kind !== "box" && rotor.axes_B[0][2] !== 1)) return null;
  const [angle, refAngle, body, refBody] = [rotor_angle, ref_rotor_angle, body_angle, ref_body_angle].map((list) => makeNumber(t_s, list));
  return { ...rotor, angle, refAngle, body, refBody };
}

/** Where the masses are that move in a body drawn as a box. */
function readMasses(data, shape) {
  const count = shape.kind === "box" && isNumber(data.masses) ? data.masses : 0;
  return Array.from({ length: count }, (_, i) => makePlace(data.t_s, data[`mass_${i}`]));
}

/** The outer gimbal in each motion, if there is one. */
function readGimbal({ t_s, ring_axis, ring_normal, ref_ring_normal }) {
  const [axis, normal, refNormal] = [ring_axis, ring_normal, ref_ring_normal].map((list) => makeTrack(t_s, list));
  if (!axis.count || !normal.count || !refNormal.count) return null;
  const by = (track) => (time, carry) => {
    const [a, n] = [axis.at(time), track.at(time)];
    return a && n ? { axis: carry(a), normal: carry(n) } : null;
  };
  return { at: by(normal), refAt: by(refNormal) };
}

function torqueLabel({ says, largest, decade }) {
  if (largest === 0) return `${says} torque: zero`;
  return `${says} torque ×${decade === 0 ? "1" : `1e${decade}`}, at most ${format(largest, 3)} N m`;
}

/** The speeds to choose from: those at which the animation takes about a second to about ten minutes, by 1, 2 and 5. */
function speedsFor(span, suits) {
  const list = [suits];
  for (let decade = -6; decade <= 7; ++decade) for (const lead of [1, 2, 5]) {
    const speed = Number(`${lead}e${decade}`);
    if (span / speed >= 1 && span / speed <= 600) list.push(speed);
  }
  return list.sort((a, b) => a - b).filter((speed, i) => i === 0 || speed > 1.01 * list[i - 1]);
}

/** The speed at which the animation takes at most a minute and at least ten seconds; between these it runs in real time. A
 *  body that is drawn as it turns is shown no faster than the eye can follow. */
function suitableSpeed(span, rate_rad_s) {
  const speed = span > 60 ? 1 / roundDown(60 / span) : span > 0 && span < 10 ? roundDown(span / 10) : 1;
  return rate_rad_s * speed > 4 ? Math.min(speed, roundDown(4 / rate_rad_s)) : speed;
}

function speedText(speed) {
  if (Math.abs(speed - 1) < 1e-9) return "in real time";
  return `${Number(Math.max(speed, 1 / speed).toPrecision(3)).toLocaleString("en")} times ${speed > 1 ? "faster" : "slower"} than it happens`;
}

/** How long the axis takes for a turn about the middle of its path; for a path without turns, all of its time. A path that swings to and
 *  fro is shown as long as a few of its swings take. */
function turnOf(track) {
  const path = samplePath(track, track.at, 1).filter((p) => p), span = track.last - track.first;
  const middle = normalise(path.reduce((sum, p) => combine(1, sum, 1, p), [0, 0, 0]));
  if (!middle || path.length < 3) return span;
  const [u, v] = across(middle);
  let wound = 0, length = 0, radius = 0;
  for (let i = 1; i < path.length; ++i) {
    const [a, b] = [path[i - 1], path[i]].map((p) => [dot(u, p), dot(v, p)]);
    wound += Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    length += angleBetween(path[i - 1], path[i]);
    radius = Math.max(radius, angleBetween(middle, path[i]));
  }
  const byWinding = Math.abs(wound) > 2 * Math.PI ? (span * 2 * Math.PI) / Math.abs(wound) : span;
  return Math.min(byWinding, length > 0 ? (span * 40 * Math.max(radius, 1e-9)) / length : span);
}

/** The prediction's axis over the turn that ends at a time, or over the first one. */
function coneAt({ ref, turn, hangs }, time) {
  const kPieces = 240, to = Math.min(ref.last, Math.max(time, ref.first + turn)), from = Math.max(ref.first, to - turn);
  const path = [];
  for (let i = 0; i <= kPieces; ++i) {
    const p = ref.at(from + (i / kPieces) * (to - from));
    if (p) path.push(hangs ? times(-1, p) : p);
  }
  return path;
}

/** What is drawn of a run's data. */
function readMotion(data) {
  const axis = makeTrack(data.t_s, data.axis_L), ref = makeTrack(data.t_s, data.ref_axis_L);
  const tip = makePlace(data.t_s, data.tip), refTip = makePlace(data.t_s, data.ref_tip);
  const attitude = makeAttitude(data.t_s, data.attitude_LB), refAttitude = makeAttitude(data.t_s, data.ref_attitude_LB);
  const rate = isNumber(data.rate_rad_s) ? data.rate_rad_s : 0;
  let step = 0;
  for (let i = 1; i < axis.count; ++i) step = Math.max(step, data.t_s[i] - data.t_s[i - 1]);
  // Between rows that are more than a radian apart it is unknown how the body turned.
  const dense = rate * step < 1, asBody = attitude.count > 0 && dense, shape = shapeOf(data.top, asBody, tip.count > 0);
  const rotor = readRotor(data, shape), masses = readMasses(data, shape), turns = rotor?.rate_rad_s ?? data.spin_rad_s;
  const spin = isNumber(turns) ? turns : 0, span = axis.last - axis.first;
  const turn = turnOf(ref);
  // The pivot is low in the picture unless the top hangs below it, and in the middle where the body turns about it.
  const hangs = shape.height < 0 || !shape.rolls && samplePath(axis, axis.at, 1).some((p) => p && p[2] < -0.2);
  return {
    cause: data.cause, axis, ref, tip, refTip, attitude, refAttitude, shape, rotor, masses, gimbal: readGimbal(data), spin, span, first: axis.first, last: axis.last,
    torques: readTorques(data.torques), earth: normalise(data.earth_rate_L), earthRate: data.earth_rate_L,
    precession: normalise(data.precession_axis_L), shrunk: data.path_shrunk, centred: hangs || shape.kind === "box" || shape.height === 0,
    turn, hangs: shape.height < 0, sparse: attitude.count > 0 && !dense, suits: suitableSpeed(span, shape.kind === "box" ? rate : 0),
  };
}

function motionLegend(motion, withTorques) {
  const entries = [["axis", `axis with ${motion.cause}`], ["ref", "its twin without it, and the cone it moves on"]];
  if (motion.earth) entries.push(["earth", "direction of the Earth's axis"]);
  if (withTorques) {
    entries.push(...motion.torques.map((t) => [t.name, torqueLabel(t)]));
    if (motion.precession) entries.push(["precession", "precession axis"]);
  }
  return legend(entries);
}

/** In words: the speed, the magnification, and what is not drawn as it is. */
function motionText(motion, speed, slowed) {
  const parts = [`Shown ${speedText(speed)}.`, magnificationText(motion.axis, motion.ref)];
  const { shape, tip, shrunk, rotor, spin } = motion, slowly = `1/${format(slowed)} of its rate`;
  if (rotor && shape.kind === "box")
    parts.push(`The body is drawn as the uniform box of the same moments of inertia, as it turns. The wheel in it is the rotor: its angle in the body is drawn at ${slowly}.`);
  else if (rotor) parts.push(`The wheel is the rotor and the hoop the cage: the angles of both about the axis are drawn at 1/${format(slowed)} of their rates.`);
  else if (shape.kind === "box") parts.push("The body is drawn as the uniform box of the same moments of inertia, as it turns; the disc on it marks its axis 3.");
  else if (spin !== 0) parts.push(`The spin of ${format(spin)} rad/s is drawn at ${slowly}.`);
  if (motion.gimbal) parts.push("The ring is the outer gimbal, with its axis; the body in it is the inner one.");
  if (motion.masses.length) parts.push("The dots are the masses that move in it.");
  if (motion.sparse) parts.push("The body is not symmetric, but the times drawn are too far apart to show how it turns.");
  if (tip.count && isNumber(shrunk) && shrunk > 0)
    parts.push(`The line on the table is the path of the tip${shrunk > 1.005 ? `, drawn ${format(shrunk, 3)} times smaller than the top` : ""}; ` +
      "the distance between the two tips is not magnified.");
  return parts.join(" ");
}

kStarts.push(startTop);

function startTop(data) {
  const canvas = byId("top");
  if (!canvas) return;
  // A control that the page does not have is replaced by one that is not shown.
  const control = (id, tag) => byId(id) ?? element(tag);
  const play = control("play", "button"), slider = control("time", "input"), clock = control("clock", "output");
  const arrows = byId("arrows") ?? { checked: true }, controls = controlsOf(canvas);
  const speeds = element("select", "speed"), note = element("p", "note");
  let motion = readMotion({}), list = motionLegend(motion, false), chosen = null;
  let time = 0, playing = false, before = 0, stamps = [], said = 0;
  const speed = () => chosen ?? motion.suits;
  const slowed = () => Math.max(1, Number(((Math.abs(motion.spin) * speed()) / Math.PI).toPrecision(2)));
  const apart = () => {
    const p = motion.axis.at(time), q = motion.ref.at(time);
    return p && q ? `, the two axes ${angleText(angleBetween(p, q) / kRadian)} apart` : "";
  };

  const draw = () => {
    const page = penOf(canvas);
    if (!page) return;
    const { right, up, eye } = camera(), { centred } = motion, scale = (centred ? 0.36 : 0.5) * page.height;
    const x0 = page.width / 2, y0 = (0.5 + (centred ? 0 : 0.26 * up[2])) * page.height;
    const put = (p) => [x0 + scale * dot(right, p), y0 - scale * dot(up, p)];
    const shown = arrows.checked, { rotor } = motion, once = (angle) => (angle / slowed()) % (2 * Math.PI);
    const spun = once(motion.spin * (time - motion.first));
    const [turned, refTurned] = rotor ? [once(rotor.angle(time)), once(rotor.refAngle(time))] : [spun, spun];
    const [caged, refCaged] = rotor ? [once(rotor.body(time)), once(rotor.refBody(time))] : [0, 0];
    const masses = motion.masses.map((mass) => mass.at(time));
    const axis = motion.axis.at(time), ref = motion.ref.at(time), drawn = magnified(ref, axis, magnification());
    const carry = axis && drawn ? carrier(axis, drawn) : (v) => v, still = (v) => v;
    paintTop(page.pen, put, eye, {
      shape: motion.shape, tip: motion.tip.at(time), refTip: motion.refTip.at(time), path: motion.tip.until(time),
      body: { axis: drawn, turned, rotor, masses, caged, attitude: motion.attitude.at(time), carry, gimbal: motion.gimbal?.at(time, carry) },
      ghost: { axis: ref, turned: refTurned, rotor, masses, caged: refCaged, attitude: motion.refAttitude.at(time), carry: still, gimbal: motion.gimbal?.refAt(time, still) },
      earth: motion.earth, cone: coneAt(motion, time), precession: shown ? motion.precession : null,
      torques: shown ? motion.torques.map((t) => ({ name: t.name, says: t.says, vector: times(t.scale, t.at(time)) })) : [],
    });
  };
  const nameLines = () => {
    const made = motionLegend(motion, arrows.checked);
    list.replaceWith(made);
    list = made;
  };
  const tell = () => {
    slider.value = String(time);
    clock.textContent = motion.axis.count ? `${time.toFixed(motion.span < 10 ? 3 : 1)} s${apart()}` : "no rows to show";
  };
  const tellChoices = () => { note.textContent = motionText(motion, speed(), slowed()); };
  const show = () => {
    kScene.time = time;
    draw();
    for (const follower of kScene.followers) follower();
  };
  const frame = (now) => {
    if (!playing) return;
    // Limits the step, so that the animation does not jump after its tab was hidden.
    time = Math.min(motion.last, time + speed() * Math.min(0.1, Math.max(0, now - before) / 1000));
    before = now;
    stamps.push(now);
    while (stamps[0] <= now - 1000) stamps.shift();
    window.earthtop.frames += 1;
    window.earthtop.fps = stamps.length;
    show();
    // Numbers cannot be read faster, and the layout of text takes longer than the drawing.
    if (now - said > 100) { said = now; tell(); }
    if (time >= motion.last) return toggle(false);
    requestAnimationFrame(frame);
  };
  const toggle = (on) => {
    playing = kScene.playing = on && motion.span > 0;
    play.textContent = playing ? "Pause" : "Play";
    // The clock is read out only while the animation stands still.
    clock.setAttribute("aria-live", playing ? "off" : "polite");
    if (playing && time >= motion.last) time = motion.first;
    stamps = [];
    before = performance.now();
    show();
    tell();
    if (playing) requestAnimationFrame(frame);
  };
  /** Takes new data; the animation stays at its time, as far as the data have it. */
  const take = (data) => {
    motion = readMotion(data);
    const { first, last, span } = motion;
    nameLines();
    time = clamp(time, first, last);
    Object.assign(slider, { min: first, max: last, step: span / 1000 || 1, disabled: !(span > 0) });
    play.disabled = slider.disabled;
    const offered = speedsFor(span, motion.suits);
    // A speed that was chosen for other data is kept if this motion offers it.
    if (!offered.includes(chosen)) chosen = null;
    if (offered.length !== speeds.length || offered.some((value, i) => Number(speeds[i].value) !== value))
      speeds.replaceChildren(...offered.map((value) => new Option(speedText(value), value)));
    speeds.value = speed();
    if (playing && !(span > 0)) toggle(false);
    tellChoices();
    show();
    if (!playing) tell();
  };

  slider.addEventListener("input", () => { time = clamp(Number(slider.value), motion.first, motion.last); show(); tell(); });
  play.addEventListener("click", () => toggle(!playing));
  speeds.addEventListener("change", () => { chosen = Number(speeds.value); tellChoices(); draw(); });
  byId("arrows")?.addEventListener("change", () => { nameLines(); draw(); });
  canvas.addEventListener("keydown", (event) => {
    if (event.key !== " ") return;
    toggle(!playing);
    event.preventDefault();
  });
  const label = element("label", "", "Shown ");
  label.append(speeds);
  controls.append(label);
  addMagnification(controls);
  controls.after(note, list);
  makeTurnable(canvas);
  kViewers.push(draw);
  kScene.changes.push(() => { tellChoices(); draw(); });
  kScene.shows.push(take);
  take(data);
  for (const change of kScene.changes) change();
  watch(canvas, draw);
  time = motion.first;
  toggle(motion.axis.count > 1 && !window.matchMedia("(prefers-reduced-motion: reduce)").matches);
}
