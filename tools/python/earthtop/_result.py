# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of a run."""

from __future__ import annotations

import json
import os
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core, _look
from ._arrays import ROW_KINDS, TORQUE_KINDS, Arrays, Kind, Quantity, quantities_of, read_only
from ._documents import errors_named
from ._errors import refuse, warn
from ._html import html_of
from ._pickles import Pickled
from ._scenario import Scenario

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import scipy.spatial.transform

FILES = ("trajectory.csv", "torques.csv", "summary.json", "timing.json", "drift.svg")


class _Files:
    """A result as the files of its directory, each made when it is first asked for; None for a file that it does not have."""

    def __init__(self, make: Mapping[str, Callable[[], Optional[str]]]) -> None:
        self._make = make
        self._made: Dict[str, Optional[str]] = {}
        self._tables: Dict[str, Dict[str, List[str]]] = {}

    def __getitem__(self, name: str) -> Optional[str]:
        if name not in self._made:
            self._made[name] = self._make[name]()
        return self._made[name]

    def table(self, name: str) -> Dict[str, List[str]]:
        """The columns of a CSV file as text, by their names."""
        if name not in self._tables:
            lines = [line.rstrip("\r") for line in (self[name] or "").split("\n") if line.strip()]
            names = lines[0].split(",") if lines else []
            columns = list(zip(*(line.split(",") for line in lines[1:]))) or [()] * len(names)
            self._tables[name] = {column: list(values) for column, values in zip(names, columns)}
        return self._tables[name]


class Drift(Arrays):
    """The quantities of the rows whose names begin with ``drift_``, without that beginning, and beside them the numbers of
    ``summary["drift"]``: ``axis_rad`` is the angle between the two axes at each time, ``axis_final_rad`` its last value."""

    axis_rad: np.ndarray
    axis_bound_rad: np.ndarray
    azimuth_rad: np.ndarray
    tilt_rad: np.ndarray
    attitude_rad: np.ndarray
    attitude_bound_rad: np.ndarray
    spin_rad: np.ndarray
    reliable: np.ndarray
    tip_x_m: np.ndarray
    tip_y_m: np.ndarray
    tip_m: np.ndarray
    tip_bound_m: np.ndarray
    slip_m_s: np.ndarray
    spin_rate_rad_s: np.ndarray
    rotor_rate_rad_s: np.ndarray
    rotor_angle_rad: np.ndarray
    rotor_axis_rad: np.ndarray
    rotor_axis_bound_rad: np.ndarray
    rotor_rate_bound_rad_s: np.ndarray
    rotor_angle_bound_rad: np.ndarray
    outer_angle_rad: np.ndarray
    inner_angle_rad: np.ndarray
    outer_rate_rad_s: np.ndarray
    inner_rate_rad_s: np.ndarray
    outer_angle_bound_rad: np.ndarray
    inner_angle_bound_rad: np.ndarray

    def __init__(self, result: "Result") -> None:
        super().__init__(result._quantities, result._texts("trajectory.csv"), "drift_")
        self._numbers: Dict[str, Any] = result.summary["drift"]

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name not in self._by_name and name in self._numbers:
            return self._numbers[name]
        return super().__getattr__(name)

    def __dir__(self) -> List[str]:
        """What there is for this result; quantities of other tops are left out."""
        absent = {name for name in Drift.__annotations__ if name not in self._by_name}
        return sorted(({*super().__dir__()} - absent) | {*self._numbers})


class Result(Pickled):
    """What a run returns.

    The arrays of its rows are attributes (``r.t_s``, ``r.q_LB``), listed by ``print(r.rows)``; those of the drift are in
    ``r.drift``. They are read-only and, where the library holds the numbers as they are, no copies. Units end the names; L is
    the laboratory (East, North, Up), B the body; ``ref_`` marks the non-rotating prediction, or, where
    ``travel/reference`` is ``at_rest``, that of the laboratory that stays.

    A result can be pickled: it is stored as the files that the program would write, and reads back to the same bits. A pickle that is
    damaged is refused. A pickle is code: load none from strangers, who can send the files of ``save``.
    """

    t_s: np.ndarray
    q_LB: np.ndarray
    w_LB_B_rad_s: np.ndarray
    ref_q_LB: np.ndarray
    ref_w_LB_B_rad_s: np.ndarray
    axis_L: np.ndarray
    ref_axis_L: np.ndarray
    tip_L_m: np.ndarray
    ref_tip_L_m: np.ndarray
    slip_m_s: np.ndarray
    ref_slip_m_s: np.ndarray
    normal_force_N: np.ndarray
    ref_normal_force_N: np.ndarray
    contact_state: np.ndarray
    rotor_rate_rad_s: np.ndarray
    rotor_angle_rad: np.ndarray
    rotor_axis_L: np.ndarray
    ref_rotor_rate_rad_s: np.ndarray
    ref_rotor_angle_rad: np.ndarray
    ref_rotor_axis_L: np.ndarray
    outer_angle_rad: np.ndarray
    inner_angle_rad: np.ndarray
    outer_rate_rad_s: np.ndarray
    inner_rate_rad_s: np.ndarray
    ref_outer_angle_rad: np.ndarray
    ref_inner_angle_rad: np.ndarray
    ref_outer_rate_rad_s: np.ndarray
    ref_inner_rate_rad_s: np.ndarray
    latitude_deg: np.ndarray
    longitude_deg: np.ndarray
    height_m: np.ndarray
    course_deg: np.ndarray
    speed_m_s: np.ndarray
    w_IL_L_rad_s: np.ndarray
    G_L_m_s2: np.ndarray

    def __init__(self, files: _Files, quantities: Sequence[Quantity], torques: Sequence[Quantity], *,
                 run: Optional["_core.RunResult"] = None, scenario: Optional[Scenario] = None) -> None:
        self._files = files
        self._quantities = quantities
        self._torque_quantities = torques
        self._run = run
        self._scenario = scenario
        self._summary: Optional[Dict[str, Any]] = None
        self._made: Dict[str, Arrays] = {}

    # Arrays -----------------------------------------------------------------------------------------------------------

    @property
    def rows(self) -> Arrays:
        """All quantities of the rows, by the names that they have in trajectory.csv."""
        return self._once("rows", lambda: Arrays(self._quantities, self._texts("trajectory.csv")))

    @property
    def drift(self) -> Drift:
        """The arrays and the numbers of the drift, without ``drift_`` before their names."""
        return self._once("drift", lambda: Drift(self))

    @property
    def torques(self) -> Arrays:
        """The torques (N m) that the ledger's observer counts, as in torques.csv; empty without ``numerics.ledger``."""
        return self._once("torques", lambda: Arrays(self._torque_quantities, self._texts("torques.csv")))

    def _once(self, name: str, make: Callable[[], Any]) -> Any:
        if name not in self._made:
            self._made[name] = make()
        return self._made[name]

    def _texts(self, file: str) -> Optional[Callable[[Quantity], np.ndarray]]:
        """In extended precision the function that gives the numbers of a quantity as the file has them."""
        if self.summary["solution"]["precision"] == "double":
            return None

        def texts(one: Quantity) -> np.ndarray:
            columns = np.array([self._files.table(file)[column] for column in one.columns], dtype=str)
            return read_only(columns.T.copy() if one.array.ndim == 2 else columns[0])

        return texts

    def __getattr__(self, name: str) -> Any:
        if name in Result.__annotations__:
            raise AttributeError(f"this result has no {name!r}, which only other tops have: on a table, with a rotor or in gimbals")
        raise AttributeError(f"a result has no {name!r}; print(result.rows) lists the quantities of its rows")

    def __dir__(self) -> List[str]:
        """What there is for this result; quantities of other tops are left out."""
        return sorted({*super().__dir__()} - {name for name in Result.__annotations__ if name not in self.rows})

    def __eq__(self, other: object) -> bool:
        """Whether they hold the same: rows, torques and summary, to the last digit. When and where they were computed is not asked."""
        if not isinstance(other, Result):
            return NotImplemented
        return self is other or (self.summary == other.summary and all(
            self._files[name] == other._files[name] for name in ("trajectory.csv", "torques.csv")))

    __hash__ = None  # type: ignore[assignment]

    # What it says -----------------------------------------------------------------------------------------------------

    @property
    def summary(self) -> Dict[str, Any]:
        """The content of summary.json, without the checksums of the files."""
        if self._summary is None:
            self._summary = json.loads(self._files["summary.json"] or "null")
        return self._summary

    @property
    def name(self) -> str:
        """The scenario's name."""
        return self.summary["name"]

    @property
    def status(self) -> str:
        """How the integration ended: ``"completed"``, or the name of what went wrong."""
        return self.summary["outcome"]["status"]

    @property
    def verdict(self) -> str:
        """What the drift is worth: ``"reliable"``, or a doubt whose reason is ``summary["drift"]["verdict_reason"]``.

        Whether a row is to be trusted is in ``drift.reliable``, and when none is and why in ``drift.verdict_intervals``."""
        return self.summary["drift"]["verdict"]

    @property
    def scenario(self) -> Scenario:
        """The scenario that was run; of a result from files, the copy that they have, with all defaults."""
        if self._scenario is None:
            self._scenario = Scenario(self.summary["scenario"])
        return self._scenario

    @property
    def timing(self) -> Dict[str, Any]:
        """The content of timing.json: wall time (s), date, host."""
        return json.loads(self._files["timing.json"] or "null")

    @property
    def svg(self) -> str:
        """The picture of the drift as SVG; of a result from files, as the file has it."""
        return self._files["drift.svg"] or ""

    # What can be done with it -----------------------------------------------------------------------------------------

    def to_pandas(self) -> "pandas.DataFrame":
        """A DataFrame with the columns of trajectory.csv, indexed by ``t_s`` (s)."""
        import pandas

        columns: Dict[str, np.ndarray] = {}
        for one in self._quantities:
            array = self.rows[one.name]
            for i, column in enumerate(one.columns):
                columns[column] = array if array.ndim == 1 else array[:, i]
        return pandas.DataFrame(columns).set_index("t_s")

    def rotation(self) -> "scipy.spatial.transform.Rotation":
        """The attitudes of the rows as one Rotation of SciPy, made of ``q_LB``.

        It maps vectors of the body B to the laboratory L: ``r.rotation().apply([0, 0, 1])`` is ``r.axis_L``. SciPy puts the scalar of
        a quaternion last, and holds doubles: extended precision is rounded.

        Raises
        ------
        ImportError
            if SciPy is not installed
        """
        try:
            from scipy.spatial.transform import Rotation
        except ImportError as error:
            raise ImportError("Result.rotation needs SciPy, which is not installed (pip install scipy; Debian: python3-scipy); "
                              "Result.q_LB has the quaternions (w, x, y, z) without it") from error
        return Rotation.from_quat(np.roll(np.asarray(self.q_LB, dtype=float), -1, axis=1))

    def plot(self, quantity: str = "drift_axis_rad", ax: Optional["matplotlib.axes.Axes"] = None,
             **options: Any) -> "matplotlib.axes.Axes":
        """Draws a quantity over time, and its error bound as a band where it has one.

        The motion of a run is drawn at times of the run's own, which resolve the fastest swings of the axis, whatever the output
        times are. Where it has thousands of swings, a band from the least to the largest value in each of many windows is drawn.
        A result that was read from files has only its rows to draw, and the title says so.

        Parameters
        ----------
        quantity : str
            a name of ``rows``
        ax : matplotlib.axes.Axes, optional
            where to draw; default: a new figure
        **options
            for ``ax.plot``

        Returns
        -------
        matplotlib.axes.Axes
        """
        if quantity not in self.rows:
            raise refuse(f"there is no quantity {quantity!r}; there are {', '.join(self.rows)}")
        if self.rows[quantity].dtype.kind == "U":
            raise refuse(f"{quantity!r} is a word and cannot be drawn")
        ax = _look.axes(ax)
        seen, window = self._seen()
        t_s, values = np.asarray(seen["t_s"], dtype=float), np.asarray(seen[quantity], dtype=float)
        components = next(kind.components for kind in ROW_KINDS if kind.name == quantity)
        stem, _, unit = quantity.rpartition("_")
        bound = f"{stem}_bound_{unit}"
        if window:
            # Between windows nothing is known: each is drawn by its least, its mean and its largest value.
            whole = len(t_s) // window * window
            t_s = t_s[:whole].reshape(-1, window).mean(axis=1)
            values = values[:whole].reshape((-1, window) + values.shape[1:])
            least, most, values = values.min(axis=1), values.max(axis=1), values.mean(axis=1)
        lines = ax.plot(t_s, values, **options)
        for line, letter in zip(lines, components):
            line.set_label(letter)
        if window:
            columns = [(least, most)] if least.ndim == 1 else list(zip(least.T, most.T))
            for line, (low, high) in zip(lines, columns):
                ax.fill_between(t_s, low, high, alpha=_look.BAND_OPACITY, color=line.get_color(), linewidth=0, label="least to most")
        elif bound in seen:
            error = np.asarray(seen[bound], dtype=float)
            ax.fill_between(t_s, values - error, values + error, alpha=_look.BAND_OPACITY, color=lines[0].get_color(), linewidth=0)
        if components or window:
            ax.legend()
        ax.set_xlabel("time (s)")
        ax.set_ylabel(quantity)
        ax.set_title(self.name if seen is not self.rows else f"{self.name}, at its output rows")
        return ax

    def _seen(self) -> Tuple[Mapping[str, np.ndarray], int]:
        """The quantities of the motion at times that resolve it, and how many of these are in a window (0: no windows); those of
        the rows where the motion itself is not at hand."""
        if self._run is None:
            return self.rows, 0
        looks = {name: array for name, array, *_ in self._run.look_arrays()}
        return (looks, self._run.looks_a_window) if len(looks["t_s"]) > 1 else (self.rows, 0)

    def save(self, directory: Union[str, os.PathLike], *, force: bool = False) -> Path:
        """Writes the files that ``earthtop run`` writes, which ``earthtop report`` and ``earthtop compare`` read.

        Parameters
        ----------
        directory : str or path
            is made if it does not exist
        force : bool
            overwrite the results of another scenario

        Returns
        -------
        Path
            the directory
        """
        place = Path(directory)
        with errors_named({"choose another out": "choose another directory"}):
            if self._run is not None:
                self._run.write(place, force)
                return place
            texts = {name: text for name, text in self.__getstate__().items() if text is not None}
            _core.write_result_texts(texts, self.scenario.scene(), place, force)
        return place

    def __getstate__(self) -> Dict[str, Optional[str]]:
        return {name: self._files[name] for name in FILES}

    def _restore(self, state: Dict[str, Optional[str]]) -> None:
        self.__dict__.update(_of_texts(state).__dict__)

    def __repr__(self) -> str:
        return f"<earthtop.Result {_headline(self)}>"

    def _repr_html_(self) -> str:
        return html_of(_headline(self), svg=self.svg)


def _headline(result: Result) -> str:
    """The drift in one line."""
    drift = result.summary["drift"]
    if len(result.t_s) < 2 or drift["axis_final_rad"] is None:
        return f"{result.name}: {result.status}, no drift"
    reliable = drift["reliable"]
    if not reliable["at_s"]:
        return f"{result.name}: {result.verdict}, no drift that can be trusted"
    later = "" if reliable["at_s"] == float(result.t_s[-1]) else "; later rows cannot be trusted"
    return (f"{result.name}: after {reliable['at_s']:g} s the axis has drifted by {reliable['axis_rad']:.6g} rad "
            f"(error bound {reliable['axis_bound_rad']:.1e} rad), {result.verdict}{later}")


def of_run(run: "_core.RunResult", scenario: Optional[Scenario] = None) -> Result:
    """The result of a run that has just been computed; its arrays refer to the memory of the run."""
    files = _Files({"trajectory.csv": run.trajectory_csv, "torques.csv": run.torques_csv, "summary.json": run.summary_json,
                    "timing.json": run.timing_json, "drift.svg": run.drift_svg})
    quantities, torques = ([Quantity(*one) for one in arrays] for arrays in (run.row_arrays(), run.torque_arrays()))
    return Result(files, quantities, torques, run=run, scenario=scenario)


def _of_texts(texts: Mapping[str, Optional[str]], scenario: Optional[Scenario] = None) -> Result:
    files = _Files({name: partial(texts.get, name) for name in FILES})
    return Result(files, quantities_of(files.table("trajectory.csv"), ROW_KINDS),
                  quantities_of(files.table("torques.csv"), TORQUE_KINDS), scenario=scenario)


def load_result(directory: Union[str, os.PathLike]) -> Result:
    """Reads the results that ``earthtop run`` or ``Result.save`` wrote to a directory.

    An ``UnverifiedWarning`` tells of files without checksums.

    Raises
    ------
    ScenarioError
        if it holds no results, or a file is not what was written, which its checksum tells
    FileError
        if a file or the directory is missing or cannot be read
    """
    texts, notes = _core.read_result_texts(os.fspath(directory))
    warn(notes)
    return _of_texts(texts)


def _array_property(kind: Kind, name: str, rows: Callable[[Any], Arrays]) -> property:
    def get(self: Any) -> np.ndarray:
        if name not in rows(self):
            raise AttributeError(name)  # then __getattr__ says why
        return rows(self)[name]

    return property(get, doc=kind.doc)


for _kind in ROW_KINDS:
    if _kind.name.startswith("drift_"):
        setattr(Drift, _kind.name[len("drift_"):], _array_property(_kind, _kind.name[len("drift_"):], lambda drift: drift))
    else:
        setattr(Result, _kind.name, _array_property(_kind, _kind.name, lambda result: result.rows))
del _kind
