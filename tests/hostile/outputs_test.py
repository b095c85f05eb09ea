#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts something in the way of every output of every verb, and checks what becomes of it.

usage: outputs_test.py PROGRAM [--seed N] [--jobs N] [--only TEXT]

A kind is a state of an output's place. Without --force, what earthtop did not write as it is there is refused with status 2, before
any work; what it wrote is replaced; --force overwrites files, but no input, directory or link. A command with several outputs that
is refused writes none of them. No temporary file is left.
"""
import os
import pathlib
import shutil
import tempfile

from attack import Attack

PLAN = "plan top.json --measure tilt_deg --sigma 0.01 --every 0.1 --quiet"
# What is said of a place, by its state.
SAYS = {"directory": "is a directory; give the name of a file", "socket": "is not a file; give the name of a file",
        "dangling link": "is a link that leads nowhere", "link to foreign": "is a link; give the name of the file that it leads to",
        "write-protected": "already exists and is write-protected; give another name, or --force to overwrite it",
        "FIFO without a reader": "has no reader; start the process that reads it first", "named twice": "name the same file; give two",
        "input": "one of the inputs; write to another place"}
MEASURED = "compare top.json data.csv --estimate spin_rad_s --quiet"
PAIR = "compare one two --quiet"
# An output: its name in the matrix, the command, the option that names the file, and another output of the same command. A fitted
# scenario is its reader's text, and is never replaced without --force.
OUTPUTS = [("plan --svg", PLAN, "--svg", "--write-data"), ("plan --write-data", PLAN, "--write-data", "--svg"),
           ("compare --svg", PAIR, "--svg", "--junit"), ("compare --junit", PAIR, "--junit", "--svg"),
           ("measurement --svg", MEASURED, "--svg", "--write-scenario"),
           ("measurement --write-scenario", MEASURED, "--write-scenario", "--svg"), ("report --out", "report one --quiet", "--out", None)]
NEVER_OWN = {"measurement --write-scenario"}
STATES = ["absent", "foreign", "empty", "own", "own, edited", "own, rows appended", "directory", "dangling link", "link to foreign",
          "link to a directory", "write-protected", "input", "named twice", "socket", "FIFO without a reader", "device"]
REFUSED_ALWAYS = {"directory", "dangling link", "link to foreign", "link to a directory", "input", "named twice", "socket",
                  "FIFO without a reader"}


def prepare(attack, folder):
    """The files that the commands read."""
    def run(*arguments):
        end = attack.run(*arguments, cwd=folder)
        if end.status != 0:
            raise SystemExit(f"{arguments}: {end}")
        return end.out
    (folder / "top.json").write_text(run("example", "toy-top"))
    run("plan", "top.json", "--measure", "tilt_deg", "--sigma", "0.01", "--every", "0.5", "--write-data", "data.csv", "--quiet")
    for name in ("one", "two"):
        run("run", "top.json", "--out", name, "--quiet")


def in_the_way(attack, folder, state, output):
    """Puts something in the place of the output. @returns the place, and the files that must stay as they are"""
    name, command, option, _ = output
    place = folder / ("out.html" if option == "--out" else "out.json" if "scenario" in option else "out.svg")
    foreign = attack.random.randbytes(attack.random.choice([1, 100, 100_000])) + b"mine\n"
    if state == "foreign":
        place.write_bytes(foreign)
    elif state == "empty":
        place.touch()
    elif state.startswith("own"):
        end = attack.run(*command.split(), option, place, cwd=folder)
        if end.status not in (0, 1):
            raise SystemExit(f"{name}: {end}")
        text = place.read_bytes()
        if state == "own, edited":
            at = attack.random.randrange(len(text) // 4, len(text) * 3 // 4)
            place.write_bytes(text[:at] + b"9" + text[at:])
        elif state == "own, rows appended":
            place.write_bytes(text + b"100,20.5,0.01\n")
    elif state == "directory":
        place.mkdir()
    elif state == "dangling link":
        place.symlink_to(folder / "nowhere")
    elif state == "link to foreign":
        (folder / "theirs").write_bytes(foreign)
        place.symlink_to(folder / "theirs")
    elif state == "link to a directory":
        place.symlink_to(folder / "one")
    elif state == "write-protected":
        place.write_bytes(foreign)
        place.chmod(0o444)
    elif state == "input":
        place = folder / {"plan": "top.json", "comp": "one/summary.json", "meas": "data.csv", "repo": "one/summary.json"}[name[:4]]
    elif state == "socket":
        import socket
        with socket.socket(socket.AF_UNIX) as one:
            one.bind(os.path.relpath(place))
    elif state == "FIFO without a reader":
        os.mkfifo(place)
    elif state == "device":
        place = pathlib.Path("/dev/null")
    return place


def snapshot(folder):
    """What is in a folder: bytes of files, targets of links, kinds of the rest."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            found[name] = os.readlink(path)
        elif path.is_file():
            found[name] = path.read_bytes()
        else:
            found[name] = path.stat().st_mode & 0o170000
    return found


def attempt(attack, case, folder):
    _, _, state, output, force = case
    shutil.copytree(attack.prepared, folder, dirs_exist_ok=True)
    folder = pathlib.Path(folder)
    name, command, option, other = output
    place = in_the_way(attack, folder, state, output)
    before = snapshot(folder)
    arguments = [*command.split(), option, place]
    if state == "named twice":
        if not other:
            return []
        arguments += [other, place]
    elif other and state != "absent":
        arguments += [other, "other"]  # which must not be written where this one is refused
    if force:
        arguments += ["--force"]
    end = attack.run(*arguments, cwd=folder, seconds=10)
    after = snapshot(folder)
    refused = state in REFUSED_ALWAYS or not force and (
        state in ("foreign", "empty", "own, edited", "own, rows appended", "write-protected") or
        state == "own" and name in NEVER_OWN)
    faults = []
    if refused:
        if end.status != 2:
            faults.append(f"status {end.status} instead of 2")
        elif str(place) not in end.err and state != "named twice":
            faults.append("does not name the file: " + end.err.strip())
        elif SAYS.get(state, "already exists, and is not as " if "foreign" in state else "") not in end.err:
            faults.append("says " + end.err.strip())
        if after != before:
            faults.append("changed " + ", ".join(sorted(key for key in {*before, *after} if before.get(key) != after.get(key))))
    else:
        if end.status not in (0, 1):
            faults.append(f"status {end.status}: {end.err.strip()}")
        changed = {key for key in {*before, *after} if before.get(key) != after.get(key)}
        if not changed <= {place.name, "other"}:
            faults.append("changed " + ", ".join(sorted(changed)))
        if state in ("foreign", "empty", "own, edited", "own, rows appended", "write-protected") and place.name not in changed:
            faults.append("was not overwritten")
    if any(".tmp" in key for key in after):
        faults.append("left a temporary file")
    return faults


def study_results(attack):
    """A study's results beside its store: each of them foreign, edited, or of another study."""
    def one(case, folder):
        _, _, file, state = case
        folder = pathlib.Path(folder)
        (folder / "top.json").write_text(attack.run("example", "toy-top").out)
        study = '{"base": "top.json", "axes": [{"pointer": "/site/latitude_deg", "values": [%d, 50]}]}'
        (folder / "study.json").write_text(study % 10)
        (folder / "other.json").write_text(study % 20)
        place = folder / "out" / file
        command = ["study", "study.json", "--out", "out", "--quiet"]
        if state == "foreign":
            place.parent.mkdir()
            place.write_text("mine\n")
        else:
            attack.run(*command, cwd=folder)
            if state == "edited":
                place.write_bytes(place.read_bytes() + b"0,1,2\n")
            elif state == "of another":
                (folder / "out/study.sqlite").unlink()
                command[1] = "other.json"
        before = place.read_bytes()
        end = attack.run(*command, cwd=folder)
        if state == "own":
            return [] if end.status == 0 else [f"status {end.status}: {end.err.strip()}"]
        faults = [] if end.status == 2 else [f"status {end.status} instead of 2"]
        if not place.exists() or place.read_bytes() != before:
            faults.append("was overwritten")
        forced = attack.run(*command, "--force", cwd=folder)
        if forced.status != 0 or place.exists() and place.read_bytes() == before:
            faults.append(f"was not overwritten by --force: {forced.err.strip()}")
        return faults

    files = ("study.csv", "study.json")
    attack.all([(f"study, {state}", f"{file}", file, state) for state in ("own", "foreign", "edited", "of another") for file in files] +
               [("study, foreign", "study.svg", "study.svg", "foreign")], one)


def main():
    attack = Attack(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        attack.prepared = pathlib.Path(folder)
        prepare(attack, attack.prepared)
        try_all(attack)
    attack.end()


def try_all(attack):
    cases = [(state, output[0] + (" --force" if force else ""), state, output, force)
             for state in STATES for output in OUTPUTS for force in (False, True)]
    attack.all(cases, lambda case, folder: attempt(attack, case, folder))
    study_results(attack)


main()
