#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// How long the engine of the page to play with takes for a toy top of a minute: the median of processor times.
//
// usage: engine_bench.mjs ENGINE_DIRECTORY [--limit-ms MS] [--scenario FILE]
import { readFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { median, startEngine, timed } from "./engine.mjs";

const kRuns = 25, kWarmUp = 5;
const [directory, ...options] = process.argv.slice(2);
const option = (name) => (options.includes(name) ? options[options.indexOf(name) + 1] : null);
const scenarios = resolve(dirname(fileURLToPath(import.meta.url)), "../../scenarios");
const settings = JSON.parse(readFileSync(resolve(scenarios, "../tools/play/page/settings.json"), "utf8"));

const scenario = JSON.parse(readFileSync(option("--scenario") ?? resolve(scenarios, "toy-top.json"), "utf8"));
const preset = structuredClone(scenario);
preset.motion.output_step_s = preset.motion.duration_s / settings.scenes["toy-top"].rows;
preset.numerics = { relative_tolerance: settings.scenes["toy-top"].tolerance };

const engine = await startEngine(directory);
const times = { "as shipped": [], "as the page asks": [] };
for (let i = 0; i < kWarmUp + kRuns; ++i)
  for (const [name, asked] of [["as shipped", scenario], ["as the page asks", preset]]) {
    const { seconds, answer } = timed(() => engine.run(JSON.stringify(asked)));
    if (!answer.summary) throw new Error(JSON.stringify(answer));
    if (i >= kWarmUp) times[name].push(seconds);
  }
const limit_ms = Number(option("--limit-ms") ?? Infinity);
for (const [name, list] of Object.entries(times))
  console.log(`${name}: median ${(1e3 * median(list)).toFixed(1)} ms of processor time, least ${(1e3 * Math.min(...list)).toFixed(1)} ms, ${list.length} runs`);
process.exitCode = 1e3 * median(times["as the page asks"]) <= limit_ms ? 0 : 1;
