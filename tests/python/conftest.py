# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python package share."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    """The earthtop program of the same build."""
    path = os.environ.get("EARTHTOP_PROGRAM", str(ROOT / "build/release/tools/earthtop/earthtop"))
    assert Path(path).is_file(), f"{path} was not built; EARTHTOP_PROGRAM names another"
    return path


@pytest.fixture(scope="session")
def scenarios():
    """The directory of the shipped scenarios."""
    return ROOT / "scenarios"


_PRELUDE = """
import signal, sys, time
import earthtop as et

def handler(number, frame):
    global told
    told = time.process_time()
    raise KeyboardInterrupt

signal.signal(signal.SIGINT, handler)
try:
    {work}
except KeyboardInterrupt:
    print("ended after", time.process_time() - told, flush=True)
"""
# Two threads may work for the 0.2 s within which Ctrl-C must answer.
_MOST_PROCESSOR_TIME_S = 2 * 0.2


@pytest.fixture
def interrupted():
    """A function that runs a line of Python, sends Ctrl-C once `is_under_way(process)`, and checks how soon the line ends."""

    def interrupt(work, is_under_way, *arguments):
        command = [sys.executable, "-c", _PRELUDE.replace("{work}", work), *map(str, arguments)]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        while not is_under_way(process):
            assert process.poll() is None, "it ended by itself"
        process.send_signal(signal.SIGINT)
        last = process.communicate(timeout=60)[0].splitlines()[-1]
        assert process.returncode == 0
        assert last.startswith("ended after")
        assert float(last.split()[2]) < _MOST_PROCESSOR_TIME_S

    return interrupt
