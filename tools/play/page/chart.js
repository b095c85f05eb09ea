// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of the drift and its parts over time, drawn for the width that the page has.

const kDriftLines = [
  { column: "drift_axis_rad", label: "drift of the axis", name: "axis" },
  { column: "drift_azimuth_rad", label: "its azimuth, clockwise from above", name: "ref" },
  { column: "drift_tilt_rad", label: "its tilt", name: "coriolis" },
];

/** Arcseconds, or degrees where those are more readable. */
function angleUnit(largest_rad) {
  return largest_rad < 0.02 ? { name: "arcseconds", per_rad: 3600 / kRadian } : { name: "degrees", per_rad: 1 / kRadian };
}

/** Straight pieces through the rows; a row without a number, and the jump of an azimuth by half a turn, break the line. */
function curvePath(t, y, place, jump) {
  let text = "", joined = false;
  t.forEach((time, i) => {
    if (!isNumber(y[i])) { joined = false; return; }
    if (joined && Math.abs(y[i] - y[i - 1]) > jump) joined = false;
    const [px, py] = place(time, y[i]);
    text += `${joined ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`;
    joined = true;
  });
  return text;
}

/** A linear scale over all numbers among `values`. */
function linearScale(values) {
  const known = sorted(values);
  return numberScale(known[0] ?? 0, known.at(-1) ?? 0, false);
}

function chartText(x, y, text, anchor = "middle") {
  const made = drawnElement("text", { x, y, "text-anchor": anchor });
  made.textContent = text;
  return made;
}

function drawDriftChart(figure, columns) {
  const t = columns.t_s ?? [], width = Math.max(280, Math.min(760, figure.clientWidth || 640)), height = 250;
  const lines = kDriftLines.map((line) => ({ ...line, y: columns[line.column] ?? [] }));
  const all = lines.flatMap(({ y }) => y.filter(isNumber));
  const unit = angleUnit(all.reduce((most, x) => Math.max(most, Math.abs(x)), 0));
  for (const line of lines) line.y = line.y.map((x) => (isNumber(x) ? x * unit.per_rad : x));
  const vertical = linearScale([0, ...lines.flatMap(({ y }) => y)]), horizontal = linearScale(t);
  const left = 66, right = width - 12, top = 26, bottom = height - 40;
  const x = (time) => left + horizontal.of(time) * (right - left), y = (value) => bottom - vertical.of(value) * (bottom - top);
  const picture = drawnElement("svg", { class: "et", viewBox: `0 0 ${width} ${height}`, role: "img" });
  const title = drawnElement("title", {});
  title.textContent = `The drift and its parts in ${unit.name} over ${format(t.at(-1) ?? 0)} s; the values are in the table below`;
  picture.append(title, chartText(left, 16, unit.name, "start"), chartText(right, height - 6, "time in s", "end"));
  for (const value of vertical.ticks(4)) {
    picture.append(drawnElement("path", { class: "et-grid", d: `M${left} ${y(value)}H${right}` }),
      chartText(left - 6, y(value) + 4, format(value, 4), "end"));
  }
  for (const value of horizontal.ticks(width > 500 ? 6 : 4)) picture.append(chartText(x(value), bottom + 18, format(value, 4)));
  for (const line of lines) {
    const curve = drawnElement("path", { class: "curve", "stroke-dasharray": kDashes[line.name].join(" "),
      d: curvePath(t, line.y, (time, value) => [x(time), y(value)], Math.PI * unit.per_rad) });
    curve.style.stroke = `var(--${line.name})`;
    picture.append(curve);
  }
  return { picture, unit, lines };
}

/** The chart's figure: picture, legend, and a table that is filled while it is open. */
function makeDriftChart(figure) {
  const details = element("details"), table = element("table");
  details.append(element("summary", "", "Values"), table);
  figure.append(legend(kDriftLines.map(({ name, label }) => [name, label])), details);
  let shown = null, columns = {};
  const row = (tag, cells) => {
    const made = element("tr");
    made.append(...cells.map((cell) => element(tag, "", cell)));
    return made;
  };
  const fill = () => {
    if (!details.open || !shown) return;
    const t = columns.t_s, stride = Math.max(1, Math.floor((t.length - 1) / 20)), head = element("thead"), body = element("tbody");
    head.append(row("th", ["time (s)", ...shown.lines.map(({ label }) => `${label} (${shown.unit.name})`)]));
    for (let i = 0; i < t.length; i += stride) body.append(row("td", [t[i], ...shown.lines.map(({ y }) => y[i])].map((v) => format(v, 8))));
    table.replaceChildren(head, body);
  };
  const draw = () => {
    const made = drawDriftChart(figure, columns);
    figure.querySelector("svg.et")?.remove();
    figure.prepend(made.picture);
    shown = made;
    fill();
  };
  details.addEventListener("toggle", fill);
  let width = 0;
  new ResizeObserver(() => {
    if (columns.t_s && figure.clientWidth !== width) draw();
    width = figure.clientWidth;
  }).observe(figure);
  return (given) => { columns = given; draw(); };
}
