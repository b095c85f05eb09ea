# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of long work: a line in a terminal, an output that is replaced in a notebook."""

from __future__ import annotations

import sys
import time
from typing import Callable, Optional, Union

Progress = Union[bool, None, Callable[[float, str], None]]


def _in_notebook() -> bool:
    get_ipython = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)
    return type(get_ipython()).__name__ == "ZMQInteractiveShell"


class Reporter:
    """Shows the progress from one second after the start on, and takes it away at the end.

    Parameters
    ----------
    wanted : bool, None or callable
        None: shown if standard error is a terminal, or in a notebook; a callable gets the share (0 to 1) and the phase instead
    """

    def __init__(self, wanted: Progress = None) -> None:
        self._given = wanted if callable(wanted) else None
        self._notebook = _in_notebook()
        terminal = bool(getattr(sys.stderr, "isatty", lambda: False)())
        self._shown = wanted is True or (wanted is None and (terminal or self._notebook))
        self._start = time.monotonic()
        self._handle = None
        self._width = 0

    def __enter__(self) -> Optional[Callable[[float, str], None]]:
        return self._given or (self.show if self._shown else None)

    def __exit__(self, *_: object) -> None:
        if self._handle is not None:
            from IPython.display import HTML

            self._handle.update(HTML(""))
        elif self._width:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()

    def show(self, share: float, phase: str) -> None:
        seconds = time.monotonic() - self._start
        if seconds < 1:
            return
        left = f", {seconds * (1 - share) / share:.0f} s left" if share > 0.01 else ""
        line = f"{100 * share:3.0f} % {phase}{left}"
        if self._notebook:
            from IPython.display import HTML, display

            bar = HTML(f"<progress value='{share:.3f}' max='1'></progress> {line}")
            if self._handle is None:
                self._handle = display(bar, display_id=True)
            else:
                self._handle.update(bar)
        else:
            sys.stderr.write("\r" + line.ljust(self._width))
            sys.stderr.flush()
            self._width = max(self._width, len(line))
