# SPDX-License-Identifier: GPL-3.0-or-later
"""Sends a signal to a program when it has used a given processor time, and measures what it uses afterwards.

Processor time is read from the kernel's clock of the process; a loaded machine makes a test slower, not stricter. Signals are
sent with os.kill: Popen's own way to send one may reap the process, whose use of the processor is then lost.
"""
import os
import signal
import subprocess
import time

LAST_S = 0.002  # of processor time, for what a program does after its last look at the signals
PATIENCE = 120  # s by the clock, for what takes a fraction of a second of processor time


def processor_time(pid):
    """Processor time (s) of all threads of the process, ended ones included; None if the process no longer exists."""
    try:
        return time.clock_gettime((~pid << 3) | 2)  # what clock_getcpuclockid(3) gives
    except OSError:
        return None


class Interrupted:
    """The outcome of a command that was sent a signal.

    at_s: processor time used before the signal; the total if the command had already ended
    after_s: processor time between the signal and the end; None if the command had already ended
    waited_s: the same by the clock
    """

    def __init__(self, command, number, at_s, cwd, second=False, stdin=None):
        self.out_name, self.err_name = os.path.join(cwd, ".out"), os.path.join(cwd, ".err")
        with open(self.out_name, "wb") as out, open(self.err_name, "wb") as err:
            with subprocess.Popen(command, cwd=cwd, stdin=stdin or subprocess.DEVNULL, stdout=out, stderr=err) as process:
                self._send(process, number, at_s, second)
        with open(self.out_name, "r", encoding="utf-8", errors="replace") as file:
            self.out = file.read()
        with open(self.err_name, "r", encoding="utf-8", errors="replace") as file:
            self.err = file.read()

    def _send(self, process, number, at_s, second):
        deadline = time.monotonic() + PATIENCE + 60 * at_s
        while True:
            used = processor_time(process.pid)
            status = os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG)
            if status is not None or used is None or used >= at_s:
                break
            if time.monotonic() > deadline:
                process.kill()
                raise RuntimeError(f"{process.args}: {used:.2f} s of processor time are all it used")
            time.sleep(min(0.01, max(0.0005, (at_s - used) / 2)))
        ended = status is not None or used is None
        sent = time.monotonic()
        if not ended:
            os.kill(process.pid, number)
            used = processor_time(process.pid) or used
            if second:
                time.sleep(0.02)  # two of a kind that wait together are one
                os.kill(process.pid, number)
        timeout = time.monotonic() + PATIENCE
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > timeout:
                process.kill()
                raise RuntimeError(f"{process.args}: still there {PATIENCE} s after {signal.Signals(number).name}")
            time.sleep(0.001)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.status = process.returncode
        # A command that was about to end when it was sent the signal ends as if there had been none.
        whole = usage.ru_utime + usage.ru_stime
        ended = ended or (self.status in (0, 1) and whole - used < LAST_S)
        self.at_s = whole if ended else used
        self.waited_s = time.monotonic() - sent
        self.after_s = None if ended else whole - used
