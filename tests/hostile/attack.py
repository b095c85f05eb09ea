# SPDX-License-Identifier: GPL-3.0-or-later
"""What attacks on the program have in common: options, the program under limits, and a matrix of what was tried and fell through."""
import argparse
import collections
import concurrent.futures
import os
import random
import subprocess
import sys
import tempfile

End = collections.namedtuple("End", "status out err")  # of a program; the status is negative where a signal ended it


class Attack:
    """An attack in progress. @param describe  a function that adds options of its own to the parser"""

    def __init__(self, text, describe=None):
        parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("program")
        parser.add_argument("--seed", type=int, default=1)
        parser.add_argument("--jobs", type=int, default=2)
        parser.add_argument("--only", default="", help="only kinds whose name contains this")
        if describe:
            describe(parser)
        self.options = parser.parse_args()
        self.program = os.path.abspath(self.options.program)
        self.random = random.Random(self.options.seed)
        self.tried = collections.Counter()
        self.fallen = collections.Counter()

    def run(self, *arguments, cwd=None, seconds=60, **more):
        """Runs the program. Where it takes longer than it may, the status is None."""
        try:
            end = subprocess.run([self.program, *map(str, arguments)], cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True,
                                 timeout=seconds, check=False, **more)
        except subprocess.TimeoutExpired as late:
            return End(None, (late.stdout or b"").decode(errors="replace"), (late.stderr or b"").decode(errors="replace"))
        return End(end.returncode, end.stdout.decode(errors="replace"), end.stderr.decode(errors="replace"))

    def note(self, kind, case, faults):
        """Counts a case, and shows what fell through."""
        self.tried[kind] += 1
        if faults:
            self.fallen[kind] += 1
            print(f"FELL THROUGH: {kind}, {case}: " + "; ".join(faults), flush=True)

    def all(self, cases, attempt):
        """Calls attempt(case, folder) for every case (kind, name, ...), each in a folder of its own; it returns faults."""
        cases = [case for case in cases if self.options.only in case[0]]

        def one(case):
            with tempfile.TemporaryDirectory() as folder:
                return attempt(case, folder)

        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as workers:
            for case, faults in zip(cases, workers.map(one, cases)):
                self.note(case[0], case[1], faults)

    def end(self):
        """Prints the matrix and leaves, with status 1 where anything fell through or nothing was tried."""
        width = max([len(kind) for kind in self.tried], default=4)
        print(f"{'kind':{width}}  tried  fell through   (seed {self.options.seed})")
        for kind, count in self.tried.items():
            print(f"{kind:{width}} {count:6} {self.fallen[kind]:13}")
        print(f"{'all':{width}} {self.tried.total():6} {self.fallen.total():13}")
        sys.exit(1 if self.fallen.total() or not self.tried else 0)
