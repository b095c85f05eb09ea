# SPDX-License-Identifier: GPL-3.0-or-later
"""Planning of measurements."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Mapping, Optional, Sequence, Tuple, Union

from . import _core
from ._documents import Document, correlation_of, errors_named, exact_of, findings_of, label, names_of, number, parts_of, table
from ._errors import refuse
from ._measure import Names, measured, times
from ._progress import Progress, Reporter
from ._scenario import ScenarioLike, as_scenario, pointer_of

if TYPE_CHECKING:
    import pandas


class Plan(Document):
    """What a planned measurement would tell of a scenario's numbers. The standard errors are the Cramer-Rao bound."""

    @property
    def outcome(self) -> str:
        """``"determined"``, or why the measurement would not tell the numbers; ``reason`` says more."""
        return self.document["outcome"]

    @property
    def reason(self) -> str:
        """Why the numbers are not determined, or not predicted; empty if they are."""
        return self.document["reason"]

    @property
    def estimates(self) -> "pandas.DataFrame":
        """One row for each number that is fitted, by its name: its unit, the scenario's value, whether it is fitted along only
        (``nuisance``), the standard error known beforehand (``prior``) and the one to be expected, the value in standard errors
        (``significance``), the standard error if all other numbers were known exactly, and of a rate of the Earth whether it
        would be ``"seen"`` (``finding``)."""
        return table(findings_of(self.document), ["name", "unit", "nuisance", "finding"],
                     ["value", "prior", "standard_error", "significance", "standard_error_alone"], index="name",
                     order=["name", "unit", "value", "nuisance", "prior", "standard_error", "significance",
                            "standard_error_alone", "finding"])

    @property
    def exact(self) -> "pandas.DataFrame":
        """The inputs of the scenario that are not fitted and shift what is wanted, those that shift it most first: if the true value
        of one is larger than the scenario's by d, the estimate is larger by ``shift * d``, and the residuals in standard errors
        have ``misfit * d`` more length; ``error_of_one_sigma`` shifts it by its standard error. ``stated`` is the
        standard error in the scenario's ``uncertainty``."""
        return exact_of(self.document)

    @property
    def correlation(self) -> "pandas.DataFrame":
        """Correlation matrix of the estimates' errors, of shape (estimates, estimates)."""
        return correlation_of(self.document)

    @property
    def variations(self) -> "pandas.DataFrame":
        """The standard error of the first estimate under changes of the plan: each unknown known exactly, other durations,
        numbers of rows and standard errors, by ``factor``."""
        return self._changes("variations")

    @property
    def changes(self) -> "pandas.DataFrame":
        """What could be changed, the most effective change first."""
        return self._changes("changes")

    def _changes(self, key: str) -> "pandas.DataFrame":
        return table(self.document[key], ["change", "input", "rows"], ["factor", "input_standard_error", "standard_error"],
                     order=["change", "factor", "input", "input_standard_error", "rows", "standard_error"])

    @property
    def releases(self) -> "pandas.DataFrame":
        """Of several releases: the standard error of the first estimate that each would give by itself; empty for one."""
        rows = [{"scenario": one["scenario"]["name"], **one} for one in self.document.get("releases", [])]
        return table(rows, ["scenario"], ["standard_error_alone"])

    @property
    def advice(self) -> str:
        """What to change first."""
        return self.document["advice"]

    @property
    def best(self) -> Dict[str, float]:
        """The best values of what ``optimise`` named, by their pointers: ``top.changed(plan.best)`` is the best design. Empty
        if nothing was to be optimised."""
        optimum = self.document["optimum"]
        return {one["pointer"]: one["best"] for one in optimum["choices"]} if optimum else {}

    def _headline(self) -> str:
        plan = self.document["plan"]
        what = ", ".join(f"{one['name']} to {one['standard_error']:g}" for one in plan["quantities"])
        return f"{self.document['scenario']['name']}: {what}, {plan['rows']} rows to {plan['until_s']:g} s: {self.outcome}"

    def _lines(self) -> Sequence[str]:
        lines = [self.reason] if self.reason else []
        for one in self.document["estimates"]:
            if one["standard_error"] is not None:
                line = f"{label(one)}: {one['value']:.7g} \u00b1 {one['standard_error']:.3g} {one['unit']}".rstrip()
                lines.append(line + ("; fitted along" if one["nuisance"] else f": {one['significance']:.3g} sigma"))
        lines += [f"best {pointer}: {value:.6g}" for pointer, value in self.best.items()]
        return [*lines, *([self.advice] if self.advice else []), *self.document["notes"]]


def plan(scenario: Union[ScenarioLike, Sequence[ScenarioLike]], measure: Mapping[str, float], *, every_s: float,
         until_s: Optional[float] = None, estimate: Names = (), nuisance: Names = (), shared: Names = (),
         optimise: Optional[Mapping[str, Tuple[float, float]]] = None, correlation_time_s: float = 0,
         changes: Optional[Mapping[str, Any]] = None, progress: Progress = None) -> Plan:
    """Tells how well a measurement would determine numbers of a scenario, before anything is built.

    Parameters
    ----------
    scenario : Scenario, dict, JSON text or path
        the top; its ``uncertainty`` says what is known beforehand. Or a list of these: several releases that are measured alike
        and evaluated by one fit
    measure : mapping
        standard error of each quantity, by its name with its unit: ``{"azimuth_deg": 0.01}``; any that
        ``earthtop.fit`` takes; an axis is ``axis_deg``
    every_s : float
        distance of the rows in time (s)
    until_s : float, optional
        time of the last row (s); default: the scenario's duration
    estimate : str or sequence of str
        the numbers that are wanted, named as for ``earthtop.fit``; default: the vertical part of the Earth's rate, of a
        gyrocompass the northward one
    nuisance : str or sequence of str
        numbers that are not known either and are fitted along
    shared : str or sequence of str
        of several releases: numbers with one value in all of them; those that are not ``nuisance`` are estimated
    optimise : mapping, optional
        numbers that may be chosen, by key, within limits: ``{"release/tilt_deg": (5, 60)}``; at most 4. They are chosen so that
        the first estimate's standard error is least.
    correlation_time_s : float
        errors of a quantity are correlated by exp(-dt / T) in time (s); 0: independent
    changes : mapping, optional
        other values of the scenario, by key
    progress : bool or callable, optional
        as of ``earthtop.run``

    Returns
    -------
    Plan
        ``estimates`` and ``variations`` are DataFrames, ``advice`` says what to change first, ``best`` has what was optimised

    Raises
    ------
    ScenarioError
        for a scenario, a name or a plan that is refused
    """
    several = scenario if isinstance(scenario, (list, tuple)) else [scenario]
    given = [parts_of(as_scenario(one).changed(changes)) for one in several]
    if len(given) != 1 and optimise:
        raise refuse("optimise is for one release; plan each by itself for it")
    with errors_named(), Reporter(progress) as reporter:
        document, svg = _core.plan(given, measured(measure), *times(every_s, until_s, correlation_time_s), names_of(estimate),
                                   names_of(nuisance), names_of(shared), [_limits(*one) for one in (optimise or {}).items()], reporter)
    return Plan(document, svg)


def _limits(key: str, given: Tuple[float, float]) -> str:
    """A number that may be chosen and its limits, as ``--optimise`` takes them."""
    pointer = pointer_of(key)
    try:
        low, high = given
    except (TypeError, ValueError):
        raise refuse(f"optimise gives its two limits, e.g. (5, 60), not {given!r}", pointer) from None
    return f"{pointer}={number(low, pointer)!r}:{number(high, pointer)!r}"
