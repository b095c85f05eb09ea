// SPDX-License-Identifier: GPL-3.0-or-later
// The page to play with: sliders make a scenario, the engine runs it, the answer and the pictures follow.

const kSettings = JSON.parse(byId("play-settings").textContent);
const kSlow = 120;  // milliseconds that a run may take to be made again while a slider moves

const kState = { preset: "", values: {}, engine: null, took: 0, asked: false, started: false, summary: null };
window.earthtop.play = kState;

function presetNow() { return kSettings.presets[kState.preset]; }

function readPointer(document, pointer) {
  return pointer.slice(1).split("/").reduce((part, key) => part?.[key], document);
}

function writePointer(document, pointer, value) {
  const path = pointer.slice(1).split("/"), last = path.pop();
  let part = document;
  for (const key of path) part = part[key] ??= {};
  part[last] = value;
}

/** The sliders of a preset: the table's rows with the preset's changes, and the value at which each begins. */
function rowsOf(preset) {
  return Object.entries(preset.sliders).map(([id, changes]) => {
    const row = { id, ...kSettings.sliders[id], ...changes };
    row.initial = row.rate ? 1 : readPointer(preset.scenario, row.pointers[0]) ?? 0;
    if (row.around) {
      row.log = row.initial > 0 && row.min === undefined;
      const [low, high] = [row.initial / row.around, row.initial * row.around].sort((a, b) => a - b);
      row.min ??= low;
      row.max ??= high;
      row.step ??= (row.max - row.min) / 400;
    }
    return row;
  });
}

/** Slider positions: 0 to 1000 on a logarithmic scale, the value itself on a linear one. */
function positionOf(row, value) {
  return row.log ? (1000 * Math.log(value / row.min)) / Math.log(row.max / row.min) : value;
}

function valueAtPosition(row, position) {
  const value = row.log ? row.min * (row.max / row.min) ** (position / 1000) : position;
  return clamp(Number(value.toPrecision(row.log ? 3 : 6)), row.min, row.max);
}

/** The scenario of the settings; a value that stands as in the preset leaves the preset's own digits. */
function scenarioNow() {
  const preset = presetNow(), scenario = structuredClone(preset.scenario);
  for (const row of rowsOf(preset)) {
    const value = kState.values[row.id];
    if (row.rate) {
      if (value !== 1) writePointer(scenario, row.pointers[0], value * kSettings.earth_rate_rad_s);
    } else if (value !== row.initial) for (const pointer of row.pointers) writePointer(scenario, pointer, value);
  }
  scenario.motion.output_step_s = scenario.motion.duration_s / preset.rows;
  return scenario;
}

/** Indented, with lists of numbers in one line. */
function scenarioText(scenario) {
  return JSON.stringify(scenario, null, 2).replace(/\[\s+([^[\]{}"]*?)\s+\]/g, (_, list) => `[${list.replace(/\s+/g, " ")}]`);
}

// --- the answer

function numberElement(value, unit, digits) {
  const made = element("data", "", format(value, digits));
  made.value = String(value);
  return unit ? [made, ` ${unit}`] : [made];
}

function tellAnswer(summary, columns) {
  const reliable = summary.drift.reliable ?? {}, headline = byId("headline");
  if (!isNumber(reliable.axis_rad) || !(reliable.at_s > 0)) headline.replaceChildren("No row of this run can be trusted.");
  else {
    headline.replaceChildren("After ", ...numberElement(reliable.at_s, "s", 6), " the axis stands ",
      ...numberElement(reliable.axis_rad, "rad", 10), ` (${angleText(reliable.axis_rad / kRadian)}) from where it would stand without the ` +
      "Earth's rotation; the error of that number is at most ", ...numberElement(reliable.axis_bound_rad, "rad", 2), ".");
    const tip = columns.drift_tip_m?.at(-1), bound = columns.drift_tip_bound_m?.at(-1);
    if (isNumber(tip) && isNumber(bound) && reliable.at_s === summary.outcome.reached_s)
      headline.append(" It touches the table ", ...numberElement(tip, "m", 6), " from where it would without it, with an error of at most ",
        ...numberElement(bound, "m", 2), ".");
  }
  const word = String(summary.drift.verdict), verdict = byId("verdict");
  verdict.className = `verdict ${/^[a-z_]+$/.test(word) ? word : ""}`;
  verdict.replaceChildren(element("strong", "", word.replaceAll("_", " ")), `: ${summary.drift.verdict_reason}.`);
  for (const { from_s, until_s, text } of summary.drift.verdict_intervals ?? [])
    verdict.append(` From ${format(from_s)} s ${isNumber(until_s) ? `to ${format(until_s)} s` : "on"}, the drift cannot be trusted: ${text}.`);
  if (summary.outcome.status !== "completed")
    verdict.append(` The run stopped: ${summary.outcome.status}, at ${format(summary.outcome.reached_s)} s.`);
  byId("why").replaceChildren(...(summary.why ?? []).map(({ text }) => element("li", "", text)));
}

function tellEarth(factor) {
  const banner = byId("earth-banner");
  banner.hidden = factor === 1;
  banner.textContent = factor === 1 ? "" :
    `This is not our Earth: it turns ${factor.toLocaleString("en")} times as fast, at ${format(factor * kSettings.earth_rate_rad_s, 4)} rad/s.`;
}

function tellError({ message, place, remedy }) {
  const alert = byId("alert");
  alert.hidden = false;
  alert.textContent = `Not computed: ${message}${place ? ` (${place})` : ""}.${remedy ? ` ${remedy}.` : ""} The pictures still show the last run.`;
  byId("results").classList.add("stale");
}

// --- what the pictures are drawn from

/** The motion that the engine looked at, as a report has it, and whether the eye stays where it is. */
function motionData({ motion }, isNew) {
  return { ...unpacked(motion), keeps_view: !isNew };
}

// --- running

function showResult(result, isNew) {
  byId("alert").hidden = true;
  byId("results").classList.remove("stale");
  kState.summary = result.summary;
  tellAnswer(result.summary, result.columns);
  kState.chart(result);
  const data = motionData(result, isNew);
  for (const show of kScene.shows) show(data);
  for (const words of document.querySelectorAll(".played")) words.textContent = result.motion.words;
  if (kState.started) return;
  kState.started = true;
  if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) byId("play").click();
}

function askEngine(text) {
  try {
    return JSON.parse(kState.engine.ccall("earthtop_run", "string", ["string"], [text]));
  } catch (error) {
    return { error: { message: `the engine stopped: ${error instanceof Error ? error.message : error}`, place: "", remedy: "Load the page again" } };
  }
}

function run(isNew = false) {
  if (!kState.engine) return;
  const began = performance.now(), scenario = scenarioNow(), text = scenarioText(scenario);
  byId("scenario").textContent = `earthtop run - --out play <<'EOF'\n${text}\nEOF\nearthtop report play\n`;
  kState.scenario = text;
  tellEarth(kState.values.earth ?? 1);
  const result = askEngine(text);
  kState.computed = performance.now() - began;
  if (result.error) tellError(result.error);
  else showResult(result, isNew);
  // The browser has yet to translate the engine well when a top's first run is timed.
  kState.took = (performance.now() - began) / (isNew ? 3 : 1);
  byId("cost").textContent = `Computed in ${Math.ceil(kState.computed)} ms, to a certified bound.` +
    (kState.took > kSlow ? " That is too long to follow a moving slider, so the top is computed when the slider comes to rest." : "");
}

/** At most one run a frame, with the latest settings; a slow run only when the slider has come to rest. */
function ask(isAtRest) {
  if (kState.took > kSlow && !isAtRest) return;
  if (kState.asked) return;
  kState.asked = true;
  requestAnimationFrame(() => {
    kState.asked = false;
    run();
  });
}

// --- settings

function sliderText(row, value) {
  if (row.rate) return value === 1 ? "the true one" : `${value.toLocaleString("en")} times the true one`;
  return `${format(value, 4)}${row.unit === "°" ? "°" : ` ${row.unit}`}`;
}

function makeSlider(row) {
  const field = element("div", "field"), slider = element("input"), label = element("label", "", row.label), output = element("output");
  Object.assign(slider, { type: "range", id: `slider-${row.id}`, min: row.log ? 0 : row.min, max: row.log ? 1000 : row.max, step: row.log ? 1 : row.step });
  label.htmlFor = output.htmlFor = slider.id;
  const tell = () => {
    const value = kState.values[row.id];
    output.textContent = sliderText(row, value);
    slider.setAttribute("aria-valuetext", sliderText(row, value));
    field.classList.toggle("changed", value !== row.initial);
  };
  slider.value = positionOf(row, kState.values[row.id]);
  slider.addEventListener("input", () => {
    kState.values[row.id] = valueAtPosition(row, Number(slider.value));
    tell();
    ask(false);
  });
  slider.addEventListener("change", () => {
    writeFragment();
    if (kState.took > kSlow) ask(true);
  });
  tell();
  field.append(label, output, slider);
  return field;
}

function choose(name, values = {}) {
  kState.preset = name;
  const rows = rowsOf(presetNow());
  kState.values = Object.fromEntries(rows.map((row) => [row.id, values[row.id] ?? row.initial]));
  byId("preset").value = name;
  byId("preset-says").textContent = presetNow().says;
  byId("sliders").replaceChildren(...rows.map(makeSlider));
  kState.took = 0;
  kScene.chosen = null;
  run(true);
}

/** The settings as a link. A page on disk may not be allowed to change its address, and does without. */
function writeFragment() {
  const changed = rowsOf(presetNow()).filter((row) => kState.values[row.id] !== row.initial);
  const text = [["top", kState.preset], ...changed.map((row) => [row.id, kState.values[row.id]])].map((pair) => pair.join("=")).join("&");
  try { history.replaceState(null, "", `#${text}`); } catch { /* the page works without */ }
}

/** Reads a link's settings: only known tops and sliders, only numbers in the slider's range. */
function readFragment() {
  const given = new URLSearchParams(location.hash.slice(1)), name = given.get("top") ?? "";
  const preset = Object.hasOwn(kSettings.presets, name) ? name : Object.keys(kSettings.presets)[0], values = {};
  for (const row of rowsOf(kSettings.presets[preset])) {
    const text = given.get(row.id), value = Number(text);
    if (text && isNumber(value)) values[row.id] = clamp(value, row.min, row.max);
  }
  choose(preset, values);
}

async function startEngine() {
  const packed = Uint8Array.from(atob(byId("engine").textContent.trim()), (c) => c.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  kState.engine = await earthtopEngine({ wasmBinary: await new Response(unpacked).arrayBuffer() });
  byId("version").textContent = `earthtop ${kState.engine.ccall("earthtop_version", "string", [], [])}`;
}

function startPlay() {
  const select = byId("preset");
  select.append(...Object.entries(kSettings.presets).map(([name, { label }]) => new Option(label, name)));
  select.addEventListener("change", () => { choose(select.value); writeFragment(); });
  byId("reset").addEventListener("click", () => { choose(kState.preset); writeFragment(); });
  window.addEventListener("hashchange", readFragment);
  kState.chart = makeDriftChart(byId("drift-chart"));
  startEngine().then(readFragment, (error) => {
    byId("headline").textContent = "The engine did not start.";
    tellError({ message: String(error?.message ?? error), place: "", remedy: "This page needs WebAssembly and DecompressionStream, which browsers have since 2023" });
  });
}

startPlay();
