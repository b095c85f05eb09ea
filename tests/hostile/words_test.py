#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks for what no user should read: text that libraries wrote for programmers, and numbers that seem to agree where they differ.

usage: words_test.py PROGRAM [--seed N] [--count N] [--only KIND]

Kinds:
  documents   at every door that reads JSON, a value is replaced by one of another kind, or a member is taken away
  stores      a study's store with a table, a column, a value or bytes that are not its own
  limits      numbers just outside what is allowed: the limit in the message differs from the number given, and what the message
              asks for is accepted
  memory      every verb with too little memory
  usage       command lines that the parser refuses
"""
import copy
import json
import os
import pathlib
import re
import resource
import shutil
import sqlite3
import tempfile

import attack
import doors_test

# Beginnings and parts of messages of libraries, of the C++ library and of interpreters.
RAW = re.compile(r"json\.exception|\bstd::|bad_alloc|boost::|filesystem error|basic_string|vector::|\b_M_|__throw|"
                 r"terminate called|what\(\)|SQLite|sqlite3|disk image|file is not a database|no such (?:table|column)|"
                 r"disk I/O error|database schema|gsl:|nlohmann::|type must be|ReferenceType|\bsto[id]\b|Could not convert|"
                 r"Traceback|CLI::|unexpected: |Assertion|operator\(\)")
OTHERS = [None, "x", "", [], {}, [1], {"a": 1}, True, -1, 0, 1.5, 1e308, -1e-320, 9007199254740993, "nan", [[]]]


def faults_of(end, ends=(0, 1, 2, 3, 4)):
    """Faults of how a program ended, and of its words."""
    faults = []
    if end.status not in ends:
        faults.append(f"status {end.status}: {end.err[-200:]!r}")
    for text in (end.out, end.err):
        found = RAW.search(text)
        if found:
            faults.append(f"...{text[max(0, found.start() - 80):found.end() + 60]!r}")
    if end.status not in (0, 1, None) and not (end.out + end.err).strip():
        faults.append(f"status {end.status} without a word")
    return faults


def places(document, at=()):
    """The paths of all values within a document."""
    items = document.items() if isinstance(document, dict) else enumerate(document) if isinstance(document, list) else ()
    for key, value in items:
        yield (*at, key)
        yield from places(value, (*at, key))


def mutated(chosen, document):
    """A copy with one value of another kind, or without one."""
    document = copy.deepcopy(document)
    *parents, last = chosen.choice(list(places(document)))
    inner = document
    for key in parents:
        inner = inner[key]
    if chosen.random() < 0.3:
        del inner[last]
    else:
        inner[last] = chosen.choice([other for other in OTHERS if type(other) is not type(inner[last])])
    return document


def document_cases(under, good, count):
    """Cases (kind, name, files to be written, command line)."""
    for door in doors_test.DOORS:
        if door.content != "json":
            continue
        document = json.loads((good / door.file).read_text())
        for number in range(count):
            yield "documents", f"{door.name} {number}", {door.file: json.dumps(mutated(under.random, document)).encode()}, door.command


def store_cases(under, good, count):
    """The same of a store, whose content is changed by SQL or byte by byte."""
    whole = (good / "done/study.sqlite").read_bytes()
    changes = ["DROP TABLE point", "DROP TABLE study", "ALTER TABLE point RENAME COLUMN status TO other",
               "ALTER TABLE point DROP COLUMN reason", "DELETE FROM study", "UPDATE study SET value = x'00ff'",
               "UPDATE point SET status = 7", "UPDATE point SET number = -1 WHERE number = 0", "CREATE VIEW v AS SELECT * FROM nothing",
               "UPDATE study SET value = 'x' WHERE key = 'format'", "UPDATE study SET value = '' WHERE key = 'study'",
               "UPDATE study SET value = NULL"]
    commands = ["study show done", "study study.json --out done --quiet", "report done", "compare done done", "study export done",
                "study study.json --out done --quiet --repair", "study show done --json"]
    for number, change in enumerate(changes):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "study.sqlite"
            file.write_bytes(whole)
            try:
                with sqlite3.connect(file) as store:
                    store.execute(change)
            except sqlite3.Error:
                continue
            store.close()
            content = file.read_bytes()
        for command in under.random.sample(commands, min(3, count)):
            yield "stores", f"{change}: {command}", {"done/study.sqlite": content}, command.split()
    for number in range(3 * count):
        content = bytearray(whole)
        for _ in range(under.random.choice([1, 8, 200])):
            content[under.random.randrange(under.random.choice([100, 4096, len(content)]))] = under.random.randrange(256)
        if under.random.random() < 0.3:
            del content[under.random.randrange(1, len(content)):]
        command = under.random.choice(commands)
        yield "stores", f"bytes {number}: {command}", {"done/study.sqlite": bytes(content)}, command.split()


def usage_cases(under):
    """Command lines that are refused."""
    for line in ["run top.json --json=maybe", "run top.json --jobs x", "run --out", "run top.json --set", "check", "compare old",
                 "study study.json --shard 3", "completion foo", "plan top.json --sigma x", "bench top.json --limit z", "run -x",
                 "report old --svg=3", "run top.json --quiet=2", "check top.json --force", "explain", "verify nothing", "example no",
                 "study show", "study export", "run top.json --set /motion/duration_s", "run top.json --set =3", "run top.json --out ''"]:
        yield "usage", line, {}, [word.strip("'") for word in line.split()]


MEMORY = ["run top.json --out new", "check top.json", "explain top.json", "report old", "compare old plain", "study study.json --out new",
          "plan top.json --measure tilt_deg --sigma 1 --every 0.5", "compare top.json measured.csv", "study show done", "run top.json --json"]


def memory_cases(under, count):
    """Verbs under a limit of memory that the seed chooses (MiB)."""
    for command in MEMORY:
        for _ in range(count):
            limit = under.random.choice([24, 28, 32, 36, 40, 48, 56, 64]) * (1 << 20) + under.random.randrange(1 << 20)
            yield "memory", f"{command} in {limit >> 20} MiB", {"": limit}, command.split()


NUMBER = r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?"
AGREE = re.compile(rf"({NUMBER}) (?:\S+ )*?(?:is out of range; must be a number (?:from|of at least|above .* at most)|is longer than \D*|"
                   rf"is not above \D*|is not found \D*) ({NUMBER})")


def limit_cases(under, program):
    """Scenarios with a number just outside of its range, and with rows and steps just beyond what is allowed."""
    schema = json.loads(under.run("schema").out)
    top = doors_test.TOP

    def properties(node, at=()):
        for key, value in node.get("properties", {}).items():
            yield (*at, key), value
            yield from properties(value, (*at, key))

    for path, value in properties(schema):
        for bound, direction in (("minimum", -1), ("exclusiveMinimum", 0), ("maximum", 1), ("exclusiveMaximum", 0)):
            if bound in value:
                for step in (1e-15, 1e-9):
                    number = float(value[bound])
                    beyond = number + direction * max(abs(number) * step, step if number == 0 else 0)
                    yield "limits", "/".join(path) + f" {beyond!r}", with_value(top, path, beyond), "check"
    for _ in range(20):
        duration = under.random.choice([60, 1, 7.3, under.random.uniform(0.1, 1000)])
        rows = under.random.choice([2_000_000, 2_000_001, 1_999_999.5, 1_999_999.99])
        document = with_value(top, ("motion", "duration_s"), duration)
        yield "limits", f"{rows} rows in {duration!r} s", with_value(document, ("motion", "output_step_s"), duration / rows), "check"
        steps = under.random.choice([2e9, 2e9 + 1000, 2e9 * (1 + 1e-6)])
        document["motion"]["output_step_s"] = duration / 100
        document["numerics"] = {"method": "gauss", "step_s": duration / steps * (1 - under.random.choice([1e-3, 1e-8, 1e-12]))}
        yield "limits", f"{steps} steps in {duration!r} s", document, "check"
    for norm in (1 + 1.0000001e-6, 1 - 1.000000001e-6, 1 + 1.5e-6):
        document = copy.deepcopy(top)
        document["release"] = {"quaternion_LB": {"w": norm, "x": 0, "y": 0, "z": 0}, "spin_rad_s": 100}
        yield "limits", f"norm {norm!r}", document, "check"
    for rate in (0.999999, 0.99999999, 1 - 1e-12):
        document = with_value(top, ("release", "precession"), "steady_slow")
        document["release"]["tilt_deg"] = 30
        least = 2 * (1.2e-4 * 0.1 * 9.8 * 0.03 * 3 ** 0.5 / 2) ** 0.5 / 4e-5
        document["release"]["spin_rad_s"] = least * rate
        yield "limits", f"steady at {rate!r} of the least spin", document, "check"
    for every in (2.0000001, 2.000001, 2.1):
        yield "limits", f"rows every {every} s of 2 s", top, f"plan --measure tilt_deg --sigma 1 --every {every}"


def with_value(document, path, value):
    """A copy with a value at a path."""
    document = copy.deepcopy(document)
    inner = document
    for key in path[:-1]:
        inner = inner.setdefault(key, {}) if isinstance(inner.get(key, {}), dict) else {}
    inner[path[-1]] = value
    return document


def faults_of_limits(under, folder, case):
    """Faults of the numbers in a refusal, and of the remedy that it gives."""
    def said(document):
        (folder / "top.json").write_text(json.dumps(document))
        verb, *more = case[3].split()
        return under.run(verb, "top.json", *more, cwd=folder)

    end = said(case[2])
    faults = faults_of(end)
    for line in end.err.splitlines():
        line = re.sub(r"^\S*:\d+:\d+: ", "", line)
        for one, other in AGREE.findall(line):
            if float(one) == float(other):
                faults.append(f"two numbers seem to agree: {line!r}")
        counts = re.search(rf"about ({NUMBER}) (?:output rows|steps); at most ({NUMBER}) are", line)
        if counts and float(counts[1]) <= float(counts[2]):
            faults.append(f"not more than allowed: {line!r}")
        norm = re.search(rf"has the norm ({NUMBER});", line)
        if norm and abs(float(norm[1]) - 1) <= 1.00000000001e-6:
            faults.append(f"a norm that is allowed: {line!r}")
        remedy = re.search(rf"(output_step_s|step_s|spin_rad_s\|) must be at least ({NUMBER}) ", line)
        if remedy:
            key = remedy[1].rstrip("|")
            path = {"output_step_s": ("motion", key), "step_s": ("numerics", key), "spin_rad_s": ("release", key)}[key]
            again = said(with_value(case[2], path, float(remedy[2])))
            if "must be at least" in again.err:
                faults.append(f"the remedy is refused again: {line!r}: {again.err[:200]!r}")
    return faults


def main():
    """Runs all cases."""
    under = attack.Attack(__doc__, lambda parser: parser.add_argument("--count", type=int, default=8))
    count = under.options.count
    with tempfile.TemporaryDirectory() as temporary:
        good = pathlib.Path(temporary) / "good"
        good.mkdir()
        doors_test.make_good(under.program, good)

        def attempt(case, folder):
            folder = pathlib.Path(folder)
            if case[0] == "limits":
                return faults_of_limits(under, folder, case)
            shutil.copytree(good, folder, dirs_exist_ok=True)
            more = {}
            for name, content in case[2].items():
                if name:
                    (folder / name).write_bytes(content)
                else:
                    more["preexec_fn"] = lambda: resource.setrlimit(resource.RLIMIT_AS, (content, content))
            end = under.run(*case[3], cwd=folder, **more)
            lacks = case[0] == "memory" and end.status == 127  # the loader of shared libraries has no memory
            faults = [] if lacks else faults_of(end)
            if end.status == 0 and case[3][0] == "report":
                for page in folder.rglob("*.html"):
                    faults += faults_of(attack.End(0, re.sub(r"<script.*?</script>", "", page.read_text(), flags=re.DOTALL), ""))
            return faults

        under.all([*document_cases(under, good, count), *store_cases(under, good, count), *usage_cases(under),
                   *memory_cases(under, (count + 3) // 4), *limit_cases(under, under.program)], attempt)
    under.end()


if __name__ == "__main__":
    main()
