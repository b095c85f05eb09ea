// SPDX-License-Identifier: GPL-3.0-or-later
// How a top is drawn: a disc or a ball on its axis, or, where it tumbles, a box with an attitude of its own; solid with the
// Earth's rotation, in outline without it. The unit of length is the stem.

const kDisc = { height: 0.58, radius: 0.4, thickness: 0.09 };
const kAxisEnd = 1.2;  // where the axis ends, as far as it is drawn
const kCage = 1.12;  // radius of a cage's hoop, over that of the wheel in it

/** East and North, rotated by the smallest rotation that takes Up to the axis: unlike the line of nodes, they do not
 *  whirl when the axis passes the vertical. */
function across(axis) {
  const [x, y, z] = axis;
  if (z < -0.999999) return [[1, 0, 0], [0, -1, 0]];
  const f = 1 / (1 + z);
  return [[1 - x * x * f, -x * y * f, -x], [-x * y * f, 1 - y * y * f, -y]];
}

/** The shape to draw a top in, from its moments about the centre of mass and where that is. A box is the uniform one that has
 *  these moments; the proportions of a disc are a picture, not to scale. */
function shapeOf(top, hasAttitude, isOnTable) {
  const centre = top?.center_of_mass_m ?? [0, 0, 0], moments = top?.moments_about_center_kg_m2, mass = top?.mass_kg;
  const known = moments?.length === 3 && moments.every(isNumber) && centre.every(isNumber) && mass > 0;
  const equal = known && Math.max(...moments) - Math.min(...moments) < 1e-9 * Math.max(...moments);
  if (hasAttitude && known) {
    const sum = moments[0] + moments[1] + moments[2];
    const half = moments.map((moment) => Math.sqrt((1.5 * Math.max(0, sum - 2 * moment)) / mass));
    const unit = 0.75 / (Math.max(...half) + size(centre) || 1);
    return { kind: "box", half: half.map((x) => Math.max(x * unit, 0.02)), centre: times(unit, centre), unit };
  }
  if (!known) return { kind: "disc", ...kDisc };
  // A top whose centre of mass is below that of its tip's sphere is a ball, as a tippe top is.
  if (isOnTable) return (equal && size(centre) === 0) || centre[2] < 0 ? { kind: "ball", radius: 0.5, rolls: true } : { kind: "disc", ...kDisc };
  if (centre[2] === 0) return { kind: "disc", ...kDisc, height: 0, low: -0.7 };
  if (centre[2] > 0) return { kind: "disc", ...kDisc };
  const wide = (0.85 * Math.sqrt(2.5 * moments[2] / mass)) / -centre[2];
  if (equal) return { kind: "ball", radius: clamp(wide, 0.08, 0.3), height: -0.85 };
  return { kind: "disc", ...kDisc, height: -0.7, radius: clamp(wide, 0.1, kDisc.radius), low: -1, high: 0 };
}

/** Pen and projection in one; `place` is where what is drawn stands: the tip of a top on a table moves. */
function makeInk(pen, project, eye) {
  const ink = { pen, eye, place: [0, 0, 0] };
  ink.put = (p) => project(combine(1, ink.place, 1, p));
  ink.path = (points, colour, width = 1, dash = []) => {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    trace(pen, points.map(ink.put));
    pen.stroke();
    pen.setLineDash([]);
  };
  ink.line = (from, to, name, width) => ink.path([from, to], kPalette[name], width, kDashes[name] ?? []);
  ink.ring = (centre, p, q, radius) => {
    const [x, y] = ink.put(centre), [px, py] = ink.put(combine(1, centre, radius, p)), [qx, qy] = ink.put(combine(1, centre, radius, q));
    pen.beginPath();
    for (let k = 0; k < 48; ++k) {
      const c = Math.cos((k * Math.PI) / 24), s = Math.sin((k * Math.PI) / 24);
      pen.lineTo(x + c * (px - x) + s * (qx - x), y + c * (py - y) + s * (qy - y));
    }
    pen.closePath();
  };
  ink.outline = () => {
    pen.strokeStyle = kPalette.ref;
    pen.lineWidth = 2;
    pen.setLineDash(kDashes.ref);
    pen.stroke();
    pen.setLineDash([]);
  };
  ink.write = (text, x, y) => {
    pen.strokeStyle = kPalette.bg;
    pen.lineWidth = 3;
    pen.strokeText(text, x, y + 4);
    pen.fillStyle = kPalette.text;
    pen.fillText(text, x, y + 4);
  };
  return ink;
}

function paintArrow(ink, from, vector, name, text) {
  const { pen } = ink, to = combine(1, from, 1, vector), [x0, y0] = ink.put(from), [x, y] = ink.put(to);
  const length = Math.hypot(x - x0, y - y0);
  if (length < 1) return;
  ink.line(from, to, name, 2.5);
  const ux = (x - x0) / length, uy = (y - y0) / length, head = Math.min(10, length);
  pen.fillStyle = kPalette[name];
  const barb = (side) => [x - head * (ux - side * uy), y - head * (uy + side * ux)];
  trace(pen, [[x + 2 * ux, y + 2 * uy], barb(0.45), barb(-0.45)]);
  pen.fill();
  // Labels stand beyond the tip, on the side to which the arrow points, so that they seldom overlap; those of steep arrows
  // stand to the left, because "Up" stands to the right.
  pen.textAlign = ux < 0.2 ? "right" : "left";
  ink.write(text, x + 7 * ux + (ux < 0.2 ? -5 : 5), y + 14 * uy);
  pen.textAlign = "left";
}

/** A wheel about `axis`, from which p and q make a right angle with each other; a mark on it is turned from p to q. */
function paintWheel(ink, { centre, axis, p, q, radius, thickness }, turned, ghost) {
  const { pen, put, ring, eye } = ink, faceUp = dot(axis, eye) >= 0;
  const [low, high] = [-0.5, 0.5].map((side) => combine(1, centre, side * thickness, axis)), [near, far] = faceUp ? [high, low] : [low, high];
  const edge = times(radius, normalise(cross(axis, eye)) ?? p);
  if (ghost) {
    ring(near, p, q, radius);
    ink.outline();
    for (const side of [1, -1]) ink.path([low, high].map((face) => combine(1, face, side, edge)), kPalette.ref, 2);
    return;
  }
  // The rim of the disc: the far face, and the band between the outermost visible points of both faces.
  pen.fillStyle = kPalette["metal-dark"];
  ring(far, p, q, radius);
  pen.fill();
  trace(pen, [[low, 1], [low, -1], [high, -1], [high, 1]].map(([face, side]) => put(combine(1, face, side, edge))));
  pen.fill();
  ring(near, p, q, radius);
  pen.fillStyle = kPalette.metal;
  pen.fill();
  pen.strokeStyle = kPalette.fg;
  pen.lineWidth = 1;
  pen.stroke();
  pen.fillStyle = kPalette.axis;
  const spoke = (k) => {
    const angle = turned + k * 0.12;
    return put(combine(1, near, 0.95 * radius, combine(Math.cos(angle), p, Math.sin(angle), q)));
  };
  trace(pen, [put(near), ...[-3, -2, -1, 0, 1, 2, 3].map(spoke)]);
  pen.fill();
}

/** The hoop of a cage, in a plane through its axis, as far as it is on the eye's side of the wheel or on the other one. */
function paintHoop(ink, wheel, turned, ghost, front) {
  const radius = kCage * wheel.radius, across = combine(Math.cos(turned), wheel.p, Math.sin(turned), wheel.q);
  const runs = [[]];
  for (let k = 0; k <= 64; ++k) {
    const angle = (k * Math.PI) / 32, out = combine(Math.cos(angle), wheel.axis, Math.sin(angle), across);
    if ((dot(out, ink.eye) >= 0) === front) runs.at(-1).push(combine(1, wheel.centre, radius, out));
    else if (runs.at(-1).length) runs.push([]);
  }
  for (const run of runs) ink.path(run, kPalette[ghost ? "ref" : "metal-dark"], ghost ? 1.5 : 4, ghost ? kDashes.ref : []);
}

/** The outer gimbal about the pivot, in the plane of both axes, as far as it is on the eye's side or on the other one, and its axis. */
function paintGimbal(ink, { axis, normal, radius }, ghost, front) {
  const across = cross(axis, normal), colour = kPalette[ghost ? "ref" : "metal-dark"], runs = [[]];
  for (let k = 0; k <= 64; ++k) {
    const angle = (k * Math.PI) / 32, out = combine(Math.cos(angle), axis, Math.sin(angle), across);
    if ((dot(out, ink.eye) >= 0) === front) runs.at(-1).push(times(radius, out));
    else if (runs.at(-1).length) runs.push([]);
  }
  for (const run of runs) ink.path(run, colour, ghost ? 1.5 : 4, ghost ? kDashes.ref : []);
  for (const side of [1, -1])
    if ((side * dot(axis, ink.eye) >= 0) === front) ink.path([times(side * radius, axis), times(side * (radius + 0.15), axis)], colour, ghost ? 1.5 : 3);
}

/** @param caged  the angle of the cage about the axis, in which the wheel turns; null where there is none */
function paintDisc(ink, shape, axis, turned, ghost, caged = null) {
  const { height, radius, thickness, low: bottom = 0, high: top = 1 } = shape, along = (h) => times(h, axis);
  const [p, q] = across(axis), faceUp = dot(axis, ink.eye) >= 0, wheel = { centre: along(height), axis, p, q, radius, thickness };
  const low = along(height - thickness / 2), high = along(height + thickness / 2);
  const hoop = (front) => { if (caged !== null) paintHoop(ink, wheel, caged, ghost, front); };
  if (ghost) ink.line(along(bottom), along(top), "ref", 2);
  const stem = (from, to) => { if (!ghost) ink.line(from, to, "metal-dark", 6); };
  hoop(false);
  if (faceUp) stem(along(bottom), low); else stem(high, along(top));
  paintWheel(ink, wheel, turned, ghost);
  if (faceUp) stem(high, along(top)); else stem(along(bottom), low);
  hoop(true);
}

function paintBall(ink, shape, axis, turned, ghost) {
  const { pen, put, eye } = ink, { radius } = shape;
  const centre = shape.rolls ? [0, 0, radius] : times(shape.height, axis), [x, y] = put(centre);
  if (!shape.rolls) ink.line([0, 0, 0], centre, ghost ? "ref" : "metal-dark", ghost ? 2 : 3);
  const reach = Math.abs(put(combine(1, centre, radius, camera().right))[0] - x);
  pen.beginPath();
  pen.arc(x, y, reach, 0, 2 * Math.PI);
  if (ghost) return ink.outline();
  pen.fillStyle = kPalette.metal;
  pen.fill();
  pen.strokeStyle = kPalette.fg;
  pen.lineWidth = 1;
  pen.stroke();
  // The equator about the axis, and half a meridian that turns with the ball, where they face the eye.
  const [p, q] = across(axis), to = combine(Math.cos(turned), p, Math.sin(turned), q);
  const circle = (u, v, from, end) => Array.from({ length: 49 }, (_, i) => {
    const a = from + (i / 48) * (end - from);
    return combine(Math.cos(a), u, Math.sin(a), v);
  }).filter((n) => dot(n, eye) > 0).map((n) => combine(1, centre, radius, n));
  pen.lineCap = "round";
  for (const n of circle(p, q, 0, 2 * Math.PI)) spot(pen, put(n), 1, kPalette["metal-dark"]);
  ink.path(circle(axis, to, 0, Math.PI), kPalette.axis, 3);
}

/** The rotor in a box, whose faces are then drawn over it. */
function paintRotor(ink, shape, rotor, turned, place, ghost) {
  const [c, p, q] = rotor.axes_B.map(place), radius = clamp(rotor.radius_m * shape.unit, 0.08, 0.6);
  paintWheel(ink, { centre: place(times(shape.unit, rotor.center_m)), axis: c, p, q, radius, thickness: 0.2 * radius }, turned, ghost);
}

/** The faces of the box that face the eye; the ends of body axis 3 are marked. A box with a rotor or moving masses is of glass. */
function paintBox(ink, shape, { attitude, carry, rotor, turned, masses = [] }, ghost) {
  const { pen, put, eye } = ink, place = (b) => carry(turnedBy(attitude, b));
  const centre = place(shape.centre), edges = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(place);
  if (size(centre) > 0.02) ink.line([0, 0, 0], centre, ghost ? "ref" : "metal-dark", ghost ? 2 : 4);
  if (rotor) paintRotor(ink, shape, rotor, turned, place, ghost);
  for (const mass of masses) spot(pen, put(place(times(shape.unit, mass))), ghost ? 6 : 5, kPalette[ghost ? "ref" : "metal-dark"], ghost ? 2 : 0);
  for (let k = 0; k < 3; ++k) for (const side of [1, -1]) {
    const normal = times(side, edges[k]);
    if (dot(normal, eye) <= 0) continue;
    const middle = combine(1, centre, shape.half[k], normal), [a, b] = [(k + 1) % 3, (k + 2) % 3];
    const corner = (s, t) => put(combine(1, middle, 1, combine(s * shape.half[a], edges[a], t * shape.half[b], edges[b])));
    trace(pen, [corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)]);
    pen.closePath();
    if (ghost) {
      ink.outline();
      continue;
    }
    const clear = rotor || masses.length ? 0.3 : 1;
    pen.globalAlpha = clear;
    pen.fillStyle = kPalette.metal;
    pen.fill();
    pen.globalAlpha = 0.7 * clear * (1 - dot(normal, eye));
    pen.fillStyle = kPalette["metal-dark"];
    pen.fill();
    pen.globalAlpha = 1;
    pen.strokeStyle = kPalette.fg;
    pen.lineWidth = 1;
    pen.stroke();
    if (k !== 2) continue;
    ink.ring(middle, edges[0], edges[1], 0.6 * Math.min(shape.half[0], shape.half[1]));
    pen.fillStyle = pen.strokeStyle = kPalette.axis;
    if (side > 0) pen.fill(); else pen.stroke();
  }
}

function paintBody(ink, shape, drawn, ghost) {
  const gimbal = drawn.gimbal && { ...drawn.gimbal, radius: shape.kind === "box" ? 1.05 : 0.72 };
  if (gimbal) paintGimbal(ink, gimbal, ghost, false);
  paintAnyBody(ink, shape, drawn, ghost);
  if (gimbal) paintGimbal(ink, gimbal, ghost, true);
}

function paintAnyBody(ink, shape, drawn, ghost) {
  const { axis, turned, attitude, rotor, caged } = drawn;
  if (shape.kind === "box" && attitude) paintBox(ink, shape, drawn, ghost);
  else if (axis && rotor) paintDisc(ink, shape.kind === "disc" ? shape : kDisc, axis, caged + turned, ghost, caged);
  else if (!axis) return;
  else if (shape.kind === "ball") paintBall(ink, shape, axis, turned, ghost);
  else paintDisc(ink, shape.kind === "disc" ? shape : kDisc, axis, turned, ghost);
}

/** Where on the axis it begins and ends as it is drawn, from the pivot, or from the centre of a ball that rolls. */
function axisEnds(shape) {
  if (shape.rolls) return [-1.4 * shape.radius, 1.4 * shape.radius];
  return shape.height < 0 ? [0.2, -kAxisEnd] : [-0.12, kAxisEnd];
}

/** The axis as a line through the body and beyond it; with `over`, only what the body does not hide. */
function paintAxis(ink, shape, axis, name, over) {
  let [from, to] = axisEnds(shape);
  const faces = dot(axis, ink.eye) >= 0;
  if (over && shape.rolls) [from, to] = faces ? [shape.radius, to] : [-shape.radius, from];
  else if (over && shape.kind === "disc" && faces) from = shape.height + shape.thickness / 2;
  else if (over && shape.kind !== "box") return;
  ink.line(times(from, axis), times(to, axis), name, 2);
}

/** The cone that the predicted axis moves on: the part of it that lies about the time shown. */
function paintCone(ink, shape, path) {
  const { pen, put } = ink, rim = path.map((p) => times(Math.abs(axisEnds(shape)[1]), p));
  trace(pen, [put([0, 0, 0]), ...rim.map(put)]);
  pen.closePath();
  pen.globalAlpha = 0.1;
  pen.fillStyle = kPalette.ref;
  pen.fill();
  pen.globalAlpha = 0.6;
  ink.path(rim, kPalette.ref, 1.25);
  pen.globalAlpha = 1;
}

/** The ground, both tops, and the vectors that act. */
function paintTop(pen, project, eye, scene) {
  const origin = [0, 0, 0], ink = makeInk(pen, project, eye), { put } = ink, { shape, body, ghost } = scene;
  ink.ring(origin, [1, 0, 0], [0, 1, 0], 0.75);
  pen.strokeStyle = kPalette.line;
  pen.lineWidth = 1;
  pen.stroke();
  for (const [name, tip] of [["East", [0.75, 0, 0]], ["North", [0, 0.75, 0]], ["Up", [0, 0, 1.25]]]) {
    ink.line(origin, tip, "line", 1);
    const [x, y] = put(tip);
    ink.write(name, x + 4, y);
  }
  // A ball that rolls is drawn about its centre.
  const raised = (tip) => (shape.rolls ? combine(1, tip, shape.radius, [0, 0, 1]) : tip);
  ink.place = raised(scene.refTip);
  if (scene.cone.length > 2) paintCone(ink, shape, scene.cone);
  ink.place = origin;
  if (scene.earth) paintArrow(ink, origin, times(1.2, scene.earth), "earth", "Earth's axis");
  if (scene.precession) paintArrow(ink, origin, times(1.1, scene.precession), "precession", "precession axis");
  if (scene.path.length > 1) ink.path(scene.path, kPalette.axis);
  // The end of the axis that is marked: below the pivot where the top hangs from it.
  const end = (axis) => combine(axisEnds(shape)[1], axis, shape.rolls ? shape.radius : 0, [0, 0, 1]);
  const axisOf = (axis, tip, name, over) => {
    ink.place = raised(tip);
    paintAxis(ink, shape, axis, name, over);
    ink.place = tip;
  };
  for (const [drawn, tip, name, ghostly] of [[body, scene.tip, "axis", false], [ghost, scene.refTip, "ref", true]]) {
    ink.place = tip;
    if (drawn.axis) axisOf(drawn.axis, tip, name, false);
    paintBody(ink, shape, drawn, ghostly);
    if (!drawn.axis) continue;
    axisOf(drawn.axis, tip, name, true);
    spot(pen, put(end(drawn.axis)), ghostly ? 8 : 4.5, kPalette[name], ghostly ? 2 : 0);
  }
  ink.place = scene.tip;
  const centre = shape.kind === "disc" ? times(shape.height, body.axis ?? ghost.axis ?? origin) : shape.centre && body.attitude ?
    turnedBy(body.attitude, shape.centre) : origin;
  for (const { name, says, vector } of scene.torques) paintArrow(ink, centre, times(0.6, vector), name, says);
}
