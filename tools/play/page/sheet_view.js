// SPDX-License-Identifier: GPL-3.0-or-later
// The pupil's sheet on the page: the prediction first, then the run. On paper it is one page.

/** What the sheet shows is fixed while it asks: moving a slider asks anew. */
const kSheet = { asks: "", chosen: -1 };

function sheetNow() {
  return sheetOf(kState.level, { name: kState.preset, scenario: JSON.parse(kState.scenario), summary: kState.summary,
    rate_rad_s: (kState.values.earth ?? 1) * kSettings.earth_rate_rad_s });
}

/** A place to write on: a line on paper, a field on a screen. */
function writingLine(label, number) {
  const line = element("div", "line"), field = element("input");
  Object.assign(field, { type: "text", id: `line-${number}`, maxLength: 200, autocomplete: "off" });
  const words = element("label", "", label);
  words.htmlFor = field.id;
  line.append(words, field);
  return line;
}

function choiceList(sheet) {
  const group = element("fieldset"), words = element("legend", "", "My prediction");
  group.append(words);
  sheet.choices.forEach((text, i) => {
    const label = element("label", "choice"), radio = element("input");
    Object.assign(radio, { type: "radio", name: "prediction", value: String(i) });
    radio.addEventListener("change", () => { kSheet.chosen = i; byId("predict").disabled = false; });
    label.append(radio, text);
    group.append(label);
  });
  return group;
}

/** Writes the sheet anew where the scene, the level or the run has changed. */
function tellSheet() {
  if (kState.level === "" || !kState.summary) return;
  const asks = `${kState.level} ${kState.scenario}`, room = byId("sheet");
  if (asks === kSheet.asks) return;
  kSheet.asks = asks;
  kSheet.chosen = -1;
  document.body.classList.remove("told");
  byId("predict").disabled = true;
  byId("sheet-scene").textContent = `${kLevels[kState.level]}. ${presetNow().title}.`;
  const sheet = sheetNow();
  if (sheet.none) return void room.replaceChildren(element("p", "", sheet.none));
  const facts = element("dl", "facts");
  for (const [term, what] of sheet.facts) facts.append(element("dt", "", term), element("dd", "", what));
  const answer = element("div", "answer");
  answer.append(element("h3", "", "What the run says"), element("p", "judged"), ...sheet.answers.map((text) => element("p", "", text)));
  room.replaceChildren(facts, element("p", "question", sheet.question), choiceList(sheet), ...sheet.lines.map(writingLine), answer);
}

function showSheet() {
  const isOpen = kState.level !== "";
  byId("section-sheet").hidden = !isOpen;
  document.body.classList.toggle("with-sheet", isOpen);
  if (!isOpen) document.body.classList.remove("told");
  if (isOpen) byId("level").value = kState.level;
  kSheet.asks = "";
  tellSheet();
}

/** The prediction is made: the answer is shown beside it, and the pictures. */
function tellAnswerOfSheet() {
  if (kSheet.chosen < 0) return;
  const sheet = sheetNow(), judged = document.querySelector("#sheet .judged");
  judged.textContent = kSheet.chosen === sheet.right ? "The prediction holds." : `It is another one: ${sheet.choices[sheet.right]}.`;
  document.body.classList.add("told");
  for (const field of document.querySelectorAll("#sheet input[type=radio]")) field.disabled = true;
  byId("predict").disabled = true;
}

function startSheet() {
  const level = byId("level");
  level.append(...Object.entries(kLevels).map(([id, label]) => new Option(label, id)));
  const open = (name) => { kState.level = name; showSheet(); writeLink(); };
  level.addEventListener("change", () => open(level.value));
  byId("open-sheet").addEventListener("click", () => { open(level.value); byId("section-sheet").scrollIntoView(); level.focus(); });
  byId("close-sheet").addEventListener("click", () => { open(""); byId("open-sheet").focus(); });
  byId("predict").addEventListener("click", tellAnswerOfSheet);
  byId("print").addEventListener("click", () => window.print());
}
