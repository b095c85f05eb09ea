# SPDX-License-Identifier: GPL-3.0-or-later
"""earthtop: spinning tops and gyroscopes in a laboratory that turns with the Earth.

>>> import earthtop as et
>>> top = et.example("toy-top")
>>> r = et.run(top, duration_s=10)
>>> print(f"{r.drift.axis_final_rad:.3e} rad, {r.verdict}")
1.867e-04 rad, reliable

Angles are in rad and quantities in SI units unless a name ends in another unit. Frames: L is the laboratory (East,
North, Up), B the body, N the inertial axes that coincide with L at the release. Quaternions are (w, x, y, z).
"""

from . import closed_form
from ._core import version as __version__
from ._errors import ArithmeticError, Error, FileError, Finding, MissingFileError, ScenarioError, UnverifiedWarning
from ._arrays import Arrays
from ._compare import Comparison, compare
from ._documents import Document
from ._explain import Explanation, explain
from ._measure import Fit, ReleasesFit, fit, fit_releases, simulate_measurement
from ._plan import Plan, plan
from ._report import report
from ._result import Drift, Result, load_result
from ._run import run
from ._scenario import Check, Scenario, check, example, examples, load
from ._study import load_study, study
from ._table import table

__all__ = [
    "ArithmeticError",
    "Arrays",
    "Check",
    "Comparison",
    "Document",
    "Drift",
    "Error",
    "Explanation",
    "FileError",
    "Finding",
    "Fit",
    "MissingFileError",
    "Plan",
    "ReleasesFit",
    "Result",
    "Scenario",
    "ScenarioError",
    "UnverifiedWarning",
    "check",
    "closed_form",
    "compare",
    "example",
    "examples",
    "explain",
    "fit",
    "fit_releases",
    "load",
    "load_result",
    "load_study",
    "plan",
    "report",
    "run",
    "simulate_measurement",
    "study",
    "table",
]
