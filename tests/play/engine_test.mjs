#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// The engine of the page to play with against the program: every shipped scenario, cell by cell and figure by figure; what the engine
// refuses; and that its pictures show the motion, whatever the output rows.
//
// usage: engine_test.mjs PATH_OF_EARTHTOP ENGINE_DIRECTORY [SCENARIO.json ...]
//
// VERBOSE=1 says what each scenario took. A scenario that runs for a minute and more is compared only if it is given.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { startEngine } from "./engine.mjs";

/** Methods whose last digits may be others, since they are set up in another extended precision; they must agree within both bounds. */
const kOtherDigits = ["closed_form", "long_horizon"];
/** A method that the engine does not have: it takes another one, within the bounds of both. */
const kLeftOut = "fourier";
const kTakesMinutes = ["h21-thirty-days"];

const kScenarios = resolve(dirname(fileURLToPath(import.meta.url)), "../../scenarios");
const faults = [];
let checks = 0;

function expect(holds, text) {
  ++checks;
  if (!holds) faults.push(text);
}

function shipped() {
  const files = (folder) => readdirSync(folder).filter((name) => name.endsWith(".json")).sort().map((name) => join(folder, name));
  return [...files(kScenarios), ...files(join(kScenarios, "hard"))].filter((file) => !kTakesMinutes.includes(basename(file, ".json")));
}

/** The program's answer: its summary, and the columns of its trajectory as text. */
function native(program, file, directory) {
  const done = spawnSync(program, ["run", file, "--out", directory, "--force", "--quiet"], { encoding: "utf8", timeout: 120e3 });
  if (done.status !== 0 && done.status !== 3) return { error: done.stderr };
  const [header, ...rows] = readFileSync(join(directory, "trajectory.csv"), "utf8").trimEnd().split("\n").map((line) => line.split(","));
  const columns = Object.fromEntries(header.map((name, k) => [name, rows.map((row) => row[k])]));
  return { summary: JSON.parse(readFileSync(join(directory, "summary.json"), "utf8")), columns };
}

/** A cell of trajectory.csv as the engine gives it: a number, null, or a word. */
function value(cell) { return cell === "" ? null : Number.isNaN(Number(cell)) ? cell : Number(cell); }

/** The names of the columns that differ in a cell. */
function otherColumns(ours, theirs) {
  return Object.keys(theirs).filter((name) => ours[name]?.length !== theirs[name].length ||
    theirs[name].some((cell, i) => value(cell) !== ours[name][i]));
}

const kFigures = [
  "/outcome/status", "/drift/verdict", "/drift/axis_final_rad", "/drift/axis_max_rad", "/drift/axis_max_at_s", "/drift/axis_bound_rad",
  "/drift/attitude_final_rad",
  "/drift/azimuth_final_rad", "/drift/tilt_final_rad", "/drift/spin_final_rad", "/drift/secular/azimuth_rate_rad_s",
];
function at(document, pointer) { return pointer.slice(1).split("/").reduce((node, key) => node?.[key], document); }

/** Whether the drifts of both agree within both bounds, row by row. */
function withinBounds(ours, theirs) {
  return theirs.columns.drift_axis_rad.every((cell, i) => {
    const bound = Number(theirs.columns.drift_axis_bound_rad[i]) + ours.columns.drift_axis_bound_rad[i];
    return cell === "" || Math.abs(Number(cell) - ours.columns.drift_axis_rad[i]) <= bound;
  }) && ours.summary.drift.verdict === theirs.summary.drift.verdict && ours.summary.outcome.status === theirs.summary.outcome.status;
}

const otherDigits = [];

function compare(name, ours, theirs) {
  if (ours.error) return expect(false, `${name}: the engine refuses it: ${ours.error.message}; ${ours.error.remedy}`);
  const columns = otherColumns(ours.columns, theirs.columns), figures = kFigures.filter((p) => at(ours.summary, p) !== at(theirs.summary, p));
  const method = theirs.summary.solution.method;
  if ([method, theirs.summary.certificate.method].includes(kLeftOut)) {
    otherDigits.push(name);
    return expect(withinBounds(ours, theirs), `${name}: apart by more than both bounds`);
  }
  expect(ours.summary.solution.method === method, `${name}: solved by ${ours.summary.solution.method}, by the program by ${method}`);
  if (!columns.length && !figures.length) return expect(true);
  otherDigits.push(name);
  expect(kOtherDigits.includes(method), `${name} (${method}): other digits: ${[...figures, ...columns].join(" ")}`);
  expect(withinBounds(ours, theirs), `${name}: apart by more than both bounds`);
}

/** What must be refused, as by the program, and leave the engine as it was. */
function refusals(program, engine) {
  const toyTop = readFileSync(join(kScenarios, "toy-top.json"), "utf8");
  const changed = (change) => { const scenario = JSON.parse(toyTop); change(scenario); return JSON.stringify(scenario); };
  const texts = {
    nothing: "", "no JSON": "{", "a list": "[]", "text after the end": `${toyTop}x`, "a deep list": "[".repeat(1e5),
    "a key twice": toyTop.replace("\"site\"", "\"site\": {}, \"site\""), "an unknown key": changed((s) => { s.sight = 1; }),
    "another unit": changed((s) => { s.body.mass_g = 1; }), "a negative mass": changed((s) => { s.body.mass_kg = -1; }),
    "a word for a number": changed((s) => { s.release.tilt_deg = "<img onerror=x>"; }),
    "moments of no body": changed((s) => { s.body.inertia = { about: "pivot", principal_kg_m2: [1, 1, 3] }; }),
    "a file": changed((s) => { s.motion.platform = { file: "/etc/passwd" }; }),
    "a number without end": changed((s) => { s.site.latitude_deg = 1; }).replace("\"latitude_deg\":1", "\"latitude_deg\":1e999"),
  };
  const before = engine.text(toyTop);
  expect(engine.refusal(toyTop) === null, "asked beforehand, the engine refuses the toy top");
  for (const [what, text] of Object.entries(texts)) {
    const answer = engine.run(text);
    expect(answer.error && !answer.summary, `${what}: is not refused`);
    const told = spawnSync(program, ["check", "-", "--json"], { input: text, encoding: "utf8" });
    const findings = JSON.parse(told.stdout)?.errors ?? JSON.parse(told.stdout).files?.[0]?.errors ?? [];
    const theirs = findings.map((finding) => finding.message).sort(), ours = (answer.errors ?? []).map((e) => e.remedy ? `${e.message}; ${e.remedy}` : e.message).sort();
    expect(theirs.length > 0 && JSON.stringify(theirs) === JSON.stringify(ours), `${what}: the program says ${JSON.stringify(theirs)}, the engine ${JSON.stringify(ours)}`);
  }
  const limits = {
    "113 bits": [changed((s) => { s.numerics = { precision: "float128" }; }), "double alone"],
    "a million rows": [changed((s) => { s.motion = { duration_s: 60, output_step_s: 6e-5 }; }), "rows"],
    "a year": [changed((s) => { s.motion = { duration_s: 3e7, output_step_s: 1e6 }; s.numerics = { method: "dopri5", relative_tolerance: 1e-12 }; }), "shorter duration"],
    "a date": [changed((s) => { s.motion.start_utc = "2026-11-22T12:00:00Z"; }), "no places of the Sun and the Moon"],
    "chosen effects": [changed((s) => { s.effects = "auto"; s.accuracy = { drift_rad: 1e-7 }; }), "no places of the Sun and the Moon"],
    "a journey": [changed((s) => { s.travel = { path: "rhumb", course_deg: 0, speed_m_s: 10 }; }), "a laboratory at rest, and this one travels"],
    "a NUL": ["{\"a\u0000\": 1}", "closing quote"], // ends the text for the engine
  };
  for (const [what, [text, part]] of Object.entries(limits)) {
    const { error } = engine.run(text), asked = engine.refusal(text);
    expect(JSON.stringify(asked?.error) === JSON.stringify(error), `${what}: asked beforehand, the engine says ${JSON.stringify(asked)}`);
    expect(error && `${error.message}; ${error.remedy}`.includes(part), `${what}: ${JSON.stringify(error)}`);
  }
  expect(engine.text(toyTop) === before || differsInSecondsOnly(before, engine.text(toyTop)), "after refusals the engine gives other digits");
}

function differsInSecondsOnly(a, b) {
  const bare = (text) => text.replaceAll(/"seconds[a-z_]*": ?[-0-9.e]+/g, "");
  return bare(a) === bare(b);
}

/** The points of the paths in the last panel of a chart, in the units of its axes. */
function lastPanel(picture) {
  const panel = picture.slice(picture.lastIndexOf("Azimuth minus"));
  // Ticks: the place of a number's grid line is told by its text, above or left of which it is.
  const ticks = (pattern, place) => [...panel.matchAll(pattern)].map((found) => [place(found), Number(found[2].replace("−", "-"))]);
  const scale = (list) => {
    const [[from, low], [to, high]] = [list[0], list.at(-1)];
    return (px) => low + ((px - from) * (high - low)) / (to - from);
  };
  const y = scale(ticks(/y="([\d.]+)" text-anchor="end">([−\d.]+)</g, (found) => Number(found[1]) - 4));
  const x = scale(ticks(/x="([\d.]+)" y="[\d.]+" text-anchor="middle">([\d.]+)</g, (found) => Number(found[1])));
  const group = panel.match(/<g clip-path[^]*?<\/g>/)[0];
  return [...group.matchAll(/[ML]([\d.]+) ([\d.]+)/g)].map(([, px, py]) => [x(Number(px)), y(Number(py))]);
}

function peakToPeak(values) { return Math.max(...values) - Math.min(...values); }

/** The pictures are the same for any output rows, and their bands reach as far as the motion does. */
function pictures(engine) {
  const toyTop = JSON.parse(readFileSync(join(kScenarios, "toy-top.json"), "utf8"));
  const withRows = (step_s) => engine.run(JSON.stringify({ ...toyTop, motion: { ...toyTop.motion, output_step_s: step_s } }));
  const [dense, sparse, fine] = [0.1, 2, 0.005].map(withRows);
  for (const part of ["chart", "motion"])
    expect(JSON.stringify(dense[part]) === JSON.stringify(sparse[part]), `rows every 0.1 s and every 2 s give another ${part}`);
  for (const figure of ["/drift/axis_max_rad", "/drift/axis_max_at_s"])
    expect(at(dense.summary, figure) === at(sparse.summary, figure), `rows every 0.1 s and every 2 s give another ${figure}`);
  expect(/Azimuth minus its secular line \([^)]*band: least to most\)/.test(sparse.chart.wide), "it is not said that the residual is drawn as a band");
  const kFrom = 41, kUntil = 45, kArcseconds = (180 * 3600) / Math.PI, rate = at(fine.summary, "/drift/secular/azimuth_rate_rad_s");
  const inside = (t_s) => t_s >= kFrom && t_s <= kUntil;
  const residual = fine.columns.t_s.map((t_s, i) => [t_s, (fine.columns.drift_azimuth_rad[i] - rate * t_s) * kArcseconds]);
  const motion = peakToPeak(residual.filter(([t_s]) => inside(t_s)).map(([, y]) => y));
  const drawn = peakToPeak(lastPanel(sparse.chart.wide).filter(([t_s]) => inside(t_s)).map(([, y]) => y));
  console.log(`azimuth minus its line from ${kFrom} to ${kUntil} s, peak to peak: ${motion.toFixed(2)}″, drawn ${drawn.toFixed(2)}″`);
  expect(Math.abs(drawn / motion - 1) < 0.03, `the residual's peak to peak is ${motion}″, and ${drawn}″ are drawn`);
}

const [program, directory, ...given] = process.argv.slice(2);
const engine = await startEngine(directory);
const version = execFileSync(program, ["--version"], { encoding: "utf8" });
console.log(`engine ${engine.version}; program ${version.split("\n")[0]}`);
const results = mkdtempSync(join(tmpdir(), "earthtop-engine-"));
try {
  for (const file of given.length ? given : shipped()) {
    const name = basename(file, ".json"), began = process.hrtime.bigint();
    const ours = engine.run(readFileSync(file, "utf8"));
    const theirs = native(program, file, join(results, "run"));
    if (process.env.VERBOSE) console.log(name, Number(process.hrtime.bigint() - began) * 1e-9);
    if (theirs.error) expect(ours.error, `${name}: the program refuses it and the engine does not: ${theirs.error}`);
    else compare(name, ours, theirs);
  }
  if (!given.length) {
    refusals(program, engine);
    pictures(engine);
  }
} finally {
  rmSync(results, { recursive: true });
}
for (const fault of faults) console.log(`  ${fault}`);
console.log(`other digits within both bounds: ${otherDigits.join(" ")}`);
console.log(`${checks} checks, ${faults.length} faults`);
process.exitCode = faults.length || !checks ? 1 : 0;
