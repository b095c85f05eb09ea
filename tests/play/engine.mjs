// SPDX-License-Identifier: GPL-3.0-or-later
// The engine of the page to play with, in Node.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";

/** Starts the engine that tools/play/build.sh made in a directory. @returns {text: (scenario text) => answer's text, run: the same read,
 *  refusal: (scenario text) => the error that says why it does not run it, or null, version} */
export async function startEngine(directory) {
  const make = createRequire(import.meta.url)(resolve(directory, "engine.js"));
  const engine = await make({ wasmBinary: readFileSync(resolve(directory, "engine.wasm")) });
  const run = engine.cwrap("earthtop_run", "string", ["string"]), refusal = engine.cwrap("earthtop_refusal", "string", ["string"]);
  return { text: run, run: (scenario) => JSON.parse(run(scenario)), refusal: (scenario) => JSON.parse(refusal(scenario) || "null"), version: engine.cwrap("earthtop_version", "string", [])() };
}

/** Seconds of processor time that a function takes, and what it returns. */
export function timed(work) {
  const before = process.cpuUsage();
  const answer = work();
  const { user, system } = process.cpuUsage(before);
  return { seconds: (user + system) * 1e-6, answer };
}

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)];
}
