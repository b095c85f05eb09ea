#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the manuals: the code blocks of every *.md file of the repository, in a fresh copy of its tracked files for each manual.

  sh       must end with status 0, or with that of a mark
  text     shows lines of the output of the last block that was run, in their order
  json     a complete scenario, checked by `earthtop check`, or a study, checked by `earthtop study --dry-run`
  cpp      a complete program: is compiled against the built library, and run
  cmake    a complete CMakeLists.txt: is configured; a source that is not there yet is the C++ program before it
  python   a program, or a session with prompts, whose output is compared; with --python DIR only
A block of another language, or of none, must be marked: manual.py says how. Tables that the program makes must be what it prints
now, and links must lead somewhere. At the end stands what was run and checked, and what was not, for which reason.
"""
import argparse
import concurrent.futures
import os
import resource
import shutil
import subprocess
import sys
import tempfile

from runner import Library, Runner

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def tracked_files(root):
    """Files that git knows, or all but what was built where there is no git."""
    done = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, text=True, check=False)
    if done.returncode == 0 and done.stdout:
        return [file for file in done.stdout.split("\0") if file and os.path.lexists(os.path.join(root, file))]
    found = []
    for folder, folders, files in os.walk(root):
        folders[:] = [one for one in folders if one not in (".git", "build", "out", "__pycache__")]
        found += [os.path.relpath(os.path.join(folder, file), root) for file in files]
    return sorted(found)


def arguments(given):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the path of earthtop, in the build directory")
    parser.add_argument("manuals", nargs="*", help="paths in the repository; all if there are none")
    parser.add_argument("--root", default=ROOT, help="the repository")
    parser.add_argument("--build", help="the build directory of the library; otherwise that of the program")
    parser.add_argument("--prefix", help="where the library is installed, instead of a build directory")
    parser.add_argument("--python", metavar="DIR", help="where the Python package is: Python blocks are run")
    parser.add_argument("--with-python", action="store_true", help="only manuals that have Python blocks to run")
    parser.add_argument("--write", action="store_true", help="rewrite the tables that commands make")
    parser.add_argument("--list", action="store_true", help="run nothing; print what is run, what is checked, and what is not")
    parser.add_argument("--jobs", type=int, default=1, help="manuals at the same time")
    parser.add_argument("--timeout", type=float, default=120, help="seconds for a block")
    options = parser.parse_intermixed_args(given)
    options.root, options.program = os.path.abspath(options.root), os.path.abspath(options.program)
    if options.python:
        options.python = os.path.abspath(options.python)
    build = os.path.dirname(os.path.dirname(os.path.dirname(options.program)))
    if not options.build and os.path.exists(os.path.join(build, "CMakeCache.txt")):
        options.build = build
    return options


def main(given=None):
    """Gives the exit status."""
    options = arguments(given)
    files = tracked_files(options.root)
    manuals = options.manuals or [file for file in files if file.endswith(".md")]
    if unknown := [path for path in manuals if path not in files]:
        sys.exit(f"no file of the repository: {', '.join(unknown)}")

    with tempfile.TemporaryDirectory() as options.scratch:
        library = Library(options.build, options.prefix, options.scratch)

        def run(path):
            copy = tempfile.mkdtemp(dir=options.scratch)
            runner = Runner(path, copy, options, library)
            if options.with_python and not any(part.language == "python" and part.reason is None for part in runner.parts):
                return None
            if options.list:
                runner.count_only()
                return runner
            for file in files:
                os.makedirs(os.path.dirname(os.path.join(copy, file)), exist_ok=True)
                shutil.copy2(os.path.join(options.root, file), os.path.join(copy, file), follow_symlinks=False)
            runner.run()
            shutil.rmtree(copy, ignore_errors=True)
            return runner

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            runners = [runner for runner in pool.map(run, manuals) if runner]
    for runner in runners:
        runner.write_tables()
        runner.report()
    for runner in runners:
        runner.summary()
    faults = sum(len(runner.faults) for runner in runners)
    if not options.list:
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(f"{len(runners)} manuals, {faults} faults, {used.ru_utime + used.ru_stime:.0f} s of processor time")
    return 1 if not runners or (faults and not options.list) else 0


if __name__ == "__main__":
    sys.exit(main())
