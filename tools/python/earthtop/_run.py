# SPDX-License-Identifier: GPL-3.0-or-later
"""Running scenarios."""

from __future__ import annotations

import copy
import os
from typing import Any, Mapping, Optional

from . import _core
from ._progress import Progress, Reporter
from ._result import Result, of_run
from ._scenario import ScenarioLike, as_scenario


def run(scenario: ScenarioLike, changes: Optional[Mapping[str, Any]] = None, *, jobs: Optional[int] = None,
        progress: Progress = None, **more: Any) -> Result:
    """Predicts the motion of a top with and without the Earth's rotation, and its drift.

    Parameters
    ----------
    scenario : Scenario, dict, JSON text or path
        what to run
    changes : mapping, optional
        other values, by key: ``{"site/latitude_deg": 0}``
    jobs : int, optional
        threads: with two, error bounds are computed beside the solution; default: two if the machine has two cores. The
        result is the same.
    progress : bool or callable, optional
        None: shown after a second in a terminal or a notebook; a callable gets the share done (0 to 1) and the phase
    **more
        other values by the bare names of keys: ``duration_s=60, spin_rad_s=200``

    Returns
    -------
    Result
        rows as arrays, summary, verdict. Numerical trouble is its ``status``, not an exception.

    Raises
    ------
    ScenarioError
        if the scenario is refused; ``findings`` lists why
    KeyboardInterrupt
        Ctrl-C ends a run at once; nothing is kept
    """
    wanted = as_scenario(scenario)
    if changes or more:
        wanted = wanted.changed(changes, **more)
    if jobs is None:
        jobs = 2 if (os.cpu_count() or 1) > 1 else 1
    with Reporter(progress) as reporter:
        return of_run(_core.run(wanted.scene(), jobs, reporter), copy.copy(wanted))
