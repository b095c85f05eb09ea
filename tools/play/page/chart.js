// SPDX-License-Identifier: GPL-3.0-or-later
// The chart of the drift and its parts over time. The engine draws it as a report does: from looks at the motion, and as a band where the
// motion swings faster than a picture can show.

const kDriftColumns = [
  { column: "drift_axis_rad", label: "drift of the axis" },
  { column: "drift_azimuth_rad", label: "its azimuth, clockwise from above" },
  { column: "drift_tilt_rad", label: "its tilt" },
];

/** Arcseconds, or degrees where those are more readable. */
function angleUnit(largest_rad) {
  return largest_rad < 0.02 ? { name: "arcseconds", per_rad: 3600 / kRadian } : { name: "degrees", per_rad: 1 / kRadian };
}

/** Whether the page's style shows the drawings for a phone. */
const kNarrow = window.matchMedia("screen and (max-width: 49.99rem)");

/** The engine's drawing for the screen as it is: a desk's, or a phone's. */
function drawing(chart) {
  const width = kNarrow.matches ? "narrow" : "wide", box = element("div", width);
  box.append(document.importNode(new DOMParser().parseFromString(chart[width], "image/svg+xml").documentElement, true));
  return box;
}

/** The chart's figure: pictures, caption, and a table of output rows that is filled while it is open. */
function makeDriftChart(figure) {
  const details = element("details"), table = element("table"), caption = element("figcaption"), pictures = element("div");
  details.append(element("summary", "", "Values"), table);
  figure.append(pictures, caption, details);
  let columns = {};
  const row = (tag, cells) => {
    const made = element("tr");
    made.append(...cells.map((cell) => element(tag, "", cell)));
    return made;
  };
  const fill = () => {
    if (!details.open || !columns.t_s) return;
    const t = columns.t_s, stride = Math.max(1, Math.floor((t.length - 1) / 20)), head = element("thead"), body = element("tbody");
    const lines = kDriftColumns.map(({ column, label }) => ({ label, y: columns[column] ?? [] }));
    const unit = angleUnit(lines.flatMap(({ y }) => y.filter(isNumber)).reduce((most, x) => Math.max(most, Math.abs(x)), 0));
    head.append(row("th", ["time (s)", ...lines.map(({ label }) => `${label} (${unit.name})`)]));
    const cell = (x) => format(isNumber(x) ? x * unit.per_rad : x, 8);
    for (let i = 0; i < t.length; i += stride) body.append(row("td", [format(t[i], 8), ...lines.map(({ y }) => cell(y[i]))]));
    table.replaceChildren(head, body);
  };
  details.addEventListener("toggle", fill);
  let drawn = null;
  const draw = () => { if (drawn) pictures.replaceChildren(drawing(drawn)); };
  kNarrow.addEventListener("change", draw);
  return ({ summary, chart, columns: given }) => {
    const { axis_max_rad: most, axis_max_at_s: at_s } = summary.drift;
    drawn = chart;
    draw();
    caption.replaceChildren(chart.words);
    if (isNumber(most) && isNumber(at_s))
      caption.append(" The angle is at most ", ...numberElement(most, "rad", 10), ` (${angleText(most / kRadian)}), at `, ...numberElement(at_s, "s", 6), ".");
    columns = given;
    fill();
  };
}
