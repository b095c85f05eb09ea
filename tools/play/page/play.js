// SPDX-License-Identifier: GPL-3.0-or-later
// The page to play with: sliders make a scenario, the engine runs it, the answer and the pictures follow.

const kFrame = 16;  // milliseconds
const kSlow = 120;  // milliseconds that a run may take to be made again while a slider moves

const kState = { preset: "", values: {}, level: "", engine: null, took: 0, ended: 0, asked: false, started: false, summary: null };
window.earthtop.play = kState;

function presetNow() { return kSettings.presets[kState.preset]; }

/** The scenario of the settings. */
function scenarioNow() { return scenarioOf(presetNow(), kState.values); }

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
  byId("why").replaceChildren(...(summary.why ?? []).map(({ text }) => element("li", "", withPowers(text))));
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
  tellSheet();
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
  kState.ended = performance.now();
  kState.took = (kState.ended - began) / (isNew ? 3 : 1);
  byId("cost").textContent = `Computed in ${Math.ceil(kState.computed)} ms, to a certified bound.` +
    (kState.took > kSlow ? " That is too long to follow a moving slider, so the top is computed when the slider comes to rest." : "");
}

/** At most one run a frame, with the latest settings, and the first one at once; a slow run only when the slider has come to rest. */
function ask(isAtRest) {
  if (kState.took > kSlow && !isAtRest) return;
  if (kState.asked) return;
  if (performance.now() - kState.ended > kFrame) return run();
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
    writeLink();
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
  tellLink();
  run(true);
}

/** Tells the link to the scene. @returns its fragment */
function tellLink() {
  const fragment = `#${linkText(kState.preset, kState.values, kState.level)}`;
  byId("link").textContent = location.protocol === "file:" ? fragment : location.href.split("#")[0] + fragment;
  return fragment;
}

/** The scene as the page's address. A page on disk may not be allowed to change it, and does without. */
function writeLink() {
  const fragment = tellLink();
  try { history.replaceState(null, "", fragment); } catch { /* the page works without */ }
}

/** Shows the scene of the address, or the first one where the address is refused. */
function followLink() {
  const { name, values, level, refusal } = readLink(location.hash.slice(1), Object.keys(kLevels)), alert = byId("link-alert");
  alert.hidden = !refusal;
  alert.textContent = refusal ? `The link was not followed: ${refusal}. This is the page's first scene instead.` : "";
  kState.level = level ?? "";
  choose(name ?? Object.keys(kSettings.presets)[0], values);
  showSheet();
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
  select.addEventListener("change", () => { byId("link-alert").hidden = true; choose(select.value); writeLink(); });
  byId("reset").addEventListener("click", () => { choose(kState.preset); writeLink(); });
  window.addEventListener("hashchange", followLink);
  startSheet();
  kState.chart = makeDriftChart(byId("drift-chart"));
  startEngine().then(followLink, (error) => {
    byId("headline").textContent = "The engine did not start.";
    tellError({ message: String(error?.message ?? error), place: "", remedy: "This page needs WebAssembly and DecompressionStream, which browsers have since 2023" });
  });
}

startPlay();
