#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// The page to play with without a browser: the links that hold a scene, hostile ones among them, and the texts of the sheets.
//
// usage: page_test.mjs PAGE.html ENGINE_DIRECTORY
import { readFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import vm from "node:vm";
import { startEngine } from "./engine.mjs";

const kHere = dirname(fileURLToPath(import.meta.url)), kPage = resolve(kHere, "../../tools/play/page");
const kLong = ["top=toy-top" + "&x=1".repeat(200), "top=" + "%00".repeat(2000), "&".repeat(1e6)];
const kFastScenes = ["toy-top", "free-gyro", "rolling-ball", "tippe-top", "dzhanibekov", "rate-gyro-on-turntable"];
const faults = [];
let checks = 0;

function expect(holds, text) {
  ++checks;
  if (!holds) faults.push(text);
}

const [html, directory] = process.argv.slice(2);
const settings = readFileSync(html, "utf8").match(/id="play-settings">(.*?)<\/script>/s)[1];
const shared = `const kRadian = Math.PI / 180;
function byId() { return { textContent: ${JSON.stringify(settings)} }; }
function isNumber(value) { return typeof value === "number" && Number.isFinite(value); }
function clamp(value, low, high) { return Math.min(high, Math.max(low, value)); }
function format(value, digits = 6) { return String(Number(value.toPrecision(digits))); }
function powerOfTen(exponent) { return "10^" + exponent; }
`;
const parts = ["scene", "sheet"].map((name) => readFileSync(resolve(kPage, `${name}.js`), "utf8")).join("");
const page = vm.runInNewContext(`${shared}${parts}({ kSettings, kLevels, rowsOf, scenarioOf, scenarioText, linkText, readLink, sheetOf,
  angleChoices })`, { structuredClone });
const levels = Object.keys(page.kLevels), presets = page.kSettings.presets;

for (const [fragment, part] of JSON.parse(readFileSync(resolve(kHere, "hostile_links.json"), "utf8"))) {
  const { refusal, values } = page.readLink(fragment, levels);
  expect(refusal?.includes(part) && !values, `#${fragment}: ${JSON.stringify({ refusal, values })}, not "${part}"`);
}
for (const fragment of kLong) expect(page.readLink(fragment, levels).refusal?.includes("more than 600 characters"), `${fragment.slice(0, 30)}...: not refused`);
// No text of a link gets into what the page says.
for (const word of ["hacked", "<b>", "\u202e"])
  for (const fragment of [`top=${word}`, `top=toy-top&${word}=1`, `top=toy-top&latitude=${word}`, `top=toy-top&sheet=${word}`])
    expect(page.readLink(fragment, levels).refusal && !page.readLink(fragment, levels).refusal.includes(word), `#${fragment}: repeated`);
expect({}.polluted === undefined && !("1" in Object.prototype), "a link has changed what all objects have");

for (const [name, preset] of Object.entries(presets)) {
  const rows = page.rowsOf(preset), start = Object.fromEntries(rows.map((row) => [row.id, row.initial]));
  expect(rows.length >= 3 && rows.some((row) => row.id === "duration"), `${name}: sliders ${rows.map((row) => row.id)}`);
  for (const row of rows)
    expect([row.min, row.max, row.initial].every(Number.isFinite) && row.min < row.max && row.min <= row.initial && row.initial <= row.max,
      `${name}: ${row.id} from ${row.min} to ${row.max} at ${row.initial}`);
  const ends = Object.fromEntries(rows.map((row, k) => [row.id, k % 2 ? row.min : row.max]));
  for (const values of [start, ends])
    for (const level of ["", ...levels]) {
      const read = page.readLink(page.linkText(name, values, level), levels);
      expect(!read.refusal && read.name === name && read.level === level && rows.every((row) => (read.values[row.id] ?? row.initial) === values[row.id]),
        `${name}: ${page.linkText(name, values, level)} is read as ${JSON.stringify(read)}`);
    }
}

const engine = await startEngine(directory);
for (const name of kFastScenes) {
  const preset = presets[name], values = Object.fromEntries(page.rowsOf(preset).map((row) => [row.id, row.initial]));
  const scenario = page.scenarioOf(preset, values), { summary } = engine.run(page.scenarioText(scenario));
  const drift = summary.drift.reliable.axis_rad, questions = new Set();
  for (const level of levels) {
    const sheet = page.sheetOf(level, { name, scenario, summary, rate_rad_s: page.kSettings.earth_rate_rad_s });
    if (sheet.none) { expect(!(drift > 0), `${name}, ${level}: ${sheet.none}`); continue; }
    questions.add(sheet.question);
    const before = JSON.stringify([sheet.facts, sheet.question, sheet.lines]), told = sheet.answers.join(" ");
    expect(sheet.choices.length === new Set(sheet.choices).size && sheet.choices[sheet.right], `${name}, ${level}: ${sheet.choices}, ${sheet.right}`);
    expect(told.includes(`${Number(drift.toPrecision(4))} rad`), `${name}, ${level}: ${drift} is not in "${told}"`);
    expect(!before.includes(String(Number(drift.toPrecision(4)))), `${name}, ${level}: the question tells the answer`);
    expect(!/NaN|undefined|null|Infinity/.test(before + told + sheet.choices), `${name}, ${level}: ${before} ${told}`);
  }
  expect(questions.size === levels.length || !(drift > 0), `${name}: ${questions.size} questions`);
}

// The texts' numbers against sums of their own: of a toy top at 45 degrees, and of one where the choice is known.
const made = (over) => ({ name: "made", scenario: { site: { latitude_deg: 30 }, release: { tilt_deg: 20, spin_rad_s: 200 }, motion: { duration_s: 100 } },
  summary: { why: [], drift: { reliable: { axis_rad: 1e-3, axis_bound_rad: 1e-12, at_s: 100, ...over } } }, rate_rad_s: 1e-4 });
const undergraduate = (axis_rad) => page.sheetOf("undergraduate", made({ axis_rad }));  // the laboratory turns by 5e-3 rad
expect([1e-3, 5.1e-3, 9e-3].map((rad) => undergraduate(rad).right).join() === "0,1,2", "less, as much and more are not told apart");
expect(undergraduate(1e-3).answers[1].includes("0.005 rad; the drift is 0.2 times"), undergraduate(1e-3).answers[1]);
const laboratory = (axis_rad) => page.sheetOf("laboratory", made({ axis_rad }));  // 300 frames: 5.77e-5 rad, five of them 2.89e-4
expect([2.8e-4, 2.95e-4].map((rad) => laboratory(rad).right).join() === "1,0", "five standard errors of 300 frames are not 2.89e-4 rad");
expect(page.sheetOf("school", made({ axis_rad: null })).none && page.sheetOf("school", made({ axis_rad: 0 })).none, "a sheet without a drift");
for (const rad of [1e-9, 1e-3, 0.3, 3]) {
  const { choices, right } = page.angleChoices(rad, "made");
  expect(choices.length === 4 && right >= 0 && right < 4 && (right === 3 || rad * 30 ** (3 - right) <= Math.PI), `${rad}: ${choices}`);
}

for (const fault of faults) console.log(`  ${fault}`);
console.log(`${checks} checks, ${faults.length} faults`);
process.exitCode = faults.length || !checks ? 1 : 0;
