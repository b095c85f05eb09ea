#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of a manual, one block after the other, in an empty directory.

manual_test.py PROGRAM MANUAL.md

Every ```sh block must end with status 0. Every line of the ```text block that follows it, but for lines that are "...", must be
a line of its output, in this order.
"""
import os
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def missing_line(shown, printed):
    """The first line that is shown and was not printed after the one before it; None if there is none."""
    rest = iter(line.rstrip() for line in printed.splitlines())
    for line in shown.splitlines():
        if line.strip() != "..." and line.strip() and line.rstrip() not in rest:
            return line
    return None


def main():
    program, manual = (os.path.abspath(path) for path in sys.argv[1:3])
    environment = dict(os.environ, PATH=os.path.dirname(program) + os.pathsep + os.environ["PATH"], NO_COLOR="1")
    with open(manual, encoding="utf-8") as stream:
        blocks = BLOCK.findall(stream.read())
    printed, commands, faults = "", 0, 0
    with tempfile.TemporaryDirectory() as directory:
        for kind, text in blocks:
            if kind == "sh":
                commands += 1
                done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=directory, env=environment,
                                      capture_output=True, text=True, check=False)
                printed = done.stdout
                if done.returncode != 0:
                    faults += 1
                    print(f"status {done.returncode}:\n{text}{done.stderr}")
            elif (line := missing_line(text, printed)) is not None:
                faults += 1
                print(f"not printed (any more):\n{line}\nbut:\n{printed}")
    if commands == 0:
        sys.exit(f"{manual} has no commands")
    sys.exit(1 if faults else 0)


main()
