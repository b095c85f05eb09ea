// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the values under the pointer on the static charts.

function startCharts(charts) {
  for (const figure of document.querySelectorAll("figure.chart")) {
    const chart = Object.hasOwn(charts, figure.dataset.chart ?? "") ? charts[figure.dataset.chart] : null;
    const pictures = [...figure.querySelectorAll("svg.et")];
    if (pictures.length && chart?.plot && chart.x?.some(isNumber)) startChart(figure, pictures, chart);
  }
}

/** The index k in `list` for which place(k) is nearest to `where`. */
function nearest(list, place, where) {
  return list.reduce((best, _, k) => (Math.abs(place(k) - where) < Math.abs(place(best) - where) ? k : best), 0);
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
    const { left, right, width } = picture.closest(".narrow") && chart.narrow ? chart.narrow : chart.plot;
    const line = drawnElement("path", { class: "et-cross" });
    picture.append(line);
    return { picture, line, width, place: (x) => left + share(x) * (right - left) };
  });
  const readout = element("output", "readout", "Point at the chart, or focus it and use the arrow keys.");
  (pictures.at(-1).closest(".narrow, .wide") ?? pictures.at(-1)).after(readout);
  let current = -1;
  const show = (k) => {
    current = clamp(k, 0, order.length - 1);
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
  for (const { picture, place, width } of views) {
    const point = (event) => {
      const shown = picture.getBoundingClientRect();
      const x = ((event.clientX - shown.left) / shown.width) * width;
      const found = nearest(order, (k) => place(chart.x[order[k]]), x);
      if (found !== current) show(found);
    };
    picture.addEventListener("pointermove", point);
    picture.addEventListener("pointerdown", point);
  }
  figure.tabIndex = 0;
  figure.addEventListener("keydown", (event) => {
    const leap = Math.max(1, Math.round(order.length / 20));
    const to = { ArrowLeft: current - 1, ArrowRight: current + 1, PageUp: current - leap, PageDown: current + leap,
      Home: 0, End: order.length - 1 }[event.key];
    if (to === undefined || event.target !== figure) return;
    show(to);
    event.preventDefault();
  });
}
