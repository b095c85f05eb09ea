// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil's sheet: what is to be predicted about a scene, and what the run then says. The texts are made of the scene's own numbers;
// nothing here touches the page.

const kLevels = { school: "School", undergraduate: "Undergraduate", laboratory: "Laboratory" };
const kCoin_m = 0.02;        // a coin's width
const kFrames_1_s = 30;      // of a camera
const kFrame_rad = 1e-3;     // standard error of the axis's direction in one frame
const kThen = "The run then said";
const kErrors = 5;           // standard errors at which something counts as seen

/** A rounded number without a power of ten where it can do without: "530". */
function rounded(value, digits) {
  const plain = Number(value.toPrecision(digits));
  return plain >= 1e-3 && plain < 1e5 ? String(plain) : format(value, digits);
}
function radians(value, digits = 4) { return `${rounded(value, digits)} rad`; }
function angleWords(rad, digits = 3) {
  const degrees = rad / kRadian;
  if (degrees >= 1) return `${rounded(degrees, digits)}°`;
  return degrees >= 1 / 60 ? `${rounded(degrees * 60, digits)}′` : `${rounded(degrees * 3600, digits)}″`;
}

/** A text of the engine's, with its powers of ten as they are read: "5.75 × 10⁻⁷". */
function withPowers(text) { return text.replace(/(\d)e([-+])0*(\d+)/g, (_, digit, sign, size) => `${digit} × ${powerOfTen(Number(sign + size))}`); }

/** How wide an angle is: a coin as far away as it looks so wide. */
function coinWords(rad) {
  const far_m = kCoin_m / rad, far = far_m >= 1000 ? `${rounded(far_m / 1000, 2)} km` : `${rounded(far_m, 2)} m`;
  return rad > 0.1 ? "" : `, as wide as a coin at ${far}`;
}

/** Four angles a factor of 30 apart, one of them the right one; which of them is told by the scene's name alone. */
function angleChoices(rad, name) {
  const kApart = 30, letters = [...name].reduce((sum, letter) => sum + letter.charCodeAt(0), 0);
  let right = letters % 4;
  while (right < 3 && rad * kApart ** (3 - right) > Math.PI) ++right;
  const choices = [0, 1, 2, 3].map((i) => {
    const angle = rad * kApart ** (i - right);
    return `about ${angleWords(angle, 1)}${coinWords(angle)}`;
  });
  return { choices, right };
}

/** What is known before the run. */
function factsOf(scenario, rate_rad_s) {
  const { site, release, motion, rotor } = scenario;
  const facts = [["Latitude", `${format(site.latitude_deg, 6)}°`]];
  if (isNumber(release?.tilt_deg)) facts.push(["Tilt from the vertical", `${format(release.tilt_deg, 4)}°`]);
  const spin = rotor?.spin_rad_s ?? release?.spin_rad_s;
  if (isNumber(spin)) facts.push(["Spin", spin === 0 ? "none" : `${format(spin, 4)} rad/s, ${format(Math.abs(spin) / (2 * Math.PI), 3)} turns a second`]);
  facts.push(["Watched for", `${format(motion.duration_s, 6)} s`], ["The Earth turns at", `${format(rate_rad_s, 5)} rad/s`]);
  return facts;
}

/** @returns {facts, question, choices, right, lines: what the pupil writes, answers}; or {none: why there is no sheet} */
function sheetOf(level, { name, scenario, summary, rate_rad_s }) {
  const reliable = summary?.drift?.reliable ?? {}, drift = reliable.axis_rad, at_s = reliable.at_s;
  if (!isNumber(drift) || !(drift > 0) || !(at_s > 0))
    return { none: "There is nothing to predict here: no drift of this scene can be trusted. Choose another scene, or move a slider." };
  const known = `After ${format(at_s, 6)} s the axis stands ${angleWords(drift, 4)} (${radians(drift)}) from where it would stand without the ` +
    `Earth's rotation; the error of that number is at most ${radians(reliable.axis_bound_rad, 2)}.`;
  const why = (summary.why ?? []).map(({ text }) => withPowers(text)), facts = factsOf(scenario, rate_rad_s);
  if (level === "school") {
    return {
      facts, ...angleChoices(drift, name),
      question: `While this top moves for ${format(at_s, 6)} s, the Earth turns by ${angleWords(rate_rad_s * at_s, 3)}. How far does that turn the top's ` +
        "axis from where it would stand on an Earth that does not turn?",
      lines: ["I think so because", "To see it, I would need", kThen],
      answers: [known + (coinWords(drift) ? ` That is${coinWords(drift).slice(1)}.` : ""), ...why.slice(0, 1)],
    };
  }
  if (level === "undergraduate") {
    const turned = Math.abs(rate_rad_s * Math.sin(scenario.site.latitude_deg * kRadian) * at_s), ratio = drift / turned, kNear = 0.1;
    const right = Math.abs(ratio - 1) <= kNear ? 1 : ratio < 1 ? 0 : 2;
    return {
      facts, right, choices: ["less than that", "as much, within a tenth", "more than that"],
      question: `In ${format(at_s, 6)} s the laboratory turns about the vertical by Ω |sin(latitude)| t. Compute that angle. Is the drift of the axis as large?`,
      lines: ["Ω |sin(latitude)| t =", "I expect a drift of", "because", kThen],
      answers: [known, turned > 0 ? `Ω |sin(latitude)| t is ${radians(turned)}; the drift is ${format(ratio, 3)} times that.` :
        "Here the laboratory does not turn about the vertical at all.", ...why.slice(0, 2)],
    };
  }
  const frames = Math.max(1, Math.round((kFrames_1_s * at_s) / 10)), mean_rad = kFrame_rad / Math.sqrt(frames);
  return {
    facts, choices: ["yes", "no"], right: drift > kErrors * mean_rad ? 0 : 1,
    question: `A camera takes ${kFrames_1_s} frames a second and sees the axis to ${radians(kFrame_rad, 2)} in each. The ${frames} frames of the last tenth of ` +
      `the ${format(at_s, 6)} s are averaged. Does the drift then stand at ${kErrors} standard errors?`,
    lines: ["Standard error of the mean =", "Drift that I expect =", "What else must be known, and how well?", kThen],
    answers: [known, `The mean of ${frames} frames has a standard error of ${radians(mean_rad, 3)}, so the drift stands at ${format(drift / mean_rad, 3)} of ` +
      `them; a frame may be wrong by ${radians((drift * Math.sqrt(frames)) / kErrors, 3)} at most.`, ...why.slice(0, 2)],
  };
}
