#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts a special file in the place of every file that a verb reads, and lets reads of a store fail.

usage: special_files_test.py PROGRAM [--seed N] [--jobs N] [--only TEXT] [--shim LIBRARY]

Nothing is waited for: within two seconds the program ends with status 2 and names the file. The doors are those of doors_test.py
and those of a store. With --shim, the library of tests/faults, the calls with which `study --repair` reads an intact store fail one
by one: the status is 4 or, where the failure does no harm, 0, never is the store called damaged, and it keeps its rows.
"""
import os
import pathlib
import shutil
import socket
import tempfile

import doors_test
from attack import Attack

MOST_SECONDS = 2
STORE = [("show", "study show done"), ("export", "study export done"), ("merge", "study merge done --out all"),
         ("resume", "study study.json --out done --quiet"), ("repair", "study study.json --out done --repair --quiet"),
         ("compare", "compare done done"), ("report", "report done")]


def bound_socket(path):
    with socket.socket(socket.AF_UNIX) as one:
        one.bind(str(path))


SPECIAL = {"FIFO": os.mkfifo, "socket": bound_socket, "device": lambda path: os.symlink("/dev/zero", path),
           "terminal": lambda path: os.symlink("/dev/ptmx", path), "kernel's messages": lambda path: os.symlink("/proc/kmsg", path),
           "dangling link": lambda path: os.symlink("nowhere", path), "link to itself": lambda path: os.symlink(path.name, path),
           "directory": os.mkdir}
ABSENT = {"dangling link", "directory", "link to itself"}  # some doors may take these for a file that is not there


def attempt(attack, case, folder):
    kind, _, file, command = case
    shutil.copytree(attack.prepared, folder, dirs_exist_ok=True)
    place = pathlib.Path(folder) / file
    place.unlink(missing_ok=True)
    SPECIAL[kind](place)
    end = attack.run(*command.split(), cwd=folder, seconds=MOST_SECONDS)
    faults = []
    if end.status is None:
        faults.append("waited")
    elif end.status not in (2, 4):
        faults.append(f"status {end.status}")
    elif not end.err.strip():
        faults.append("says nothing")
    if (pathlib.Path(folder) / place.parent / "nowhere").exists():
        faults.append("wrote through the link")
    return faults


def fail_reads(attack, shim):
    """Each call of a kind fails once, and then all from it on."""
    kinds = [(kind, mode, number) for kind in ("read", "stat") for mode in ("once", "on") for number in range(1, 60)]
    attack.random.shuffle(kinds)

    def one(case, folder):
        _, _, kind, mode, number = case
        shutil.copytree(attack.prepared, folder, dirs_exist_ok=True)
        store = pathlib.Path(folder) / "done/study.sqlite"
        before = attack.run("study", "export", "done", cwd=folder).out
        environment = dict(os.environ, LD_PRELOAD=shim, EARTHTOP_FAULT=f"{kind}:{number}:{mode}")
        end = attack.run("study", "study.json", "--out", "done", "--repair", "--quiet", cwd=folder, env=environment)
        faults = [] if end.status in (0, 4) else [f"status {end.status}: {end.err.strip()}"]
        if "damaged" in end.err or "was repaired" in end.err:
            faults.append("calls the store damaged: " + end.err.strip())
        if not store.exists() or attack.run("study", "export", "done", cwd=folder).out != before:
            faults.append("lost rows")
        return faults

    attack.all([(f"a failing {kind}", f"{mode} {number}", kind, mode, number) for kind, mode, number in kinds[:80]], one)


def main():
    attack = Attack(__doc__, lambda parser: parser.add_argument("--shim", default=""))
    with tempfile.TemporaryDirectory() as folder:
        attack.prepared = pathlib.Path(folder)
        doors_test.make_good(attack.program, attack.prepared)
        doors = [(door.name, door.file, " ".join(door.command)) for door in doors_test.DOORS if door.content != "set"]
        doors += [(f"store, {name}", f"done/study.sqlite{suffix}", command) for name, command in STORE
                  for suffix in ("", "-journal", "-wal", ".lock")
                  if suffix != ".lock" or name in ("resume", "repair")]
        cases = [(kind, name + " " + file, file, command) for kind in SPECIAL for name, file, command in doors]
        attack.random.shuffle(cases)
        attack.all(cases, lambda case, place: attempt(attack, case, place))
        if attack.options.shim:
            fail_reads(attack, os.path.abspath(attack.options.shim))
    attack.end()


main()
