// SPDX-License-Identifier: GPL-3.0-or-later
// The explorer of a study: pictures of its points, or of how densely many points lie. Each point has its scenario.

/** A colour from dark to light, perceived as even steps (OKLCH), so that it is readable in grey and by the colour-blind. */
function shade(u) { return `oklch(${0.27 + 0.66 * u} ${0.06 + 0.28 * u * (1 - u)} ${285 - 185 * u})`; }

const kLogarithmicFrom = 100;  // positive numbers that span a larger ratio get a logarithmic scale

function sorted(values) { return values.filter(isNumber).sort((a, b) => a - b); }
function share(values, part) { return values[Math.round(part * (values.length - 1))]; }

/** A scale from `low` to `high`: `of` takes a number to 0 to 1 there, `ticks` gives about `count` round numbers. */
function numberScale(low, high, log) {
  const f = (x) => (log ? Math.log10(x) : x);
  const of = (x) => (f(high) > f(low) ? (f(x) - f(low)) / (f(high) - f(low)) : 0.5);
  const inside = (list) => list.filter((x) => of(x) > -1e-9 && of(x) < 1 + 1e-9);
  const ticks = (count) => {
    if (!(f(high) > f(low))) return [low];
    const decades = f(high) - f(low);
    if (log && decades >= 2) {
      const stride = Math.ceil(decades / count), first = Math.ceil(f(low) - 1e-9);
      return inside(Array.from({ length: Math.floor(decades / stride) + 2 }, (_, k) => 10 ** (first + k * stride)));
    }
    const step = roundUp((high - low) / Math.max(1, count));
    const first = Math.ceil(low / step - 1e-9);
    return inside(Array.from({ length: Math.floor((high - low) / step) + 2 }, (_, k) => (first + k) * step));
  };
  return { of, ticks, log, low, high };
}

/** Rounds up to 1, 2 or 5 times a power of ten. */
function roundUp(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((lead) => lead * decade >= value * (1 - 1e-9)) ?? 10) * decade;
}

/** A scale with one place for each value, words among them. */
function placeScale(values) {
  const at = new Map(values.map((value, k) => [value, k]));
  const of = (value) => ((at.get(value) ?? 0) + 0.5) / values.length;
  const ticks = (count) => values.filter((_, k) => k % Math.ceil(values.length / Math.max(1, count)) === 0);
  return { of, ticks, log: false };
}

/** Whether numbers lie more evenly on a logarithmic scale. */
function suitsLogarithm(known) {
  const [low, middle, high] = [known[0], share(known, 0.5), known.at(-1)];
  if (!(low > 0 && high / low > kLogarithmicFrom)) return false;
  const off = (f) => Math.abs((f(middle) - f(low)) / (f(high) - f(low)) - 0.5);
  return off(Math.log) <= off((x) => x);
}

/** The scale of an axis, and for each of its values the edges of its cell. */
function axisScale(values) {
  const known = [...new Set(sorted(values))];
  if (known.length < 2 || values.some((value) => !isNumber(value))) {
    const different = [...new Set(values)], places = placeScale(different);
    const half = 0.5 / different.length;
    return { ...places, edges: (value) => [places.of(value) - half, places.of(value) + half] };
  }
  const log = suitsLogarithm(known), f = log ? Math.log10 : (x) => x, back = log ? (x) => 10 ** x : (x) => x;
  const middles = known.slice(1).map((x, k) => (f(x) + f(known[k])) / 2);
  const borders = [2 * f(known[0]) - middles[0], ...middles, 2 * f(known.at(-1)) - middles.at(-1)];
  const scale = numberScale(back(borders[0]), back(borders.at(-1)), log);
  const part = (x) => (x - borders[0]) / (borders.at(-1) - borders[0]);
  const at = new Map(known.map((x, k) => [x, k]));
  return { ...scale, edges: (value) => [part(borders[at.get(value)]), part(borders[at.get(value) + 1])] };
}

/** The scale of a quantity. A few values far from all others do not stretch it: it ends three times the middle half of the
 *  values beyond that half, and what lies outside is counted. */
function valueScale(values, logWanted) {
  const known = sorted(values);
  if (!known.length) return null;
  const wide = logWanted && known[0] > 0 && known.at(-1) / known[0] > kLogarithmicFrom;
  const f = (x) => (wide ? Math.log(x) : x), back = (x) => (wide ? Math.exp(x) : x);
  const [quarter, threeQuarters] = [f(share(known, 0.25)), f(share(known, 0.75))], half = threeQuarters - quarter;
  const inside = known.filter((x) => half === 0 || (f(x) >= quarter - 3 * half && f(x) <= threeQuarters + 3 * half));
  const [low, high] = [inside[0], inside.at(-1)];
  const scale = numberScale(low, high, wide && high / low > kLogarithmicFrom);
  const below = known.filter((x) => x < low), above = known.filter((x) => x > high);
  return { ...scale, of: (x) => clamp(scale.of(clamp(x, low, high)), 0, 1), below, above };
}

function outsideText(scale) {
  if (!scale) return "";
  const points = (list) => `${list.length} ${list.length === 1 ? "point lies" : "points lie"}`;
  const parts = [];
  if (scale.below.length) parts.push(`\u25bc ${points(scale.below)} below the scale, the least at ${format(scale.below[0], 4)}.`);
  if (scale.above.length) parts.push(`\u25b2 ${points(scale.above)} above the scale, the largest at ${format(scale.above.at(-1), 4)}.`);
  return parts.join(" ");
}

// --- words

/** The study with settings and quantities as the page calls them, and numbers in the units that it shows. */
function inWords(data) {
  const { axes, quantities } = data.words, scaled = (value, q) => (isNumber(value) ? value * (quantities[q].factor ?? 1) : value);
  const label = ({ words, unit }) => (unit ? `${words} (${unit})` : words);
  return {
    ...data,
    axes: data.axes.map((axis, k) => ({ ...axis, name: axes[k].words, label: label(axes[k]), unit: axes[k].unit })),
    quantities: quantities.map(({ words }) => words),
    labels: quantities.map(label),
    units: quantities.map(({ unit }) => unit),
    points: data.points?.map((point) => ({ ...point, values: point.values.map(scaled) })),
    scales: data.scales?.map((scale, q) => (isNumber(scale.low) ? { ...scale, low: scaled(scale.low, q), high: scaled(scale.high, q) } : scale)),
    pictures: data.pictures?.map((picture) => ({ ...picture,
      cells: picture.cells.map(([i, j, count, mean, example]) => [i, j, count, scaled(mean, picture.quantity), example]) })),
  };
}

/** A number with its unit: "235.2″", "200 rad/s". */
function withUnit(value, unit, digits) {
  return isNumber(value) && unit ? `${format(value, digits)}${/^[°″]$/.test(unit) ? "" : " "}${unit}` : format(value, digits);
}

// --- the scenario of a point

function quoted(text) { return `'${text.replaceAll("'", "'\\''")}'`; }

/** The command that runs a point: the study's base with the point's values. */
function pointCommand(data, values) {
  if (!values) return "This point has no scenario.";
  const changes = [...data.fixed.map(([pointer, value]) => `${pointer}=${value}`),
    ...data.pointers.flatMap((pointer, k) => (values[k] === null ? [] : [`${pointer}=${JSON.stringify(values[k])}`]))];
  const lines = `\n${data.base.replace(/^\ufeff/, "")}\n`;
  let end = "EOF";
  while (lines.includes(`\n${end}\n`)) end += "_";
  const set = changes.map((change) => ` --set ${quoted(change)}`).join("");
  return `earthtop run -${set} --out point <<'${end}'${lines}${end}\nearthtop report point\n`;
}

// --- pictures: each has scales, marks at (x, y), and words

/** What all pictures of single points need of them. */
function pointsOf(data) {
  return data.points.map((point) => ({
    ...point,
    at: data.axes.map((axis, k) => axis.values[point.axes[k]]),
    where: data.axes.map((axis, k) => `${axis.name} ${withUnit(axis.values[point.axes[k]], axis.unit)}`).join(", "),
  }));
}

function markOf(point, { x, y, quantity, data, ...more }) {
  const value = point.values[quantity];
  return { x, y, value, ...more, number: point.number, set: point.set, text: `${point.where}: ${data.quantities[quantity]} ${withUnit(value, data.units[quantity], 8)}.` };
}

/** A quantity over the only axis, or over one of several. */
function curvePicture(data, points, { quantity, across, log }) {
  const x = axisScale(points.map((point) => point.at[across]));
  const y = valueScale(points.map((point) => point.values[quantity]), log);
  const marks = points.map((point) => markOf(point, { x: x.of(point.at[across]), y: y?.of(point.values[quantity]), quantity, data }));
  return { xTitle: data.axes[across].label, yTitle: data.labels[quantity], x, y, marks, outside: y };
}

/** A quantity as a colour: cells where every pair of values has its point, else dots. */
function mapPicture(data, points, { quantity, across, up, log, cells }) {
  const x = axisScale(points.map((point) => point.at[across])), y = axisScale(points.map((point) => point.at[up]));
  const colour = valueScale(points.map((point) => point.values[quantity]), log);
  const marks = points.map((point) => markOf(point, {
    x: x.of(point.at[across]), y: y.of(point.at[up]), quantity, data,
    cell: cells ? [...x.edges(point.at[across]), ...y.edges(point.at[up])] : null,
  }));
  return { xTitle: data.axes[across].label, yTitle: data.axes[up].label, title: data.labels[quantity], x, y, colour, marks, outside: colour };
}

/** Cells of many points: how many there are over an axis and a quantity, or the mean of the quantity over two axes. */
function cellPicture(data, { quantity, across, up, cells }, log) {
  const name = data.quantities[quantity], unit = data.units[quantity], counted = up === null;
  const side = (given) => {
    if (given.values) {
      const scale = axisScale(given.values);
      return { scale, edges: (k) => scale.edges(given.values[k]), text: (k) => format(given.values[k], 4) };
    }
    const scale = numberScale(given.low, given.high, given.log);
    const f = (k) => (given.log ? given.low * (given.high / given.low) ** (k / given.cells)
      : given.low + (given.high - given.low) * (k / given.cells));
    return { scale, edges: (k) => [k / given.cells, (k + 1) / given.cells], text: (k) => `${format(f(k), 4)} to ${format(f(k + 1), 4)}` };
  };
  const x = side(data.axes[across].scale), y = side(counted ? data.scales[quantity] : data.axes[up].scale);
  const values = cells.map((cell) => cell[counted ? 2 : 3]), colour = counted ? fullScale(values, log) : valueScale(values, log);
  const yTitle = counted ? data.labels[quantity] : data.axes[up].label;
  const marks = cells.map(([i, j, count, mean, example]) => {
    const cell = [...x.edges(i), ...y.edges(j)];
    return {
      x: (cell[0] + cell[1]) / 2, y: (cell[2] + cell[3]) / 2, cell, value: counted ? count : mean, number: example, count, mean,
      set: data.examples[example],
      text: `${data.axes[across].label} ${x.text(i)}, ${yTitle} ${y.text(j)}: ${count} ${count === 1 ? "point" : "points"}, ` +
        `mean of ${name} ${withUnit(mean, unit, 8)}; for example point ${example + 1}.`,
    };
  });
  const title = counted ? "number of points" : `mean of ${data.labels[quantity]}`;
  return { xTitle: data.axes[across].label, yTitle, title, x: x.scale, y: y.scale, colour, marks, outside: counted ? null : colour };
}

/** The scale of numbers of which none is left outside. */
function fullScale(values, logWanted) {
  const known = sorted(values), log = logWanted && known.at(-1) / known[0] > kLogarithmicFrom;
  return numberScale(known[0], known.at(-1), log);
}

// --- drawing

const kTickHeight = 26;  // least distance of two ticks (CSS px)

/** Draws a picture and returns where its marks are, as pairs of CSS pixels. */
function drawPicture({ pen, width, height }, picture, chosen) {
  const { x, y, colour, marks } = picture;
  const write = (text, left, base, align = "left") => {
    pen.textAlign = align;
    pen.fillStyle = kPalette.text;
    pen.fillText(text, left, base);
  };
  if (!y || !marks.length || (picture.title && !colour)) {
    write("no values", width / 2, height / 2, "center");
    return marks.map(() => [width / 2, height / 2]);
  }
  const top = colour ? 92 : 40, bottom = height - 50;
  const rows = y.ticks(Math.floor((bottom - top) / kTickHeight));
  const left = Math.max(...rows.map((value) => pen.measureText(format(value, 4)).width), 24) + 14, right = width - 16;
  const across = (u) => left + u * (right - left), upward = (u) => bottom - u * (bottom - top);

  write(fitted(pen, `${picture.yTitle}${y.log ? ", logarithmic" : ""}`, width - 16), 8, top - 12);
  write(fitted(pen, `${picture.xTitle}${x.log ? ", logarithmic" : ""}`, right - left), (left + right) / 2, height - 8, "center");
  pen.strokeStyle = kPalette.grid;
  pen.lineWidth = 1;
  for (const value of rows) {
    trace(pen, [[left, upward(y.of(value))], [right, upward(y.of(value))]]);
    pen.stroke();
    write(format(value, 4), left - 8, upward(y.of(value)) + 4, "right");
  }
  let free = 0;
  for (const value of x.ticks(Math.max(2, Math.floor((right - left) / 55)))) {
    const text = format(value, 4), half = pen.measureText(text).width / 2, at = across(x.of(value));
    trace(pen, [[at, bottom], [at, bottom + 5]]);
    pen.stroke();
    const place = clamp(at, half + 2, width - half - 2);
    if (place - half - 6 < free && free > 0) continue;
    write(text, place, bottom + 20, "center");
    free = place + half;
  }
  if (colour) drawColours(pen, { colour, title: picture.title, write, width });

  const places = marks.map((mark) => [across(mark.x), upward(mark.y ?? 0)]);
  marks.forEach((mark, k) => drawMark(pen, mark, places[k], { picture, across, upward, chosen: k === chosen }));
  if (marks[chosen]) drawMark(pen, marks[chosen], places[chosen], { picture, across, upward, chosen: true });
  return places;
}

/** Text shortened to a width, with an ellipsis. */
function fitted(pen, text, room) {
  if (pen.measureText(text).width <= room) return text;
  let length = text.length;
  while (length > 1 && pen.measureText(`${text.slice(0, length)}…`).width > room) --length;
  return `${text.slice(0, length)}…`;
}

function drawColours(pen, { colour, title, write, width }) {
  const long = Math.min(320, width - 60), from = 22;
  write(fitted(pen, `${title}${colour.log ? ", logarithmic" : ""}`, width - 16), 8, 18);
  for (let k = 0; k < 64; ++k) {
    pen.fillStyle = shade(k / 63);
    pen.fillRect(from + (long * k) / 64, 27, long / 64 + 0.6, 13);
  }
  let free = 0;
  for (const value of colour.ticks(Math.floor(long / 60))) {
    const text = format(value, 4), half = pen.measureText(text).width / 2, at = Math.max(half + 2, from + long * colour.of(value));
    if (free && at - half - 6 < free) continue;
    write(text, at, 56, "center");
    free = at + half;
  }
}

function drawMark(pen, mark, [x, y], { picture, across, upward, chosen }) {
  const { colour } = picture, known = isNumber(mark.value), scale = picture.outside;
  const outside = known && scale && (mark.value < scale.low ? -1 : mark.value > scale.high ? 1 : 0);
  if (mark.cell) {
    const [l, r, b, t] = [across(mark.cell[0]), across(mark.cell[1]), upward(mark.cell[2]), upward(mark.cell[3])];
    if (known) {
      pen.fillStyle = shade(colour.of(mark.value));
      pen.fillRect(l, t, r - l + 0.6, b - t + 0.6);  // slightly larger than the cell, so that no seams show
    } else {
      pen.strokeStyle = kPalette.muted;
      trace(pen, [[l + (r - l) / 4, b + (t - b) / 4], [r + (l - r) / 4, t + (b - t) / 4]]);
      pen.stroke();
    }
    if (chosen) frame(pen, () => pen.strokeRect(l, t, r - l, b - t));
  } else if (known && !outside) {
    spot(pen, [x, y], chosen ? 8 : 4, colour ? shade(colour.of(mark.value)) : chosen ? kPalette.axis : kPalette.ref);
    if (colour) spot(pen, [x, y], chosen ? 8 : 4, kPalette.muted, 1);
    if (chosen) frame(pen, () => { pen.beginPath(); pen.arc(x, y, 8, 0, 2 * Math.PI); pen.stroke(); });
  }
  if (outside) {
    trace(pen, [[x - 5, y - 4 * -outside], [x + 5, y - 4 * -outside], [x, y + 5 * -outside]]);
    pen.closePath();
    pen.fillStyle = chosen ? kPalette.axis : mark.cell ? (outside < 0 ? "#fff" : "#000") : kPalette.ref;
    pen.fill();
  }
}

/** Black in white, so that it shows on every colour. */
function frame(pen, stroke) {
  for (const [colour, width] of [["#fff", 5], ["#000", 2]]) {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    stroke();
  }
}

// --- the controls

/** The explorer's parts, in its place on the page. */
function explorerParts(room) {
  room.classList.add("study");
  const controls = element("div", "controls"), canvas = element("canvas", "plane");
  const outside = element("p", "note outside"), state = element("p", "note state"), shown = element("div", "point");
  const scenario = element("pre", "scenario command"), copy = element("button", "copy", "Copy");
  Object.assign(copy, { type: "button" });
  scenario.tabIndex = canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  state.setAttribute("aria-live", "polite");
  shown.hidden = true;
  shown.append(scenario, copy);
  makeCopying(copy);
  room.append(controls, canvas, outside, state, shown);
  const add = (name, ...parts) => {
    const label = element("label", "", name);
    label.append(...parts);
    controls.append(label);
  };
  const choice = (name, texts, chosen = 0) => {
    const select = element("select");
    texts.forEach((text, k) => select.append(new Option(text, k)));
    select.selectedIndex = chosen;
    add(name, select);
    return select;
  };
  const log = Object.assign(element("input"), { type: "checkbox", checked: true });
  return { controls, canvas, outside, state, shown, scenario, add, choice, log, addLog: () => add("Logarithmic over many decades ", log) };
}

/** The mark next to the chosen one in a direction: nearest, and more ahead than aside. */
function neighbour(places, chosen, [right, down]) {
  const [x, y] = places[chosen];
  let best = chosen, least = Infinity;
  places.forEach(([u, v], k) => {
    const ahead = (u - x) * right + (v - y) * down, aside = Math.abs((u - x) * down) + Math.abs((v - y) * right);
    const far = ahead + 3 * aside;
    if (ahead > 0.5 && far < least) [best, least] = [k, far];
  });
  return best;
}

/** Shows the picture that `make` gives, and its marks by pointer and keyboard. */
function explore(parts, data, make) {
  const { canvas, outside, state, shown, scenario } = parts;
  let picture = make(), chosen = 0, places = [];
  const draw = () => {
    const page = penOf(canvas);
    if (page) places = drawPicture(page, picture, chosen);
  };
  const tell = () => {
    const mark = picture.marks[chosen];
    state.textContent = (mark?.text ?? "") + (shown.hidden ? ` ${kHasPointer ? "Click" : "Tap"} a point${kHasPointer ? ", or press Enter," : ""} for its scenario${kHasPointer ? "; arrow keys move" : ""}.` : "");
    if (!shown.hidden) scenario.textContent = pointCommand(data, mark?.set);
    draw();
  };
  const change = () => {
    const before = picture.marks[chosen]?.number;
    picture = make();
    chosen = Math.max(0, picture.marks.findIndex((mark) => mark.number === before));
    outside.textContent = outsideText(picture.outside);
    canvas.setAttribute("aria-label", `${picture.title ? `${picture.title}; ` : ""}${picture.yTitle} over ${picture.xTitle}`);
    tell();
  };
  const open = () => { shown.hidden = false; tell(); };
  canvas.addEventListener("click", (event) => {
    if (!places.length) return;
    chosen = nearestPlace(places, [event.offsetX, event.offsetY]);
    open();
  });
  canvas.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (event.key === "Enter") open();
    else if (way && places.length) {
      chosen = neighbour(places, chosen, way);
      tell();
    } else return;
    event.preventDefault();
  });
  parts.controls.addEventListener("change", change);
  parts.controls.addEventListener("input", change);
  watch(canvas, draw);
  change();
}

function nearestPlace(places, [x, y]) {
  return nearest(places, (k) => Math.hypot(places[k][0] - x, places[k][1] - y), 0);
}

kStarts.push(startStudy);

function startStudy(data) {
  const room = byId("explorer");
  if (!room || !data.axes?.length || !data.quantities?.length) return;
  const told = inWords(data);
  if (data.pictures?.length) exploreCells(explorerParts(room), told);
  else if (data.points?.length && data.drawn_above) choosePoints(explorerParts(room), told);
  else if (data.points?.length) explorePoints(explorerParts(room), told);
}

/** The points of curves that the page has drawn already: one to choose, with its numbers and its scenario. */
function choosePoints({ canvas, outside, state, shown, scenario, choice, controls }, data) {
  canvas.remove();
  outside.remove();
  const points = pointsOf(data), point = choice("Point ", points.map(({ where }) => where));
  const tell = () => {
    const { where, values, set } = points[point.selectedIndex];
    const numbers = values.map((value, q) => `${data.quantities[q]} ${withUnit(value, data.units[q], 8)}`);
    state.textContent = `${where}: ${numbers.join("; ")}.`;
    scenario.textContent = pointCommand(data, set);
  };
  shown.hidden = false;
  controls.addEventListener("change", tell);
  tell();
}

function exploreCells(parts, data) {
  const name = ({ quantity, across, up }) => (up === null ? `${data.quantities[quantity]} over ${data.axes[across].name}, number of points`
    : `mean of ${data.quantities[quantity]} over ${data.axes[across].name} and ${data.axes[up].name}`);
  const picture = parts.choice("Picture ", data.pictures.map(name));
  parts.addLog();
  explore(parts, data, () => cellPicture(data, data.pictures[picture.selectedIndex], parts.log.checked));
}

/** A grid of two axes or more is shown as a map, with a slider for each further axis; other points as dots, over axes to
 *  choose. */
function explorePoints(parts, data) {
  const points = pointsOf(data), { axes } = data, names = axes.map((axis) => axis.name);
  const whole = points.length === axes.reduce((count, axis) => count * axis.values.length, 1);
  const quantity = parts.choice("Quantity ", data.quantities);
  const drawn = !whole && axes.length > 1;
  const across = drawn ? parts.choice("Across ", names) : null;
  const up = drawn ? parts.choice("Upwards ", [...names, "the quantity"], 1) : null;
  parts.addLog();
  const sliders = whole ? axes.slice(2).map((axis) => {
    const slider = Object.assign(element("input"), { type: "range", min: 0, max: axis.values.length - 1, value: 0 });
    const value = element("output", "", format(axis.values[0]));
    slider.addEventListener("input", () => { value.textContent = format(axis.values[Number(slider.value)]); });
    parts.add(`${axis.name} `, slider, value);
    return slider;
  }) : [];
  explore(parts, data, () => {
    const how = { quantity: quantity.selectedIndex, across: across?.selectedIndex ?? 0, log: parts.log.checked };
    const cut = points.filter((point) => sliders.every((slider, k) => point.axes[k + 2] === Number(slider.value)));
    if (axes.length === 1) return curvePicture(data, cut, how);
    const upwards = up?.selectedIndex ?? 1;
    if (upwards === axes.length) return curvePicture(data, cut, how);
    return mapPicture(data, cut, { ...how, up: upwards, cells: whole });
  });
}
