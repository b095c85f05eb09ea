# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C, threads, the processor's state, progress and memory."""

import ctypes
import os
import platform
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import earthtop as et

def processor_time_s(process):
    return float(Path(f"/proc/{process.pid}/stat").read_text().split()[13]) / os.sysconf("SC_CLK_TCK")


@pytest.mark.parametrize("jobs", [1, 2])
def test_ctrl_c_ends_a_run(jobs, interrupted):
    # Importing the package takes some 0.15 s.
    interrupted(f"et.run(et.example('toy-top'), duration_s=200000, output_step_s=1, jobs={jobs})",
                lambda process: processor_time_s(process) > 0.5)


def test_two_runs_at_once():
    tops = [et.example("toy-top").changed(duration_s=20, spin_rad_s=150 + i) for i in range(4)]
    results = [None] * 4

    def work(i):
        results[i] = et.run(tops[i])

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for top, result in zip(tops, results):
        assert np.array_equal(result.q_LB, et.run(top).q_LB)


def test_other_threads_go_on_meanwhile():
    counted, ended = [0], threading.Event()

    def count():
        while not ended.wait(0.001):
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    et.run(et.example("toy-top"), duration_s=600, jobs=1)
    during = counted[0] - before
    ended.set()
    thread.join()
    assert during >= 5


def test_progress_is_told_and_may_end_a_run():
    told = []
    et.run(et.example("toy-top"), duration_s=1500, output_step_s=1, progress=lambda share, phase: told.append((share, phase)))
    assert len(told) >= 1
    assert all(0 <= share <= 1 for share, _ in told) and [share for share, _ in told] == sorted(share for share, _ in told)

    class Enough(Exception):
        pass

    def enough(share, phase):
        raise Enough

    with pytest.raises(Enough):
        et.run(et.example("toy-top"), duration_s=200000, output_step_s=1, progress=enough)


STATES = {"rounding upward": (0x800, 0, 0x4000, 0), "53 bits of x87": (0x200, 0x300, 0, 0), "24 bits of x87": (0, 0x300, 0, 0),
          "flushing to zero": (0, 0, 0x8040, 0), "trapping": (0, 0xD, 0, 0xD << 7)}


class State:
    """Bits set and cleared in x87's control word, then in MXCSR."""

    def __init__(self, set_x87, clear_x87, set_mxcsr, clear_mxcsr):
        self.libm, self.before = ctypes.CDLL("libm.so.6"), ctypes.create_string_buffer(32)
        self.libm.fegetenv(self.before)
        x87, mxcsr = self.controls(self.before)
        self.mine = ctypes.create_string_buffer(self.before.raw, 32)
        ctypes.c_uint16.from_buffer(self.mine, 0).value = x87 & ~clear_x87 | set_x87
        ctypes.c_uint32.from_buffer(self.mine, 28).value = mxcsr & ~clear_mxcsr | set_mxcsr

    @staticmethod
    def controls(environment):
        return ctypes.c_uint16.from_buffer(environment, 0).value, ctypes.c_uint32.from_buffer(environment, 28).value & 0xFFC0

    def __enter__(self):
        self.libm.fesetenv(self.mine)

    def __exit__(self, *_):
        after = ctypes.create_string_buffer(32)
        self.libm.fegetenv(after)
        self.libm.fesetenv(self.before)
        assert self.controls(after) == self.controls(self.mine)  # the caller's setting is kept


@pytest.mark.skipif(platform.machine() != "x86_64" or platform.system() != "Linux", reason="sets x86's control words")
@pytest.mark.parametrize("state", STATES)
def test_another_state_of_the_processor_does_not_change_digits(state):
    """A library compiled with -ffast-math flushes subnormal numbers to zero in the thread that loads it."""
    top = et.example("toy-top").changed(duration_s=1, precision="long_double")

    def digits():
        scene, r = top.changed(duration_s=1.5).scene(), et.run(top)
        return r, r.svg, scene.canonical, scene.top, scene.estimated_seconds

    expected, *others = digits()
    with State(*STATES[state]):
        found, *found_others = digits()
    assert found.summary == expected.summary and np.array_equal(found.q_LB, expected.q_LB) and found_others == others


@pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer needs terabytes of addresses")
def test_too_little_memory_is_said_in_words():
    code = """
import resource
import earthtop as et
top = et.example("toy-top").changed(duration_s=100, output_step_s=1e-4)
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * 4096 + (40 << 20),) * 2)
try:
    et.run(top)
except MemoryError as error:
    print(error)
"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert said == "out of memory; ask for fewer rows, or end other programs\n"


@pytest.mark.long
@pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer keeps memory that was freed")
def test_memory_is_steady():
    def resident():
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    top = et.example("toy-top").changed(duration_s=0.1, output_step_s=0.01)

    def run(count):
        for i in range(count):
            r = et.run(top, spin_rad_s=150 + i % 7)
            r.q_LB, r.drift.axis_rad, r.summary, r.svg

    run(1000)
    before = resident()
    run(10000)
    assert resident() - before < 4e6  # less than half a kilobyte a run; a result that is kept has 10 kB
