// SPDX-License-Identifier: GPL-3.0-or-later
// Asks the engine which scenarios it runs.
//
// usage: refusals.mjs ENGINE.js ENGINE.wasm < {"name": "scenario's text", ...}     > {"name": "why it does not, or nothing", ...}
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";

const [glue, wasm] = process.argv.slice(2);
const engine = await createRequire(import.meta.url)(resolve(glue))({ wasmBinary: readFileSync(wasm) });
const refusal = engine.cwrap("earthtop_refusal", "string", ["string"]);
const said = Object.entries(JSON.parse(readFileSync(0, "utf8"))).map(([name, text]) => {
  const answer = refusal(text);
  return [name, answer === "" ? "" : JSON.parse(answer).error.message];
});
process.stdout.write(JSON.stringify(Object.fromEntries(said)));
