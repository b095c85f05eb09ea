# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C, threads, progress and memory."""

import os
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


def test_another_state_of_the_processor_does_not_change_digits():
    """A library compiled with -ffast-math flushes subnormal numbers to zero in the thread that loads it."""
    import ctypes

    libm = ctypes.CDLL("libm.so.6")
    expected = et.run(et.example("toy-top"), duration_s=1).q_LB
    libm.fesetround(0x800)  # upward, of x86
    try:
        found = et.run(et.example("toy-top"), duration_s=1).q_LB
    finally:
        libm.fesetround(0)
    assert np.array_equal(found, expected)


@pytest.mark.extra
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
