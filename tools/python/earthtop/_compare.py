# SPDX-License-Identifier: GPL-3.0-or-later
"""Comparison of results."""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, Mapping, Optional, Sequence, Union

from . import _core
from ._documents import Document, errors_named, plain_json, renamed, table
from ._errors import as_arguments, warn
from ._progress import Progress, Reporter
from ._result import Result
from ._scenario import pointer_of
from ._study import store_of

if TYPE_CHECKING:
    import pandas

    Comparable = Union[Result, str, os.PathLike, pandas.DataFrame]


class Comparison(Document):
    """What a comparison has found; it is true if nothing differs by more than its tolerance."""

    def __init__(self, text: str, svg: str, junit: str) -> None:
        super().__init__(text, svg)
        self.junit = junit  #: the verdicts as JUnit XML

    @property
    def verdict(self) -> str:
        """``"same"``, ``"differs"``, or ``"refused"`` where something could not be compared."""
        return self.document["verdict"]

    @property
    def passed(self) -> bool:
        """Whether all was compared and nothing differs by more than its tolerance."""
        return self.verdict == "same"

    def __bool__(self) -> bool:
        return self.passed

    @property
    def quantities(self) -> "pandas.DataFrame":
        """One row for each quantity of each pair of results.

        The largest difference and its tolerance are in the unit of the quantity, which its name ends with; ``share_used`` is
        the largest ratio of a difference to its tolerance, ``at_s`` the time of the largest difference (s).
        """
        words = ["pair", "name", "passed", "change", "tolerance_origin", "where", "first_violation", "reason", "compared",
                 "violations"]
        numbers = ["largest_difference", "tolerance", "share_used", "error_bounds_sum", "interpolation_error", "at_s",
                   "first_violation_s"]
        rows = [{**one, "pair": pair["name"] or ""} for pair in self.document["pairs"] for one in pair["quantities"]]
        return table(rows, words, numbers, order=[*words[:3], *numbers[:4], *words[3:8], *numbers[4:], *words[8:]])

    @property
    def left_out(self) -> Dict[str, str]:
        """The figures that runs of unlike lengths do not have in common, each with the reason.

        Where ``may_change`` allows another duration, two runs are compared up to the end of the shorter one
        (``document["pairs"][0]["common_end_s"]``).
        """
        return {one["name"]: one["why"] for pair in self.document["pairs"] for one in pair["left_out"]}

    def _headline(self) -> str:
        return f"{self.verdict}: {self.document['new']} against {self.document['reference']}"

    def _lines(self) -> Sequence[str]:
        lines = []
        for pair in self.document["pairs"]:
            name = f"{pair['name']}: " if pair["name"] else ""
            if pair["refusal"]:
                lines.append(f"{name}refused: {pair['refusal']}")
            lines += [f"{name}{one['kind']}: {one['text']}" for one in pair["findings"]]
            lines += [f"{name}{_sentence(one)}" for one in pair["quantities"] if not one["passed"]]
            lines += [f"{name}perhaps {hint}" for hint in pair["hints"]]
            if pair["common_end_s"] is not None:
                lines.append(f"{name}compared up to t = {_short(pair['common_end_s'])} s, the end of the shorter run")
        most = 20
        lines = [as_arguments(line) for line in lines]
        return lines if len(lines) <= most else [*lines[:most], f"and {len(lines) - most} more"]


def _sentence(quantity: Mapping[str, Any]) -> str:
    if quantity["reason"]:
        return f"{quantity['name']}: {quantity['reason']}"
    largest, tolerance = quantity["largest_difference"], quantity["tolerance"]
    place = f" at {quantity['where']}" if quantity["where"] else ""
    return f"{quantity['name']} differs by {_short(largest)}{place}; tolerance {_short(tolerance)}"


def _short(number: Optional[float]) -> str:
    return "?" if number is None else f"{number:.3g}"


class _Paths:
    """Paths for what is given as objects, below a temporary directory, and what they are called instead."""

    def __init__(self, directory: str) -> None:
        self._directory = Path(directory)
        self.names: Dict[str, str] = {}

    def of_results(self, given: "Comparable", role: str) -> str:
        if isinstance(given, Result):
            path = given.save(self._directory / role)
            return self._called(path, f"{given.summary['name']} ({role})")
        return store_of(given)

    def of_table(self, given: Union[None, Mapping, str, os.PathLike], role: str) -> str:
        if given is None:
            return ""
        if not isinstance(given, Mapping):
            return os.fspath(given)
        path = self._directory / f"{role}.json"
        path.write_text(plain_json(given, role), encoding="utf-8")
        return self._called(path, role)

    def _called(self, path: Path, name: str) -> str:
        self.names[str(path)] = name
        return str(path)


def compare(reference: "Comparable", new: "Comparable", *, profile: str = "",
            tolerances: Union[None, Mapping, str, os.PathLike] = None, mapping: Union[None, Mapping, str, os.PathLike] = None,
            may_change: Union[str, Sequence[str]] = (), may_lack_rows: bool = False, steps_ratio: Optional[float] = None,
            seconds_ratio: Optional[float] = None, progress: Progress = None) -> Comparison:
    """Tells of each quantity whether it moved by more than both error bounds and rounding explain.

    Parameters
    ----------
    reference, new : Result, path or DataFrame
        results; or the path of a directory of results or of several, of a study's store, or of a CSV file; or the DataFrame
        of a study that was given ``out``
    profile : str
        ``"regression"`` (default): both error bounds and rounding; ``"bitwise"``: not a bit; ``"physics"``: a thousandth of
        the Earth's effect
    tolerances : path or mapping, optional
        tolerances of single quantities, as ``earthtop schema --tolerances`` has them
    mapping : path or mapping, optional
        what the columns of another program's CSV file are, as ``earthtop schema --mapping`` has it
    may_change : str or sequence of str
        keys of the scenario in which the two may differ; ``"/"`` for all
    may_lack_rows : bool
        rows, points and results that only the reference has are no fault
    steps_ratio, seconds_ratio : float, optional
        largest allowed growth of steps and of wall time
    progress : bool or callable, optional
        as of ``earthtop.run``

    Returns
    -------
    Comparison
        ``passed``, ``quantities`` (a DataFrame), ``document``, ``svg``

    Raises
    ------
    ScenarioError
        for input that is empty, truncated or not what it should be
    """
    keys = [may_change] if isinstance(may_change, str) else may_change
    pointers = [key if key == "/" else pointer_of(key) for key in keys]
    with contextlib.ExitStack() as stack:
        paths = _Paths(stack.enter_context(tempfile.TemporaryDirectory(prefix="earthtop-")))
        stack.enter_context(errors_named(paths.names))
        reporter = stack.enter_context(Reporter(progress))
        texts = _core.compare(paths.of_results(reference, "reference"), paths.of_results(new, "new"), profile,
                              paths.of_table(tolerances, "tolerances"), paths.of_table(mapping, "mapping"), pointers,
                              may_lack_rows, steps_ratio, seconds_ratio, reporter)
    document, svg, junit, notes = texts
    warn(renamed(note, paths.names) for note in notes)
    in_markup = {path: escape(name) for path, name in paths.names.items()}
    document = _core.resealed(renamed(document, {path: json.dumps(name)[1:-1] for path, name in paths.names.items()}))
    return Comparison(document, renamed(svg, in_markup), renamed(junit, in_markup))
