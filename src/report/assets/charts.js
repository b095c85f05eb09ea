// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the values under the pointer on the static charts, and runs the explorer of a study.

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

/** A colour from dark to light, perceived as even steps (OKLCH), so that it is readable in grey and by the colour-blind. */
function shade(u) { return `oklch(${0.27 + 0.66 * u} ${0.06 + 0.28 * u * (1 - u)} ${285 - 185 * u})`; }

/** The scale is logarithmic if `wanted` allows it, all values are positive, and they span more than two decades. */
function makeScale(values, wanted = true) {
  const known = values.filter(isNumber);
  const low = known.reduce((a, b) => Math.min(a, b), Infinity), high = known.reduce((a, b) => Math.max(a, b), -Infinity);
  const log = wanted && low > 0 && high / low > 100;
  const f = (x) => (log ? Math.log10(x) : x);
  const of = (x) => (high > low ? (f(x) - f(low)) / (f(high) - f(low)) : 0.5);
  const ticks = [];
  if (log) {
    const first = Math.ceil(f(low)), stride = Math.ceil((f(high) - first) / 6) || 1;
    for (let e = first; e <= f(high); e += stride) ticks.push(10 ** e);
  } else if (high - low > 1e-9 * Math.abs(high)) {
    const step = roundDown((high - low) / 4);
    for (let k = Math.ceil(low / step); k <= high / step; ++k) ticks.push(k * step);
  } else ticks.push(low);
  return { log, of, ticks, empty: known.length === 0 };
}

/** The explorer: the first two axes of the study span the picture (a single axis: a line); each further one has a slider. */
function startStudy(data) {
  const room = byId("explorer");
  const axes = data.axes ?? [], quantities = data.quantities ?? [], points = data.points ?? [];
  if (!room || !axes.length || !quantities.length || !points.length) return;
  room.classList.add("study");
  const at = axes.map(() => 0);
  const found = new Map(points.map((point) => [String(point.axes), point]));
  const flat = axes.length === 1;
  const [across, upward] = [axes[0].values, flat ? [null] : axes[1].values];
  const pointAt = (i, j) => found.get(String(flat ? [i] : [i, j, ...at.slice(2)]));
  const controls = element("div", "controls"), select = element("select");
  const addControl = (name, ...parts) => {
    const label = element("label", "", name);
    label.append(...parts);
    controls.append(label);
  };
  const input = (properties) => Object.assign(element("input"), properties);
  quantities.forEach((name) => select.append(new Option(name)));
  const log = input({ type: "checkbox", checked: true });
  addControl("Quantity ", select);
  addControl("Logarithmic ", log);
  const canvas = element("canvas", "plane"), state = element("p", "note"), scenario = element("pre", "scenario");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  state.setAttribute("aria-live", "polite");
  scenario.hidden = true;
  const valueAt = (i, j) => pointAt(i, j)?.values?.[select.selectedIndex];
  axes.slice(2).forEach((axis, k) => {
    const slider = input({ type: "range", min: 0, max: axis.values.length - 1, value: 0 });
    const value = element("output", "", format(axis.values[0]));
    slider.addEventListener("input", () => {
      at[k + 2] = Number(slider.value);
      value.textContent = format(axis.values[at[k + 2]]);
      change();
    });
    addControl(axis.name, slider, value);
  });
  room.append(controls, canvas, state, scenario);

  const margin = { left: 84, right: flat ? 24 : 120, top: flat ? 34 : 54, bottom: 52 };
  let layout = { x: () => 0, y: () => 0 };

  const draw = () => {
    const page = penOf(canvas);
    if (!page) return;
    const { pen } = page, wide = page.width - margin.left - margin.right, high = page.height - margin.top - margin.bottom;
    const values = across.flatMap((_, i) => upward.map((_, j) => valueAt(i, j))), scale = makeScale(values, log.checked);
    const numbered = flat && across.every(isNumber) ? makeScale(across) : null;
    const x = (i) => margin.left + wide * (numbered ? numbered.of(across[i]) : (i + 0.5) / across.length);
    const y = (j) => margin.top + high * (1 - (j + 0.5) / upward.length);
    const level = (value) => margin.top + high * (0.96 - 0.92 * scale.of(value));
    layout = { x, y: flat ? () => margin.top : y };
    const write = (text, where, height, align = "left") => {
      pen.textAlign = align;
      pen.fillStyle = kPalette.text;
      pen.fillText(text, where, height);
    };
    write(`${quantities[select.selectedIndex]}${scale.log ? ", logarithmic" : ""}`, 8, 18);
    // As many labels as fit without touching.
    let free = 0;
    across.forEach((value, i) => {
      const text = format(value, 4), half = pen.measureText(text).width / 2 + 5;
      if (x(i) - half < free) return;
      write(text, x(i), page.height - 32, "center");
      free = x(i) + half;
    });
    write(axes[0].name, margin.left + wide / 2, page.height - 10, "center");
    if (scale.empty) return write("no values", margin.left + wide / 2, margin.top + high / 2, "center");
    if (flat) drawLine(pen, { x, level, wide, scale, write }); else drawMap(pen, { x, y, wide, high, scale, write });
  };

  const drawLine = (pen, { x, level, wide, scale, write }) => {
    for (const value of scale.ticks) {
      const height = level(value);
      pen.strokeStyle = kPalette.grid;
      pen.strokeRect(margin.left, height, wide, 0);
      write(format(value), margin.left - 8, height + 4, "right");
    }
    pen.strokeStyle = kPalette.ref;
    pen.lineWidth = 1.75;
    pen.beginPath();
    let joined = false;
    across.forEach((_, i) => {
      const value = valueAt(i, 0);
      if (isNumber(value)) pen[joined ? "lineTo" : "moveTo"](x(i), level(value));
      joined = isNumber(value);
    });
    pen.stroke();
    across.forEach((_, i) => {
      if (!isNumber(valueAt(i, 0))) return;
      const chosen = i === at[0];
      spot(pen, [x(i), level(valueAt(i, 0))], chosen ? 7 : 3, chosen ? kPalette.axis : kPalette.ref);
    });
  };

  const drawMap = (pen, { x, y, wide, high, scale, write }) => {
    const w = wide / across.length, h = high / upward.length;
    across.forEach((_, i) => upward.forEach((_, j) => {
      const value = valueAt(i, j), [l, t] = [x(i) - w / 2, y(j) - h / 2];
      if (isNumber(value)) {
        pen.fillStyle = shade(scale.of(value));
        // Slightly larger than the cell, so that no seams show.
        pen.fillRect(l, t, w + 0.6, h + 0.6);
      } else {
        pen.strokeStyle = kPalette.muted;
        trace(pen, [[l + w / 4, t + h / 4], [l + (3 * w) / 4, t + (3 * h) / 4]]);
        pen.stroke();
      }
    }));
    const every = Math.ceil(upward.length / Math.max(1, Math.floor(high / 22)));
    upward.forEach((value, j) => { if (j % every === 0) write(format(value, 4), margin.left - 8, y(j) + 4, "right"); });
    write(axes[1].name, 8, 40);
    const bar = margin.left + wide + 18;
    for (let k = 0; k < 64; ++k) {
      pen.fillStyle = shade(k / 63);
      pen.fillRect(bar, margin.top + high * (1 - (k + 1) / 64), 16, high / 64 + 0.6);
    }
    for (const value of scale.ticks) write(format(value), bar + 22, margin.top + high * (1 - scale.of(value)) + 4);
    const [l, t] = [x(at[0]) - w / 2, y(at[1]) - h / 2];
    for (const [colour, width] of [["#fff", 5], ["#000", 2]]) {
      pen.strokeStyle = colour;
      pen.lineWidth = width;
      pen.strokeRect(l, t, w, h);
    }
  };

  const change = () => {
    const point = pointAt(at[0], at[1]), name = quantities[select.selectedIndex];
    const where = axes.map((axis, k) => `${axis.name} ${format(axis.values[at[k]])}`).join(", ");
    state.textContent = `${where}: ${name} ${point ? format(valueAt(at[0], at[1]), 8) : "not computed"}.` +
      (scenario.hidden ? " Click, or press Enter, for its scenario; arrow keys move." : "");
    canvas.setAttribute("aria-label", `${name} over ${axes.slice(0, 2).map((axis) => axis.name).join(" and ")}`);
    if (!scenario.hidden) scenario.textContent = point?.scenario ?? "This point has no scenario.";
    draw();
  };
  const move = (i, j) => {
    at[0] = clamp(i, 0, across.length - 1);
    if (!flat) at[1] = clamp(j, 0, upward.length - 1);
    change();
  };
  const open = () => { scenario.hidden = false; change(); };
  canvas.addEventListener("click", (event) => {
    at[0] = nearest(across, layout.x, event.offsetX);
    if (!flat) at[1] = nearest(upward, layout.y, event.offsetY);
    open();
  });
  canvas.addEventListener("keydown", (event) => {
    const [i, j] = [at[0], at[1] ?? 0];
    const to = { ArrowLeft: [i - 1, j], ArrowRight: [i + 1, j], ArrowUp: [i, j + 1], ArrowDown: [i, j - 1] }[event.key];
    if (event.key === "Enter") open();
    else if (to) move(...to);
    else return;
    event.preventDefault();
  });
  controls.addEventListener("change", change);
  watch(canvas, draw);
  change();
}
