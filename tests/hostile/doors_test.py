#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives hostile files to every verb, by every option, that reads one, and checks how they are refused.

usage: doors_test.py PROGRAM [--short] [--table] [--only TEXT]

A door is a verb and a file that it reads. For each door and each kind of damage these must hold:
  - the status is 2, or that of the undamaged file where the damage is none for this door (a byte order mark);
  - standard error names the file (a value of --set: its pointer);
  - no line that is printed has 2 KiB or more, or a control character, and there are not more than 22 on standard error;
  - it costs less than a second of processor time.
--short leaves out the kinds that cost most; --table prints a matrix of statuses; --only takes doors whose name contains TEXT.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unicodedata

MOST_SECONDS = float(os.environ.get("DOORS_SECONDS", "1"))  # builds with sanitizers are slower
LONGEST_LINE = 2047
MOST_LINES = 22
REFUSED = 2
AS_GOOD = "as good"
MIB = 1 << 20

TOP = {"name": "top", "site": {"latitude_deg": 45, "gravity_m_s2": 9.8},
       "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.03],
                "inertia": {"about": "pivot", "principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}},
       "release": {"tilt_deg": 20, "spin_rad_s": 200}, "motion": {"duration_s": 2, "output_step_s": 0.1},
       "numerics": {"ledger": "laboratory"}}
PLATFORM = dict(TOP, platform={"motion": "table", "axis": [0, 0, 1], "file": "table.csv"})
STUDY = {"base": "top.json", "axes": [{"pointer": "/site/latitude_deg", "values": [10, 50]}]}
MAPPING = {"time": {"column": "t_s"}, "axis": {"columns": ["axis_L_x", "axis_L_y", "axis_L_z"]}}
TOLERANCES = {"profile": "regression"}
BENCH = {"program": "earthtop", "processor": "any", "scenarios": []}

# A door: its name, the file that is damaged, the command line, and the kind of its content. `knows_its_keys` (or columns): an
# unknown one is refused.
Door = collections.namedtuple("Door", "name file command content knows_its_keys most_MiB")


def door(name, file, command, content="json", knows_its_keys=False, most_MiB=16):
    return Door(name, file, command.split(), content, knows_its_keys, most_MiB)


DOORS = [
    door("check SCENARIO", "top.json", "check top.json", knows_its_keys=True),
    door("run SCENARIO", "top.json", "run top.json --out new --quiet", knows_its_keys=True),
    door("study STUDY", "study.json", "study study.json --out new --quiet", knows_its_keys=True),
    door("study's base", "top.json", "study study.json --out new --quiet", knows_its_keys=True),
    door("platform table", "table.csv", "run platform.json --out new --quiet", "angles", knows_its_keys=True),
    door("--mapping", "mapping.json", "compare old foreign.csv --mapping mapping.json", knows_its_keys=True),
    door("--tolerances", "tolerances.json", "compare old new.csv --tolerances tolerances.json", knows_its_keys=True),
    door("measured CSV", "measured.csv", "compare top.json measured.csv", "csv"),
    door("foreign CSV", "foreign.csv", "compare old foreign.csv --mapping mapping.json", "csv"),
    door("own CSV", "new.csv", "compare old new.csv", "csv"),
    door("summary.json, compare", "plain/summary.json", "compare old plain"),
    door("summary.json, report", "plain/summary.json", "report plain"),
    door("summary.json, run --out", "plain/summary.json", "run top.json --out plain --quiet"),
    door("timing.json, compare", "plain/timing.json", "compare old plain"),
    door("timing.json, report", "plain/timing.json", "report plain"),
    door("trajectory.csv, compare", "plain/trajectory.csv", "compare old plain", "csv"),
    door("trajectory.csv, report", "plain/trajectory.csv", "report plain", "csv"),
    door("torques.csv, compare", "plain/torques.csv", "compare old plain", "csv"),
    door("compact reference", "reference.json", "compare reference.json old"),
    door("its history, --update", "reference.json", "compare reference.json old --update --reason test"),
    door("reference's notes, --update", "kept/reference.json", "compare kept old --update --reason test"),
    door("comparison, report", "comparison.json", "report comparison.json", most_MiB=256),
    door("measurement, report", "measurement.json", "report measurement.json", most_MiB=256),
    door("plan, report", "plan.json", "report plan.json", most_MiB=256),
    door("bench, report", "bench.json", "report bench.json", most_MiB=256),
    door("study.json, report", "done/study.json", "report done/study.json", most_MiB=256),
    door("study.json, compare", "done/study.json", "compare done/study.json old"),
    door("store's study, export", "done/study.sqlite", "study export done", "store", knows_its_keys=True),
    door("store's study, resume", "done/study.sqlite", "study study.json --out done", "store", knows_its_keys=True),
    door("--set", "/body/mass_kg", "run top.json --out new --quiet", "set", knows_its_keys=True),
]

CONTROL = "\\u001b[2J\\u009b31m\\u202e\\u0007"  # clears a terminal, colours, turns the direction of writing


def member(text, inserted):
    """A JSON object's text with a member put before all others."""
    at = text.index(b"{") + 1
    return text[:at] + inserted + b", " + text[at:]


def first_key(text):
    return json.dumps(next(iter(json.loads(text)))).encode()


def json_kinds(text, door):
    """Kinds of damage with the text that they make of a good one, and whether they are damage for this door."""
    unknown = REFUSED if door.knows_its_keys else AS_GOOD
    return {
        "byte order mark": (b"\xef\xbb\xbf" + text, AS_GOOD),
        "NUL at the end": (text + b"\0", REFUSED),
        "NUL and more": (text + b"\0more", REFUSED),
        "text after the end": (text + b"more", REFUSED),
        "two documents": (text + text, REFUSED),
        "not UTF-8": (member(text, b'"_\xff": 1'), REFUSED),
        "UTF-16": (text.decode().encode("utf-16"), REFUSED),
        "too deep": (member(text, b'"_x": ' + b"[" * 99 + b"]" * 99), REFUSED),
        "much too deep": (member(text, b'"_x": ' + b"[" * 500_000), REFUSED),
        "empty": (b"", REFUSED),
        "blank": (b" \n", REFUSED),
        "no object": (b"[]", REFUSED),
        "a long key": (member(text, b'"%s": 1' % (b"k" * 1_000_000)), unknown),
        "a long key twice": (member(text, b'"%s": 1, ' % (b"k" * 1_000_000) + b'"%s": 1' % (b"k" * 1_000_000)), REFUSED),
        "many unknown keys": (member(text, b", ".join(b'"k%d": 1' % i for i in range(9_000))), unknown),
        "20,000 unknown keys": (member(text, b", ".join(b'"k%d": 1' % i for i in range(20_000))), REFUSED),
        "cut in the middle": (text[:len(text) // 2], REFUSED),
        "a key twice": (member(text, first_key(text) + b": 1"), REFUSED),
        "control characters in a key": (member(text, b'"%s": 1' % CONTROL.encode()), unknown),
        "control characters in a key twice": (member(text, b'"%s": 1, "%s": 1' % ((CONTROL.encode(),) * 2)), REFUSED),
        "a raw control character": (member(text, b'"a\x1b[2J": 1'), REFUSED),
        "beyond a double": (member(text, b'"k": 1e999'), REFUSED),
        "NaN": (member(text, b'"k": NaN'), REFUSED),
    }


def csv_kinds(text, door):
    unknown = REFUSED if door.knows_its_keys else AS_GOOD
    header, rows = text.split(b"\n", 1)
    rows = rows.rstrip(b"\n").split(b"\n")
    names = header.split(b",")

    def widened(more_names, cell=b"0"):
        return b"\n".join([b",".join([header, *more_names])] + [row + (b"," + cell) * len(more_names) for row in rows]) + b"\n"

    many = [b"column_%d_of_them" % i for i in range(200_000)]
    wide_row = b"\n".join([header, *rows[:-1], rows[-1] + b",0" * 200_000]) + b"\n"
    kinds = {
        "byte order mark": (b"\xef\xbb\xbf" + text, REFUSED if door.content == "angles" else AS_GOOD),
        "NUL at the end": (text + b"\0", REFUSED),
        "NUL and more": (text + b"\0more\n", REFUSED),
        "NUL in a comment": (b"# \0\n" + text, REFUSED),
        "text after the end": (text + b"more\n", REFUSED),
        "two documents": (text + text, REFUSED),
        "not UTF-8": (b"# \xff\n" + text, REFUSED),
        "UTF-16": (text.decode().encode("utf-16"), REFUSED),
        "empty": (b"", REFUSED),
        "blank": (b" \n", REFUSED),
        "a long key": (widened([b"k" * 1_000_000]), unknown),
        "a long key twice": (widened([b"k" * 1_000_000] * 2), REFUSED),
        "cut in the middle": (text[:len(text) // 2 + 1].rstrip(b"\n"), REFUSED),
        "a key twice": (widened([names[-1]]), REFUSED),
        "control characters in a key": (widened([json.loads(f'"{CONTROL}"').encode()]), unknown),
        "control characters in a key twice": (widened([json.loads(f'"{CONTROL}"').encode()] * 2), REFUSED),
        "control characters in a number": (text.replace(rows[0], b"\x1b[2J" + rows[0], 1), REFUSED),
        "200,000 columns": (widened(many), REFUSED),
        "9,900 unknown columns": (widened(many[:9900]), unknown),
        "9,900 columns, the first renamed": (b"x" + widened(many[:9900]), REFUSED),
        "200,000 cells in a row": (wide_row, REFUSED),
        "a line without end": (header + b"\n" + b"1" * (17 * MIB), REFUSED),
    }
    if door.content == "angles":
        kinds["too large"] = (text + b"\n" * (16 * MIB), REFUSED)
    return kinds


# Kinds that replace the file by something else.
def directory(path, _):
    path.mkdir()


def fifo(path, _):
    os.mkfifo(path)


def too_large(path, door):
    path.write_bytes(b"{")
    os.truncate(path, door.most_MiB * MIB + 1)


SHORT = {"NUL and more", "a key twice", "control characters in a key", "200,000 columns"}


def set_kinds(_text, _door):
    return {kind: (value, REFUSED) for kind, value in {
        "text after the end": b"1 more", "two documents": b"1 1", "not UTF-8": b'"\xff"', "too deep": b"[" * 99 + b"]" * 99,
        "empty": b"", "a long key": b'{"%s": 1}' % (b"k" * 100_000), "a key twice": b'{"a": 1, "a": 2}',
        "control characters in a key": b'{"%s": 1}' % CONTROL.encode(), "a raw control character": b"\x1b[2J",
        "beyond a double": b"1e999", "NaN": b"NaN"}.items()}


KINDS = {"json": json_kinds, "csv": csv_kinds, "angles": csv_kinds, "store": json_kinds, "set": set_kinds}


def run(program, folder, arguments):
    """Status, standard output, standard error and processor time (s) of the program."""
    process = subprocess.Popen([program, *arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    with concurrent.futures.ThreadPoolExecutor(2) as readers:
        out, err = readers.submit(process.stdout.read), readers.submit(process.stderr.read)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, out.result(), err.result(), usage.ru_utime + usage.ru_stime


def make_good(program, folder):
    """Writes the undamaged files of all doors."""
    def earthtop(*arguments, statuses=(0, 1)):
        status, out, err, _ = run(program, folder, arguments)
        if status not in statuses:
            sys.exit(f"earthtop {' '.join(arguments)}: status {status}\n{err.decode()}")
        return out

    def write(name, document):
        (folder / name).write_text(json.dumps(document))

    def write_unsealed(name, text):
        """Writes a document without its checksums, so that other damage is what is found."""
        write(name, {key: value for key, value in json.loads(text).items() if key not in ("checksum", "files")})

    for name, document in {"top.json": TOP, "platform.json": PLATFORM, "study.json": STUDY, "mapping.json": MAPPING,
                           "tolerances.json": TOLERANCES, "bench.json": BENCH}.items():
        write(name, document)
    (folder / "table.csv").write_text("t_s,angle_rad\n" + "".join(f"{t},{t * t / 100}\n" for t in range(5)))
    (folder / "measured.csv").write_text("t_s,tilt_deg,tilt_se_deg\n0,20,0.1\n1,20,0.1\n2,20,0.1\n")
    earthtop("run", "top.json", "--out", "old", "--quiet")
    for name in ("new.csv", "foreign.csv"):
        shutil.copy(folder / "old/trajectory.csv", folder / name)
    shutil.copytree(folder / "old", folder / "plain")  # without checksums, as older results are
    for name in ("plain/summary.json", "plain/timing.json"):
        write_unsealed(name, (folder / name).read_text())
    earthtop("compare", "kept", "old", "--update", "--reason", "first")
    earthtop("compare", "reference.json", "old", "--update", "--reason", "first")
    write_unsealed("reference.json", (folder / "reference.json").read_text())
    write_unsealed("comparison.json", earthtop("compare", "plain", "old", "--json"))
    write_unsealed("measurement.json", earthtop("compare", "top.json", "measured.csv", "--json"))
    write_unsealed("plan.json", earthtop("plan", "top.json", "--measure", "drift_azimuth_rad", "--sigma", "1e-6", "--every", "0.5",
                                         "--json"))
    earthtop("study", "study.json", "--out", "done", "--quiet")
    write_unsealed("done/study.json", (folder / "done/study.json").read_text())
    with sqlite3.connect(folder / "done/study.sqlite") as store:  # as older stores are
        store.execute("ALTER TABLE point DROP COLUMN row_checksum")
        store.execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')")


def damage(path, door, content):
    """Puts a damaged file in place of a good one. @param content  bytes, or a function that makes something else"""
    if door.content == "store":
        with sqlite3.connect(path) as store:
            store.execute("UPDATE study SET value = CAST(? AS TEXT) WHERE key = 'study'", (content,))
        return
    path.unlink()
    if callable(content):
        content(path, door)
    else:
        path.write_bytes(content)


def faults_of(door, wanted, good_status, end):
    """What is wrong with an end."""
    status, out, err, seconds = end
    faults = []
    allowed = {good_status} if wanted == AS_GOOD else {wanted, 1} if door.command[0] == "check" else {wanted}
    if status not in allowed:
        faults.append(f"status {status}, not {min(allowed)}")
    if seconds >= MOST_SECONDS:
        faults.append(f"{seconds:.2f} s of processor time")
    if status == REFUSED and os.path.basename(door.file) not in err.decode(errors="replace"):
        folder = os.path.dirname(door.file)
        if not folder or folder not in err.decode(errors="replace"):
            faults.append("standard error does not name the file")
    if len(err.splitlines()) > MOST_LINES:
        faults.append(f"{len(err.splitlines())} lines on standard error")
    for line in (out + err).split(b"\n"):
        if len(line) > LONGEST_LINE:
            faults.append(f"a line of {len(line)} bytes")
        try:
            if any(unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp") for character in line.decode()):
                faults.append("a control character")
        except UnicodeDecodeError:
            faults.append("a line that is not UTF-8")
    return sorted(set(faults))


def main():
    """Runs all cases. @returns 0 if every one ended as it must"""
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    failed, done, table = 0, 0, collections.defaultdict(dict)
    costliest, longest = 0.0, 0
    with tempfile.TemporaryDirectory() as temporary:
        good = pathlib.Path(temporary) / "good"
        good.mkdir()
        make_good(program, good)

        def attempt(number, door, kind, content):
            folder = pathlib.Path(temporary) / f"case{number}"
            shutil.copytree(good, folder)
            arguments = list(door.command)
            if door.content == "set" and kind:
                arguments = [os.fsencode(a) for a in arguments] + [b"--set", door.file.encode() + b"=" + content]
            elif kind:
                damage(folder / door.file, door, content)
            end = run(program, folder, arguments)
            shutil.rmtree(folder)
            return end

        cases = []
        for each in DOORS:
            if options.only not in each.name:
                continue
            text = b"" if each.content == "set" else json.dumps(STUDY).encode() if each.content == "store" else \
                (good / each.file).read_bytes()
            cases.append((each, "", None, AS_GOOD))
            for kind, (content, wanted) in KINDS[each.content](text, each).items():
                cases.append((each, kind, content, wanted))
            if each.content in ("json", "csv", "angles"):
                cases += [(each, "directory", directory, REFUSED), (each, "FIFO", fifo, REFUSED)]
            if each.content == "json":
                cases.append((each, "too large", too_large, REFUSED))
        if options.short:
            cases = [case for case in cases if case[1] in SHORT or not case[1]]
        good_statuses = {}
        with concurrent.futures.ThreadPoolExecutor(2) as workers:
            ends = workers.map(lambda numbered: attempt(numbered[0], *numbered[1][:3]), enumerate(cases))
            for (each, kind, _, wanted), end in zip(cases, ends):
                if not kind:
                    good_statuses[each.name] = end[0]
                faults = faults_of(each, wanted, good_statuses[each.name], end)
                if not kind and end[0] not in (0, 1) and each.name[:10] != "study.json":
                    faults.append("the undamaged file is refused")
                done += 1
                costliest = max(costliest, end[3])
                longest = max([longest] + [len(line) for line in (end[1] + end[2]).split(b"\n")])
                table[kind or "none"][each.name] = end[0]
                if faults:
                    failed += 1
                    print(f"FAULT: {each.name}, {kind or 'undamaged'}: {', '.join(faults)}\n"
                          f"  {end[2][:300].decode(errors='replace')!r}")
                elif options.verbose:
                    print(f"{each.name}, {kind or 'undamaged'}: {end[0]} {end[3]:.2f} s {end[2][:200].decode()!r}")
    if options.table:
        names = [each.name for each in DOORS]
        print("\n".join(f"{i + 1:2} {name}" for i, name in enumerate(names)))
        print(f"{'':36}" + "".join(f"{i + 1:3}" for i in range(len(names))))
        for kind, statuses in table.items():
            print(f"{kind:36}" + "".join(f"{statuses.get(name, ''):>3}" for name in names))
    print(f"{done} cases, {failed} failed; the costliest took {costliest:.2f} s, the longest line has {longest} bytes")
    return 1 if failed or done == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
