// SPDX-License-Identifier: GPL-3.0-or-later
// A scene that the sliders make: the table of its sliders, its scenario, and the link that holds it. Nothing here touches the page.

const kSettings = JSON.parse(byId("play-settings").textContent);
const kLongestLink = 600;  // characters

function readPointer(document, pointer) {
  return pointer.slice(1).split("/").reduce((part, key) => part?.[key], document);
}

function writePointer(document, pointer, value) {
  const path = pointer.slice(1).split("/"), last = path.pop();
  let part = document;
  for (const key of path) part = part[key] ??= {};
  part[last] = value;
}

/** The sliders of a preset: the table's rows with the preset's changes, and the value at which each begins. A value far below the
 *  step of its slider, or beyond its ends, makes the slider's range. */
function rowsOf(preset) {
  return Object.entries(preset.sliders).map(([id, changes]) => {
    const row = { id, ...kSettings.sliders[id], ...changes };
    row.initial = row.rate ? 1 : readPointer(preset.scenario, row.pointers[0]);
    if (row.initial > 0 && row.initial < 4 * row.step) Object.assign(row, { around: 10, min: undefined, max: undefined, step: undefined });
    if (row.around) {
      row.log = row.initial > 0 && row.min === undefined;
      const short = (x) => Number(x.toPrecision(4));
      const [low, high] = [short(row.initial / row.around), short(row.initial * row.around)].sort((a, b) => a - b);
      row.min ??= low;
      row.max ??= high;
      row.step ??= (row.max - row.min) / 400;
    }
    row.min = Math.min(row.min, row.initial);
    row.max = Math.max(row.max, row.initial);
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

/** The scenario of a preset with its sliders at `values`; a value that stands as in the preset leaves the preset's own digits. */
function scenarioOf(preset, values) {
  const scenario = structuredClone(preset.scenario);
  for (const row of rowsOf(preset)) {
    const value = values[row.id];
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

/** The scene as the fragment of an address: "top=toy-top&latitude=30&sheet=school". */
function linkText(name, values, level) {
  const changed = rowsOf(kSettings.presets[name]).filter((row) => values[row.id] !== row.initial);
  return [["top", name], ...changed.map((row) => [row.id, values[row.id]]), ...(level ? [["sheet", level]] : [])]
    .map((pair) => pair.join("=")).join("&");
}

/** Reads such a fragment, which anybody may have written: known names once each, and plain numbers within their sliders' ranges.
 *  @returns {name, values, level}, or {refusal: a clause on what is wrong, with no word of the link itself} */
function readLink(fragment, levels) {
  const no = (refusal) => ({ refusal }), names = Object.keys(kSettings.presets), found = new Map();
  if (fragment === "") return { name: names[0], values: {}, level: "" };
  if (fragment.length > kLongestLink) return no(`it has more than ${kLongestLink} characters`);
  for (const part of fragment.split("&")) {
    let pair = null;
    try { pair = decodeURIComponent(part).split("="); } catch { return no("its characters are not those of a link"); }
    if (pair.length !== 2) return no("a part of it is no name with a value");
    if (found.has(pair[0])) return no("it says the same thing twice");
    found.set(pair[0], pair[1]);
  }
  const name = found.get("top") ?? names[0], level = found.get("sheet") ?? "", values = {};
  if (!names.includes(name)) return no("it asks for a scene that this page does not have");
  if (level !== "" && !levels.includes(level)) return no("it asks for a sheet that this page does not have");
  const rows = new Map(rowsOf(kSettings.presets[name]).map((row) => [row.id, row]));
  for (const [key, text] of found) {
    if (key === "top" || key === "sheet") continue;
    const row = rows.get(key);
    if (!row) return no("it sets something for which this scene has no slider");
    const value = /^-?\d{1,12}(\.\d{1,25})?(e[-+]?\d{1,3})?$/i.test(text) ? Number(text) : NaN;
    if (!Number.isFinite(value)) return no(`its value for "${row.label}" is no number`);
    if (value < row.min || value > row.max)
      return no(`its value for "${row.label}" is not within ${format(row.min, 4)} to ${format(row.max, 4)}${row.unit && !row.rate ? ` ${row.unit}` : ""}`);
    values[row.id] = value;
  }
  return { name, values, level };
}
