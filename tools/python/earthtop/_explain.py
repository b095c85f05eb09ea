# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect budget."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Mapping, Optional, Sequence

from . import _core
from ._documents import Document, table
from ._html import html_of
from ._progress import Progress, Reporter
from ._scenario import ScenarioLike, as_scenario

if TYPE_CHECKING:
    import pandas


class Explanation(Document):
    """The effect budget of a scenario: what acts on the top, how large it is, and how well the inputs must be known."""

    @property
    def is_contact(self) -> bool:
        """Whether the top stands on a table; its budget is one of forces."""
        return "forces" in self.document

    @property
    def effects(self) -> "pandas.DataFrame":
        """One row for each effect, by its name.

        Torques about the pivot at the release and at their largest (N m), how far the effect moves the axis in each prediction
        (rad), and how much of that is drift (rad), at its largest and at the end. NaN is what is not known, or does not apply.
        For a top on a table: one row for each force, with its size (N) and its torque about the centre of mass (N m).
        """
        if self.is_contact:
            return table(self.document["forces"], ["name", "modelled"],
                         ["force_release_N", "force_largest_N", "torque_release_N_m", "torque_largest_N_m"], index="name")
        words = ["name", "modelled", "size_assumed", "enters_difference", "reason"]
        numbers = ["torque_release_N_m", "torque_largest_N_m", "displacement_rad", "drift_rad", "drift_final_rad"]
        return table(self.document["effects"], words, numbers, index="name", order=[*words[:-1], *numbers, words[-1]])

    @property
    def inputs(self) -> "pandas.DataFrame":
        """One row for each input, by its name: its value, the displacement of the axis (rad) and the drift (rad) per unit of
        it, and the error of it that hides the Earth's effect, in its unit.

        For a top on a table: the change of axis (rad) and tip (m) by a step of the input, and the number of steps that hide
        the Earth's effect.
        """
        if self.is_contact:
            return table(self.document["inputs"], ["name", "step"],
                         ["axis_rad", "tip_m", "steps_that_hide_earth_axis", "steps_that_hide_earth_tip"], index="name")
        return table(self.document["inputs"], ["name"],
                     ["value", "displacement_per_unit_rad", "drift_per_unit_rad", "hides_earth"], index="name")

    @property
    def earth_drift_rad(self) -> Optional[float]:
        """Drift of the axis by the Earth's rotation at the end (rad), to first order."""
        return self.document["earth_drift_rad"]

    @property
    def method(self) -> str:
        """The method that a run takes; ``document["run"]`` has the reason and the cost."""
        return self.document["run"]["method"]

    @property
    def warnings(self) -> List[str]:
        """What looks inconsistent in the choice of effects."""
        return self.document.get("warnings", [])

    def _headline(self) -> str:
        drift = self.earth_drift_rad
        known = "drift not known" if drift is None else f"drift by the Earth's rotation about {drift:.3e} rad"
        return f"{self.document['name']}: {known} after {self.document['duration_s']:g} s; a run takes {self.method}"

    def _lines(self) -> Sequence[str]:
        def row(one: Mapping[str, Any], key: str) -> str:
            size = one[key]
            state = "modelled" if one["modelled"] else "left out"
            return f"{one['name']:<24}{state:<10}{'' if size is None else format(size, '.2e'):>10}"

        if self.is_contact:
            return [f"{'force':<34}{'largest/N':>10}", *(row(one, "force_largest_N") for one in self.document["forces"])]
        return [f"{'effect':<34}{'drift/rad':>10}", *(row(one, "drift_rad") for one in self.document["effects"]),
                *(f"warning: {one}" for one in self.warnings)]

    def _repr_html_(self) -> str:
        return html_of(self._headline(), table=self.effects.drop(columns="name").to_html(escape=True), after=self.warnings)


def explain(scenario: ScenarioLike, changes: Optional[Mapping[str, Any]] = None, *, progress: Progress = None,
            **more: Any) -> Explanation:
    """Tells of every effect how large it is, what drift it causes, and whether the scenario models it; nothing is run.

    Parameters
    ----------
    scenario : Scenario, dict, JSON text or path
        what to explain
    changes : mapping, optional
        other values, by key: ``{"site/latitude_deg": 0}``
    progress : bool or callable, optional
        as of ``earthtop.run``
    **more
        other values by the bare names of keys

    Returns
    -------
    Explanation
        ``effects`` and ``inputs`` are DataFrames, ``document`` is the document of ``earthtop explain --json``

    Raises
    ------
    ScenarioError
        if the scenario is refused
    """
    scene = as_scenario(scenario).changed(changes, **more).scene()
    with Reporter(progress) as reporter:
        return Explanation(_core.explain(scene, reporter))
