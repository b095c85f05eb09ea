// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the values under the pointer on the static charts. It is the first part of every page's script.

/** What the parts of the script do with the page's data, once all of them are there. */
const kStarts = [(data) => startCharts(data.charts ?? {})];

/** The dashes of each colour, so that it can be told apart in grey. */
const kDashes = {
  axis: [], ref: [7, 4], gravity: [], coriolis: [11, 4], transverse: [2, 4], centrifugal: [11, 4, 2, 4], earth: [6, 6],
  precession: [2, 6],
};

function startCharts(charts) {
  for (const figure of document.querySelectorAll("figure.chart")) {
    const chart = Object.hasOwn(charts, figure.dataset.chart ?? "") ? charts[figure.dataset.chart] : null;
    const pictures = [...figure.querySelectorAll("svg.et")];
    if (!pictures.length || !chart?.plot) continue;
    if (chart.marks?.length) startMarks(figure, pictures, chart);
    else if (chart.x?.some(isNumber)) startChart(figure, pictures, chart);
  }
}

/** What a reader does to see a chart's values; where there is no pointer, a finger does it. */
function howToRead(what) {
  return kHasPointer ? `Point at ${what}, or focus the chart and use the arrow keys.` : `Tap ${what} to read its values.`;
}

/** The index k in `list` for which place(k) is nearest to `where`. */
function nearest(list, place, where) {
  return list.reduce((best, _, k) => (Math.abs(place(k) - where) < Math.abs(place(best) - where) ? k : best), 0);
}

/** The frame of the drawing that a picture is: for a desk, or (in an element of class narrow) for a phone. */
function frameOf(picture, chart) { return picture.closest(".narrow") && chart.narrow ? chart.narrow : chart.plot; }

/** Puts a line for values under a chart's drawings. */
function addReadout(pictures, text) {
  const readout = element("output", "readout", text);
  (pictures.at(-1).closest(".narrow, .wide") ?? pictures.at(-1)).after(readout);
  return readout;
}

/** Arrow keys, page keys, Home and End move through a chart's `count` places; `show` is given the new one. */
function moveByKeys(figure, count, current, show) {
  figure.tabIndex = 0;
  figure.addEventListener("keydown", (event) => {
    const leap = Math.max(1, Math.round(count / 20));
    const to = { ArrowLeft: current() - 1, ArrowRight: current() + 1, PageUp: current() - leap, PageDown: current() + leap,
      Home: 0, End: count - 1 }[event.key];
    if (to === undefined || event.target !== figure) return;
    show(clamp(to, 0, count - 1));
    event.preventDefault();
  });
}

/** Where a pointer is on a picture, in the picture's own px. */
function placeOn(picture, event) {
  const shown = picture.getBoundingClientRect(), box = picture.viewBox.baseVal;
  return [((event.clientX - shown.left) / shown.width) * box.width, ((event.clientY - shown.top) / shown.height) * box.height];
}

/** A chart whose points have texts: the one nearest to the pointer is ringed and its text shown. */
function startMarks(figure, pictures, chart) {
  const along = (value, low, high, scale) => {
    const f = (x) => (scale === "log" ? Math.log10(x) : x);
    return (f(value) - f(low)) / (f(high) - f(low) || 1);
  };
  const readout = addReadout(pictures, howToRead("a mark"));
  const views = pictures.map((picture) => {
    const at = frameOf(picture, chart), ring = drawnElement("circle", { class: "et-ring", r: 7, visibility: "hidden" });
    picture.append(ring);
    const places = chart.marks.map(([x, y]) => [at.left + along(x, at.x_min, at.x_max, at.x_scale) * (at.right - at.left),
      at.floor + along(y, at.y_min, at.y_max, at.y_scale) * (at.top - at.floor)]);
    return { picture, ring, places };
  });
  let current = -1;
  const show = (k) => {
    current = k;
    for (const { ring, places } of views) {
      const [cx, cy] = places[k];
      for (const [name, value] of Object.entries({ cx, cy, visibility: "visible" })) ring.setAttribute(name, value);
    }
    readout.textContent = chart.marks[k][2];
  };
  for (const { picture, places } of views) {
    const point = (event) => {
      const [x, y] = placeOn(picture, event);
      show(nearest(places, (k) => Math.hypot(places[k][0] - x, places[k][1] - y), 0));
    };
    picture.addEventListener("pointermove", point);
    picture.addEventListener("pointerdown", point);
  }
  moveByKeys(figure, chart.marks.length, () => current, show);
}

/** A chart is drawn twice, for a desk and for a phone (in an element of class narrow); the crosshair is in both. */
function startChart(figure, pictures, chart) {
  const { x_min, x_max, x_scale } = chart.plot;
  const scaled = (x) => (x_scale === "log" ? Math.log10(x) : x);
  const share = (x) => (scaled(x) - scaled(x_min)) / (scaled(x_max) - scaled(x_min) || 1);
  const order = [...chart.x.keys()].filter((i) => Number.isFinite(share(chart.x[i])));
  order.sort((i, j) => chart.x[i] - chart.x[j]);
  if (!order.length) return;
  const views = pictures.map((picture) => {
    const { left, right } = frameOf(picture, chart);
    const line = drawnElement("path", { class: "et-cross" });
    picture.append(line);
    return { picture, line, place: (x) => left + share(x) * (right - left) };
  });
  const readout = addReadout(pictures, howToRead("the chart"));
  let current = -1;
  const show = (k) => {
    current = k;
    const i = order[current];
    for (const { picture, line, place } of views)
      line.setAttribute("d", `M${place(chart.x[i])} 0v${picture.viewBox.baseVal?.height || 640}`);
    const values = (chart.series ?? []).filter(({ y }) => isNumber(y?.[i]));
    readout.replaceChildren(item(chart.x_label ?? "at", chart.x[i], chart.x_unit));
    readout.append(...values.map(({ label, unit, y }) => item(label, y[i], unit)));
  };
  const item = (label, value, unit) => {
    const made = element("span", "", `${label} `);
    made.append(element("b", "", `${format(value)} ${unit ?? ""}`));
    return made;
  };
  for (const { picture, place } of views) {
    const point = (event) => {
      const [x] = placeOn(picture, event), found = nearest(order, (k) => place(chart.x[order[k]]), x);
      if (found !== current) show(found);
    };
    picture.addEventListener("pointermove", point);
    picture.addEventListener("pointerdown", point);
  }
  moveByKeys(figure, order.length, () => current, show);
}
