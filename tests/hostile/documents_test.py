#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes bits and digits in documents that the program reads back, with their checksums and without, and mixes what does not
belong together.

usage: documents_test.py PROGRAM [--seed N] [--flips N] [--jobs N] [--only TEXT]

Of every kind of document a copy is changed and given to the verb that reads it. Each must hold:
  - as it was, it is read, without its checksum with a note;
  - with its checksum, a changed copy is refused by name (status 2), or it is equal in meaning;
  - without, it is refused, or the program says that it is not verified and every number in it is within its range;
  - a timing.json of another result, and a point of a study that the study has not, are refused by name;
  - a number put out of its range is refused by its pointer;
  - what is printed has no invisible characters.
"""
import json
import math
import pathlib
import re
import shutil
import sqlite3
import tempfile
import unicodedata

from attack import Attack

TOP = {"name": "top", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
       "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
       "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 2, "output_step_s": 0.1}}
STUDY = {"base": "top.json", "axes": [{"pointer": "/site/latitude_deg", "values": [10, 50, 60]}]}
REFUSED = 2
CHECKSUM = re.compile(rb',\s*"(checksum|files)":\s*("[0-9a-f]{16}"|\{[^{}]*\})(?=\s*[,}])')
NUMBER = re.compile(rb"(?<=[\s:\[])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?=[\s,\]}])")

# A document: its file, the verb that reads it, and what it is made by.
DOCUMENTS = {
    "comparison": ("comparison.json", "report comparison.json"),
    "measurement": ("measurement.json", "report measurement.json"),
    "plan": ("plan.json", "report plan.json"),
    "bench": ("bench.json", "report bench.json"),
    "summary, compare": ("new/summary.json", "compare old new"),
    "summary, report": ("new/summary.json", "report new"),
    "timing, compare": ("new/timing.json", "compare old new"),
    "timing, report": ("new/timing.json", "report new"),
    "compact reference": ("reference.json", "compare reference.json old"),
}

# Numbers by what they are, told anew here: pointers (a star for any key or index), and whether a value is in the range.
NOT_NEGATIVE = lambda x: x >= 0
COUNT = lambda x: x >= 0 and x == math.floor(x)
PROBABILITY = lambda x: 0 <= x <= 1
CORRELATION = lambda x: abs(x) <= 1 + 1e-9
RANGES = {
    "comparison": {"/pairs/*/quantities/*/tolerance": NOT_NEGATIVE, "/pairs/*/quantities/*/largest_difference": NOT_NEGATIVE,
                   "/pairs/*/quantities/*/share_used": NOT_NEGATIVE, "/pairs/*/quantities/*/error_bounds_sum": NOT_NEGATIVE,
                   "/pairs/*/quantities/*/compared": COUNT, "/pairs/*/quantities/*/violations": COUNT,
                   "/pairs/*/quantities/*/interpolation_error": NOT_NEGATIVE,
                   "/pairs/*/rows_compared": COUNT, "/pairs/*/rows_of_reference": COUNT,
                   "/pairs/*/quantities/*/curve/tolerance/*": NOT_NEGATIVE,
                   "/pairs/*/quantities/*/curve/difference/*": NOT_NEGATIVE, "/pairs/*/cost/*/new": NOT_NEGATIVE,
                   "/pairs/*/cost/*/reference": NOT_NEGATIVE, "/pairs/*/cost/*/ratio": NOT_NEGATIVE},
    "measurement": {"/chi_squared/*/p_value": PROBABILITY, "/chi_squared/*/value": NOT_NEGATIVE, "/correlation/*/*": CORRELATION,
                    "/chi_squared/*/per_degree_of_freedom": NOT_NEGATIVE, "/chi_squared/*/of_priors": NOT_NEGATIVE,
                    "/least_p_value": PROBABILITY, "/estimates/*/standard_error": NOT_NEGATIVE, "/rows": COUNT,
                    "/estimates/*/standard_error_scaled": NOT_NEGATIVE, "/residuals/*/standard_error_rad": NOT_NEGATIVE,
                    "/largest_residual/standard_error_rad": NOT_NEGATIVE, "/residuals/*/line": COUNT,
                    "/largest_residual/line": COUNT,
                    **{f"/fit/{name}": COUNT for name in ("predictions", "iterations", "spans", "attempts", "minima")},
                    "/quantities/*/values": COUNT, "/prediction/reached_s": NOT_NEGATIVE,
                    "/estimates/*/finding/limit_sigma": NOT_NEGATIVE, "/estimates/*/finding/from_zero_sigma": NOT_NEGATIVE,
                    "/estimates/*/finding/known_standard_error": NOT_NEGATIVE, "/estimates/*/exact/*/misfit": NOT_NEGATIVE,
                    "/estimates/*/exact/*/error_of_one_sigma": NOT_NEGATIVE},
    "plan": {"/estimates/*/standard_error": NOT_NEGATIVE, "/plan/quantities/*/standard_error": NOT_NEGATIVE, "/plan/rows": COUNT,
             "/plan/values": COUNT, "/plan/until_s": NOT_NEGATIVE, "/plan/correlation_time_s": NOT_NEGATIVE,
             "/plan/every_s": NOT_NEGATIVE, "/prediction/motions": COUNT, "/correlation/*/*": CORRELATION,
             "/estimates/*/standard_error_alone": NOT_NEGATIVE, "/variations/*/standard_error": NOT_NEGATIVE,
             "/variations/*/rows": COUNT, "/variations/*/factor": NOT_NEGATIVE, "/changes/*/standard_error": NOT_NEGATIVE,
             "/variations/*/input_standard_error": NOT_NEGATIVE, "/changes/*/input_standard_error": NOT_NEGATIVE,
             "/changes/*/rows": COUNT, "/changes/*/factor": NOT_NEGATIVE, "/optimum/standard_error": NOT_NEGATIVE,
             "/optimum/rows": COUNT, "/optimum/evaluations": COUNT, "/optimum/avoided": COUNT,
             "/estimates/*/finding/limit_sigma": NOT_NEGATIVE, "/estimates/*/finding/from_zero_sigma": NOT_NEGATIVE,
             "/estimates/*/finding/known_standard_error": NOT_NEGATIVE, "/estimates/*/exact/*/misfit": NOT_NEGATIVE,
             "/estimates/*/exact/*/error_of_one_sigma": NOT_NEGATIVE},
    "bench": {"/scenarios/*/entries/*/seconds": NOT_NEGATIVE, "/scenarios/*/entries/*/seconds_least": NOT_NEGATIVE,
              "/scenarios/*/entries/*/seconds_most": NOT_NEGATIVE, "/scenarios/*/entries/*/evaluations": COUNT,
              "/scenarios/*/entries/*/steps": COUNT, "/scenarios/*/entries/*/rejected_steps": COUNT,
              "/scenarios/*/entries/*/error/*": NOT_NEGATIVE, "/scenarios/*/entries/*/repetitions": COUNT,
              "/scenarios/*/reference/error/*": NOT_NEGATIVE, "/scenarios/*/entries/*/relative_tolerance": NOT_NEGATIVE,
              "/scenarios/*/duration_s": NOT_NEGATIVE, "/scenarios/*/checkpoints": COUNT,
              "/scenarios/*/most_seconds": NOT_NEGATIVE, "/scenarios/*/largest_drift_rad": NOT_NEGATIVE,
              "/scenarios/*/equal_error/*/costs/*/error_rad": NOT_NEGATIVE,
              "/scenarios/*/equal_error/*/costs/*/seconds": NOT_NEGATIVE},
    "summary": {"/drift/axis_bound_rad": NOT_NEGATIVE, "/drift/attitude_bound_rad": NOT_NEGATIVE, "/outcome/rows": COUNT,
                "/solution/steps_accepted": COUNT, "/certificate/right_hand_side_evaluations": COUNT,
                "/attitude_bound_rad": NOT_NEGATIVE},
    "timing": {"/solution_s": NOT_NEGATIVE, "/certificate_s": NOT_NEGATIVE, "/looks_s": NOT_NEGATIVE},
    "compact": {"/summary/drift/axis_bound_rad": NOT_NEGATIVE, "/summary/solution/steps_accepted": COUNT, "/row_count": COUNT},
}
# The other numbers of documents, which may be any. A new member must be in one of the two.
FREE = {
    "comparison": ["/pairs/*/quantities/*/at_s", "/pairs/*/quantities/*/first_violation_s", "/pairs/*/quantities/*/curve/t_s/*",
                   "/pairs/*/compared_until_s", "/pairs/*/compared_from_s", "/pairs/*/compared_to_s", "/pairs/*/common_end_s"],
    "measurement": ["/chi_squared/*/degrees_of_freedom", "/estimates/*/start", "/estimates/*/estimate", "/estimates/*/finding/known",
                    "/estimates/*/finding/from_known_sigma", "/estimates/*/exact/*/value", "/estimates/*/exact/*/shift",
                    *(f"{place}/{name}" for place in ("/residuals/*", "/largest_residual") for name in (
                        "t_s", "measured_rad", "predicted_rad", "residual_rad", "normalised")), "/curve/*/*"],
    "plan": ["/estimates/*/value", "/estimates/*/significance", "/estimates/*/finding/known", "/estimates/*/finding/from_known_sigma",
             "/estimates/*/exact/*/value", "/estimates/*/exact/*/shift", "/optimum/choices/*/*", "/optimum/significance"],
    "bench": ["/scenarios/*/entries/*/step_s"],
}


def ranges_of(kind):
    return RANGES[re.split(r"[, ]", kind)[0]]


def numbers_at(json_value, pointer):
    """The numbers at a pointer, with their own pointers."""
    places = [("", json_value)]
    for step in pointer.split("/")[1:]:
        below = []
        for at, value in places:
            items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else []
            below += [(f"{at}/{key}", one) for key, one in items if step in ("*", str(key))]
        places = below
    return [(at, value) for at, value in places if isinstance(value, (int, float)) and not isinstance(value, bool)]


def unknown_numbers(kind, document):
    """The pointers of numbers of which nothing is said above."""
    known = {at for pointer in (*ranges_of(kind), *FREE[kind]) for at, _ in numbers_at(document, pointer)}

    def all_in(value, at):
        if isinstance(value, (dict, list)):
            for key, one in value.items() if isinstance(value, dict) else enumerate(value):
                yield from all_in(one, f"{at}/{key}")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield at

    return [at for at in all_in(document, "") if at not in known]


def out_of_range(kind, text):
    """The pointers of numbers that are out of their ranges; None where it is no JSON."""
    try:
        document = json.loads(text)
    except ValueError:
        return None
    return [at for pointer, holds in ranges_of(kind).items() for at, value in numbers_at(document, pointer) if not holds(value)]


def without_checksum(text):
    return CHECKSUM.sub(b"", text)


def equal_in_meaning(one, other):
    try:
        return json.loads(one) == json.loads(other)
    except ValueError:
        return False


class Documents(Attack):
    def make(self, folder):
        """Writes all documents, each by the program that is attacked."""
        def earthtop(*arguments, statuses=(0, 1)):
            end = self.run(*arguments, cwd=folder)
            if end.status not in statuses:
                raise SystemExit(f"earthtop {' '.join(arguments)}: status {end.status}\n{end.err}")
            return end.out

        (folder / "top.json").write_text(json.dumps(TOP))
        (folder / "study.json").write_text(json.dumps(STUDY))
        (folder / "measured.csv").write_text("t_s,azimuth_deg,azimuth_se_deg\n" + "".join(
            f"{t / 10},{90 + 0.1 * (-1) ** t},30\n" for t in range(20)))
        earthtop("run", "top.json", "--out", "old", "--quiet")
        earthtop("run", "top.json", "--out", "new", "--quiet", "--set", "/site/latitude_deg=46")
        earthtop("compare", "reference.json", "old", "--update", "--reason", "first")
        for name, arguments in {
                "comparison": ["compare", "old", "new"],
                "measurement": ["compare", "top.json", "measured.csv", "--estimate", "omega_sin_latitude_rad_s", "--estimate",
                                "/release/azimuth_deg"],
                "plan": ["plan", "top.json", "--measure", "azimuth_deg", "--sigma", "0.01", "--every", "0.5", "--nuisance",
                         "spin_rad_s", "--optimise", "/release/tilt_deg=5:60"],
                "bench": ["bench", "top.json", "--repetitions", "1", "--methods", "taylor"]}.items():
            (folder / f"{name}.json").write_text(earthtop(*arguments, "--json"))
        earthtop("study", "study.json", "--out", "done", "--quiet")

    def changes(self, text):
        """Copies of a document, each with one change: bits anywhere, and digits, signs and points of its numbers."""
        places = list(NUMBER.finditer(text))
        for _ in range(self.options.flips):
            at = self.random.randrange(len(text))
            yield text[:at] + bytes([text[at] ^ 1 << self.random.randrange(8)]) + text[at + 1:]
            number = self.random.choice(places)
            yield text[:number.start()] + self.changed(number.group()) + text[number.end():]

    def changed(self, number):
        way = self.random.randrange(4)
        if way == 0:
            return number[1:] if number[:1] == b"-" else b"-" + number
        at = self.random.randrange(len(number))
        if way == 1:
            return number[:at] + bytes([number[at] ^ 1 << self.random.randrange(8)]) + number[at + 1:]
        if way == 2:
            return number[:at] + b"%d" % self.random.randrange(10) + number[at:]
        return number[:at] + b"%d" % self.random.randrange(10) + number[at + 1:]

    def cases(self, good):
        for kind, (file, command) in DOCUMENTS.items():
            text = (good / file).read_bytes()
            for sort, whole in (("with checksum", text), ("without", without_checksum(text))):
                yield f"{kind}, as it was", sort, file, command, whole, whole
                for number, changed in enumerate(self.changes(whole)):
                    if changed != whole:
                        yield f"{kind}, {sort}", f"change {number}", file, command, changed, whole
            bare = without_checksum(text)
            for pointer, holds in ranges_of(kind).items():
                found = numbers_at(json.loads(bare), pointer)
                if not found:  # another version may not have it
                    continue
                at, _ = self.random.choice(found)
                for bad in (-1, 0.5 if holds is COUNT else None, 1.5 if holds in (PROBABILITY, CORRELATION) else None):
                    if bad is None or holds(bad):
                        continue
                    yield f"{kind}, out of range", at, file, command, self.replaced(bare, at, bad), bare

    @staticmethod
    def replaced(text, pointer, value):
        document = json.loads(text)
        place = document
        *steps, last = [int(step) if step.isdigit() else step for step in pointer.split("/")[1:]]
        for step in steps:
            place = place[step]
        place[last] = value
        return (json.dumps(document, indent=2) + "\n").encode()

    def attempt(self, case, folder):
        kind, name, file, command, changed, whole = case
        work = pathlib.Path(folder) / "work"
        shutil.copytree(self.good, work)
        (work / file).write_bytes(changed)
        if kind.startswith("summary") and "without" in kind:  # whose numbers no other file repeats
            (work / "new/timing.json").unlink()
        end = self.run(*command.split(), cwd=work)
        faults = [] if end.status in (0, 1, 2) else [f"status {end.status}: {end.err[:200]}"]
        if "as it was" in kind:
            told = "has no checksums" in end.out + end.err
            return faults + ([] if end.status != REFUSED and told == (name == "without") else [f"status {end.status}: {end.err[:200]}"])
        if end.status == REFUSED:
            named = file if "/" not in file else file.split("/")[0]
            if named not in end.err:
                faults.append(f"refused without the file's name: {end.err[:200]}")
            return faults
        if "out of range" in kind:
            return [*faults, "believed"]
        if equal_in_meaning(changed, whole):
            return faults
        if "with checksum" in kind:
            return [*faults, "believed"]
        wrong = out_of_range(kind, changed)
        if wrong is None:
            faults.append("no JSON, and believed")
        elif wrong:
            faults.append(f"out of range, and believed: {', '.join(wrong[:3])}")
        if "has no checksums" not in end.out + end.err:
            faults.append("nothing says that it is not verified")
        return faults

    def look_for_the_unknown(self):
        for kind in FREE:
            unknown = unknown_numbers(kind, json.loads((self.good / DOCUMENTS[kind][0]).read_text()))
            self.note("number without a range", kind, unknown[:5])

    # Things that do not belong together -------------------------------------------------------------------------------

    def mixed(self, kind, name, change, command, words):
        """Changes a copy of all files by a function; what is then done must be refused with these words."""
        work = self.good.parent / "mixed"
        shutil.copytree(self.good, work)
        change(work)
        end = self.run(*command.split(), cwd=work)
        shutil.rmtree(work)
        good = end.status in (1, 2) and words in end.out + end.err
        self.note(kind, name, [] if good else [f"status {end.status}: {(end.out + end.err)[:200]!r}"])

    def mix(self):
        def timing(work):
            shutil.copy(work / "old/timing.json", work / "new/timing.json")

        for command in ("compare old new", "report new", "compare kept new --update --reason test"):
            self.mixed("timing of another result", command, timing, command, "timing.json")

        def renumbered(number, has_checksums):
            def change(work):
                with sqlite3.connect(work / "done/study.sqlite") as store:
                    if not has_checksums:
                        store.execute("ALTER TABLE point DROP COLUMN row_checksum")
                        store.execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')")
                    store.execute("UPDATE point SET number = ? WHERE number = 1", (number,))
            return change

        for has_checksums in (True, False):
            for number in (-1, 3, -2**63, 2**63 - 1, self.random.randrange(3, 2**40), -self.random.randrange(1, 2**40)):
                for command in ("study show done", "report done", "study export done", "study merge done --out all", "compare done done"):
                    name = f"{number}, {'with' if has_checksums else 'without'} checksums, {command}"
                    words = str(number) if not has_checksums else "damaged"
                    self.mixed("store's row number", name, renumbered(number, has_checksums), command, words)

        hidden = "a\u202eb\u2066c\u200bd"
        (self.good / "hidden.json").write_text(json.dumps({**TOP, "title": hidden}))
        for command in ("bench hidden.json --json --methods taylor --repetitions 1", "explain hidden.json --json",
                        "run hidden.json --json --out hidden"):
            end = self.run(*command.split(), cwd=self.good)
            seen = [character for character in end.out + end.err if unicodedata.category(character) == "Cf"]
            kept = end.status == 0 and hidden in json.dumps(json.loads(end.out), ensure_ascii=False)
            self.note("invisible characters", command, [f"{len(seen)} of them"] if seen else [] if kept or "title" not in end.out
                      else ["the title is not what it was"])


def main():
    attack = Documents(__doc__, lambda parser: parser.add_argument("--flips", type=int, default=30))
    with tempfile.TemporaryDirectory() as temporary:
        attack.good = pathlib.Path(temporary) / "good"
        attack.good.mkdir()
        attack.make(attack.good)
        attack.look_for_the_unknown()
        attack.all(attack.cases(attack.good), attack.attempt)
        attack.mix()
    attack.end()


if __name__ == "__main__":
    main()
