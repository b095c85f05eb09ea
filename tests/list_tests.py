#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Registers every test of a GoogleTest program with CTest, each with the label of the source file that contains it.

list_tests.py list PROGRAM FOLDER OUTPUT SOURCE[=LABEL]...  writes OUTPUT, which CTest reads; the tests run in FOLDER
list_tests.py check CTEST BUILD PROGRAM...                  fails unless CTest has each test of the programs exactly once

GoogleTest reports the source file of every test. Labels are therefore given with the sources, in CMakeLists.txt, and there is
one list of all tests, so that no test is missed between two filters.
"""
import collections
import json
import os
import subprocess
import sys
import tempfile


def tests_of(program):
    """A list of (name for GoogleTest, name for people, name of the source file) of all tests of the program."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "tests.json")
        subprocess.run([program, "--gtest_list_tests", "--gtest_output=json:" + file], check=True, stdout=subprocess.DEVNULL)
        with open(file, "r", encoding="utf-8") as stream:
            suites = json.load(stream)["testsuites"]
    found = []
    for suite in suites:
        for test in suite["testsuite"]:
            name = shown = f"{suite['name']}.{test['name']}"
            before, _, last = name.rpartition("/")
            value = test.get("value_param", "0x")
            # The value of a numbered parameter says more than its number, unless it is bytes or addresses, new in every build.
            if last.isdigit() and "0x" not in value and "-byte object <" not in value:
                shown = f"{before}/{value}"
            found.append((name, shown, os.path.basename(test["file"])))
    times = collections.Counter(shown for _, shown, _ in found)
    return [(name, shown if times[shown] == 1 else name, source) for name, shown, source in found]


def quoted(text):
    """The text as an argument for CMake that is taken literally."""
    return f"[==[{text}]==]"


def write_list(program, folder, output, sources):
    """Writes the file that CTest reads. A test from a source that is not listed is an error: its label is unknown."""
    labels = dict(source.partition("=")[::2] for source in sources)
    lines = []
    for name, shown, source in tests_of(program):
        if source not in labels:
            sys.exit(f"{program}: {name} is written in {source}, which is none of its sources")
        lines.append(f"add_test({quoted(shown)} {quoted(program)} {quoted('--gtest_filter=' + name)}"
                     " --gtest_also_run_disabled_tests)\n")
        lines.append(f"set_tests_properties({quoted(shown)} PROPERTIES WORKING_DIRECTORY {quoted(folder)}"
                     f" SKIP_REGULAR_EXPRESSION {quoted(r'[[]  SKIPPED []]')} LABELS {quoted(labels[source].replace(',', ';'))})\n")
    with open(output, "w", encoding="utf-8") as stream:
        stream.writelines(lines)


def check(ctest, build, programs):
    """Whether CTest has every test of the programs exactly once; prints those that are missing or repeated."""
    listing = subprocess.run([ctest, "--test-dir", build, "--show-only=json-v1"], check=True, stdout=subprocess.PIPE)
    tests = json.loads(listing.stdout)["tests"]
    names = collections.Counter(test["name"] for test in tests)
    commands = collections.Counter(tuple(test["command"][:2]) for test in tests if "command" in test)
    faults = [f"{times} tests are called {name}" for name, times in names.items() if times > 1]
    faults += [f"{test['name']} has nothing to run" for test in tests if "command" not in test]
    number = 0
    for program in programs:
        for name, _, _ in tests_of(program):
            number += 1
            times = commands[(program, "--gtest_filter=" + name)]
            if times != 1:
                faults.append(f"{name} of {program} is {times} tests of CTest's")
    print(f"{len(programs)} programs with {number} tests; CTest has {len(tests)}, these among them")
    for fault in faults:
        print(fault)
    return 1 if faults or not number else 0


def main():
    if len(sys.argv) > 4 and sys.argv[1] == "list":
        write_list(sys.argv[2], sys.argv[3], sys.argv[4], sys.argv[5:])
        return 0
    if len(sys.argv) > 3 and sys.argv[1] == "check":
        return check(sys.argv[2], sys.argv[3], sys.argv[4:])
    sys.exit(__doc__)


if __name__ == "__main__":
    sys.exit(main())
