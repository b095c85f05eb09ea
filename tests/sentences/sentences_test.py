#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the cases of cases/*.py: each sentence is said where it is true, and not where it is not.

sentences_test.py PROGRAM [--jobs N] [--show] [ROOM...]     a room is a file in cases, without .py
"""
import argparse
import concurrent.futures
import glob
import importlib
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("rooms", nargs="*")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--show", action="store_true", help="print what each case prints")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    rooms = options.rooms or sorted(os.path.basename(file)[:-3] for file in glob.glob(os.path.join(HERE, "cases", "*.py")))
    cases = [(f"{room}[{at}]", case) for room in rooms for at, case in enumerate(importlib.import_module(f"cases.{room}").CASES)]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for (name, case), (faults, text) in zip(cases, pool.map(lambda one: one[1].faults(program), cases)):
            failed += bool(faults)
            if faults or options.show:
                print(f"{name}: {case.commands}\n  " + "\n  ".join([*faults, text]))
    print(f"{len(cases)} cases, {sum(len(case.expected()) for _, case in cases)} sentences, {failed} cases failed")
    return 1 if failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
