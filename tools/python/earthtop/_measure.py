# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured motions: what they say of a scenario, and what planned ones would say."""

from __future__ import annotations

import csv
import io
import os
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core, _look
from ._documents import Document, Given, correlation_of, errors_named, exact_of, findings_of, label, names_of, number, parts_of, table
from ._errors import refuse
from ._progress import Progress, Reporter
from ._scenario import Scenario, ScenarioLike, as_scenario

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

    Data = Union[pandas.DataFrame, Mapping[str, Iterable], str, os.PathLike]

Names = Union[str, Sequence[str]]


class _Fitted(Document):
    """What a fit says, of one release or of several."""

    @property
    def agrees(self) -> bool:
        """Whether measurement and scenario agree, after the fit if there is one: the chance of such residuals is at least
        0.001, and the fit has converged."""
        return self.document["agrees"]

    @property
    def outcome(self) -> str:
        """``"converged"``, ``"not_asked"``, or why there is no fit, as ``"not_determined"``; ``reason`` says more."""
        return self.document["fit"]["outcome"]

    @property
    def reason(self) -> str:
        """Why there is no fit; empty if there is one or none was asked for."""
        return self.document["fit"]["reason"]

    @property
    def _chi_squared(self) -> Dict[str, Any]:
        both = self.document["chi_squared"]
        return both["fitted"] or both["as_given"]

    @property
    def chi_squared(self) -> float:
        """Sum of the squares of the residuals in standard errors: after the fit if there is one, else with the scenario's own
        numbers. ``document["chi_squared"]`` has both."""
        return self._chi_squared["value"]

    @property
    def degrees_of_freedom(self) -> int:
        """Number of values less the number of estimates."""
        return self._chi_squared["degrees_of_freedom"]

    @property
    def p_value(self) -> Optional[float]:
        """Chance of a larger ``chi_squared`` if scenario and standard errors are right."""
        return self._chi_squared["p_value"]

    @property
    def estimates(self) -> "pandas.DataFrame":
        """One row for each estimated number, by its name: its unit, the scenario's value (``start``), the estimate, its
        standard error from the stated errors, and that error scaled by the scatter of the residuals where this is larger. Of a
        rate of the Earth ``finding`` says whether it is ``"seen"``, ``"not_seen"``, or ``"contradicts"`` the known rate."""
        return table(findings_of(self.document), ["name", "unit", "finding"],
                     ["start", "estimate", "standard_error", "standard_error_scaled"], index="name",
                     order=["name", "unit", "start", "estimate", "standard_error", "standard_error_scaled", "finding"])

    @property
    def exact(self) -> "pandas.DataFrame":
        """The inputs of the scenario that were not fitted and shift an estimate, those that shift it most first: if the true value
        of one is larger than the scenario's by d, the estimate is larger by ``shift * d``, and the residuals in standard errors
        have ``misfit * d`` more length; ``error_of_one_sigma`` shifts the estimate by its standard error. ``stated`` is the
        standard error in the scenario's ``uncertainty``."""
        return exact_of(self.document)

    @property
    def correlation(self) -> "pandas.DataFrame":
        """Correlation matrix of the estimates' errors, of shape (estimates, estimates)."""
        return correlation_of(self.document)

    @property
    def hints(self) -> "pandas.DataFrame":
        """Of a fit whose residuals scatter by more than the stated errors: inputs that would mend it, one row for each, with its unit,
        the value that it would have, the standard error, and the chi-squared that would be left, to first order. Inputs that belong
        together have the same number ``hint``, 0 for the best."""
        rows = [{**one, "name": label(one), "hint": at, "chi_squared": hint["chi_squared"]}
                for at, hint in enumerate(self.document["hints"]) for one in hint["inputs"]]
        return table(rows, ["name", "unit"], ["hint", "value", "standard_error", "chi_squared"],
                     order=["hint", "name", "unit", "value", "standard_error", "chi_squared"])

    @property
    def quotation(self) -> str:
        """A paragraph for a paper: data, estimates with their errors, and what they rest on. Empty where the fit does not agree."""
        return self.document["quotation"] or ""

    @property
    def sentences(self) -> List[str]:
        """What the data say of each estimated number, in words."""
        return [one["sentence"] for one in self.document["estimates"] if one.get("sentence")]

    def _chance(self) -> str:
        chance = "" if self.p_value is None else f", chance {self.p_value:.3g}"
        return f"chi-squared {self.chi_squared:.6g} of {self.degrees_of_freedom} degrees of freedom{chance}"

    def _fit_lines(self) -> Sequence[str]:
        failed = [f"no fit: {self.outcome}: {self.reason}"] if self.outcome not in ("converged", "not_asked") else []
        return [*failed, *self.sentences, *self.document["notes"]]


class Fit(_Fitted):
    """What a measurement says of a scenario."""

    def __init__(self, texts: Tuple[str, str, str, Optional[str]], scenario: Given) -> None:
        super().__init__(texts[0], texts[1])
        self.histogram_svg = texts[2]  #: how often each size of a residual occurs, as SVG
        self._fitted = texts[3]
        self._file = scenario[0]

    @property
    def status(self) -> str:
        """How the prediction with the scenario's own numbers ended: ``"completed"``, or what went wrong."""
        return self.document["prediction"]["status"]

    @property
    def verdict(self) -> Optional[str]:
        """What a run up to the last row is worth, as of a result."""
        return self.document["prediction"]["verdict"]

    @property
    def residuals(self) -> "pandas.DataFrame":
        """One row for each measured number: time (s), quantity, line of the data, measured and predicted number, residual
        (measured less predicted) and standard error (rad; of rates rad/s, of lengths m, of times s), and the residual in standard errors."""
        return _residuals_of(self.document)

    def fitted_scenario(self) -> Scenario:
        """The scenario with the estimates put in; compared with the same data it gives the residuals of the fit, to the last
        bit. ScenarioError where there is no fit."""
        if self._fitted is None:
            raise refuse("there is no fit whose estimates could be put in" + (f": {self.reason}" if self.reason else ""))
        return Scenario(self._fitted, path=self._file or None)

    def plot(self, ax: Optional["matplotlib.axes.Axes"] = None, **options: Any) -> "matplotlib.axes.Axes":
        """Draws the residuals with their standard errors over time and returns the axes of matplotlib; ``svg`` shows the
        measured values and the model, too.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            where to draw; default: new axes
        **options
            go to ``ax.errorbar``
        """
        ax = _look.axes(ax)
        for quantity, rows in self.residuals.groupby("quantity", sort=False):
            style = {"fmt": ".", "label": quantity, **options}
            ax.errorbar(rows["t_s"], rows["residual_rad"], yerr=rows["standard_error_rad"], **style)
        ax.axhline(0, color=_look.MUTED, linewidth=0.8)
        ax.ticklabel_format(axis="y", scilimits=(-3, 3))
        ax.set_xlabel("time / s")
        ax.set_ylabel("measured less predicted / rad")
        ax.set_title(self.document["scenario"]["name"])
        ax.legend()
        return ax

    def _headline(self) -> str:
        found = "agrees with" if self.agrees else "does not agree with"
        return f"{self.document['file']} {found} {self.document['scenario']['name']}: {self._chance()}"

    def _lines(self) -> Sequence[str]:
        ended = [f"the prediction ended with {self.status}"] if self.status != "completed" else []
        return [*ended, *self._fit_lines()]


class ReleasesFit(_Fitted):
    """What several releases say of their scenarios by one fit. An estimate that is one release's own has a name as
    ``"spin_rad_s of release 2"``."""

    @property
    def residuals(self) -> "pandas.DataFrame":
        """The residuals of all releases, as those of a fit, with the number of the ``release``, counted from 1."""
        import pandas

        frames = [_residuals_of(one) for one in self.document["releases"]]
        return pandas.concat(frames, keys=range(1, len(frames) + 1), names=["release", None]).reset_index(level="release")

    def _headline(self) -> str:
        found = "agree" if self.agrees else "do not agree"
        return f"{len(self.document['releases'])} releases {found} with their scenarios: {self._chance()}"

    def _lines(self) -> Sequence[str]:
        numbered = list(enumerate(self.document["releases"], 1))
        ended = [f"the prediction of release {n} ended with {one['prediction']['status']}"
                 for n, one in numbered if one["prediction"]["status"] != "completed"]
        return [*ended, *self._fit_lines(), *(f"release {n}: {note}" for n, one in numbered for note in one["notes"])]


def _residuals_of(document: Mapping[str, Any]) -> "pandas.DataFrame":
    """The table of the residuals of one release."""
    numbers = ("measured", "predicted", "residual", "standard_error")
    rows = [{**one, **{f"{name}_rad": one[f"{name}_{unit}"] for name in numbers for unit in ("rad_s", "m", "s")
                       if f"{name}_{unit}" in one}} for one in document["residuals"]]
    frame = table(rows, ["quantity", "line"],
                  ["t_s", "measured_rad", "predicted_rad", "residual_rad", "standard_error_rad", "normalised"],
                  order=["t_s", "quantity", "line", "measured_rad", "predicted_rad", "residual_rad", "standard_error_rad",
                         "normalised"])
    if any("whitened" in one for one in document["residuals"]):
        frame["whitened"] = [one.get("whitened", np.nan) for one in document["residuals"]]
    return frame


def fit(scenario: ScenarioLike, data: "Data", estimate: Names = (), *, priors: bool = False, correlation_time_s: float = 0,
        free_start: bool = False, columns: Optional[Mapping[str, str]] = None, sigma: Optional[Mapping[str, float]] = None,
        time_offset_s: float = 0, changes: Optional[Mapping[str, Any]] = None, progress: Progress = None) -> Fit:
    """Compares a measured motion with a scenario, and fits numbers of the scenario to it by weighted least squares.

    Parameters
    ----------
    scenario : Scenario, dict, JSON text or path
        where the fit starts
    data : pandas.DataFrame, mapping of arrays, path of a CSV file, or CSV text
        columns, each with its unit in its name: ``t_s`` (since the release, ascending); ``azimuth_deg`` with its standard error
        ``azimuth_se_deg``, likewise any quantity that ``earthtop compare`` takes, as ``tilt_deg``, ``spin_rpm``,
        ``w_IB_B_x_rad_s``, ``swing_azimuth_deg``, ``azimuth_turning_deg`` or ``precession_period_s``; or the unit vector
        ``axis_L_x``, ``axis_L_y``, ``axis_L_z`` with ``axis_se_deg``. NaN is what was not measured; names that begin with ``_``
        are passed over, and other ones are named in a note.
    estimate : str or sequence of str
        numbers to be fitted: ``"omega_sin_latitude_rad_s"`` (the vertical part of the Earth's rate),
        ``"omega_cos_latitude_rad_s"``, ``"spin_rad_s"``, ``"tilt_deg"``, ``"latitude_deg"``, ``"gravity_m_s2"``,
        ``"inertia_ratio"``, ``"center_of_mass_m"``, or keys such as ``"release/azimuth_deg"``; at most 8. Without any the two
        are compared only.
    priors : bool
        what the scenario's ``uncertainty`` says of the estimated numbers enters the fit
    correlation_time_s : float
        errors of a quantity are correlated by exp(-dt / T) in time (s); 0: independent
    free_start : bool
        the data begin after the release: the motion starts at the first row, with estimated attitude and rates
    columns : mapping, optional
        what columns with other names are: ``{"Time (s)": "t_s", "phi": "azimuth_deg:mathematical"}``
    sigma : mapping, optional
        standard errors of all values of a quantity, in place of a column: ``{"azimuth_deg": 0.2}``
    time_offset_s : float
        what the clock of the data shows at the release (s); rows before it are left out
    changes : mapping, optional
        other values of the scenario, by key
    progress : bool or callable, optional
        as of ``earthtop.run``

    Returns
    -------
    Fit
        ``estimates`` and ``residuals`` are DataFrames, ``agrees`` tells whether data and scenario agree,
        ``fitted_scenario()`` has the estimates. A fit that does not converge is an ``outcome``, not an exception.

    Raises
    ------
    ScenarioError
        for a scenario, a name or data that are refused; findings about data have the line of the CSV text they make: row n of
        a DataFrame is line n + 2
    """
    time_s = _correlation_time_s(correlation_time_s)
    given = parts_of(as_scenario(scenario).changed(changes))
    with errors_named(), Reporter(progress) as reporter:
        read = _data_of(data, columns, sigma, time_offset_s)
        return Fit(_core.fit(given, read, names_of(estimate), priors, time_s, bool(free_start), reporter), given)


def fit_releases(releases: "Sequence[Tuple[ScenarioLike, Data]]", estimate: Names = (), *, shared: Names = (),
                 priors: bool = False, correlation_time_s: float = 0, columns: Optional[Mapping[str, str]] = None,
                 sigma: Optional[Mapping[str, float]] = None, time_offset_s: float = 0, progress: Progress = None) -> ReleasesFit:
    """Compares several releases with their scenarios, and fits numbers to all of them at once.

    Parameters
    ----------
    releases : sequence of (scenario, data)
        each as for ``earthtop.fit``
    estimate : str or sequence of str
        numbers of which each release has its own value
    shared : str or sequence of str
        numbers that are fitted, too, and have one value in all releases; all scenarios start them with the same value
    priors : bool
        what the scenarios' ``uncertainty`` says of the estimated numbers enters the fit; of a shared number it is one datum
    correlation_time_s : float
        errors of a quantity are correlated by exp(-dt / T) in time (s); 0: independent
    columns, sigma, time_offset_s
        as for ``earthtop.fit``, of all data
    progress : bool or callable, optional
        as of ``earthtop.run``

    Returns
    -------
    ReleasesFit

    Raises
    ------
    ScenarioError
        for a scenario, a name or data that are refused
    """
    time_s = _correlation_time_s(correlation_time_s)
    given = [(parts_of(as_scenario(scenario)), _data_of(data, columns, sigma, time_offset_s)) for scenario, data in releases]
    with errors_named(), Reporter(progress) as reporter:
        return ReleasesFit(_core.fit_releases(given, names_of(estimate), names_of(shared), priors, time_s, reporter))


def _correlation_time_s(given: float) -> float:
    time_s = number(given, "correlation_time_s")
    if not time_s >= 0:
        raise refuse("correlation_time_s must not be below 0 (s)")
    return time_s


def simulate_measurement(scenario: ScenarioLike, measure: Mapping[str, float], *, every_s: float,
                         until_s: Optional[float] = None, correlation_time_s: float = 0, seed: int = 1,
                         changes: Optional[Mapping[str, Any]] = None, progress: Progress = None) -> "pandas.DataFrame":
    """The motion of a scenario as a measurement would see it, with normal errors; ``earthtop.fit`` takes it.

    Parameters
    ----------
    scenario : Scenario, dict, JSON text or path
        what moves
    measure : mapping
        standard error of each quantity, by its name with its unit: ``{"azimuth_deg": 0.01, "tilt_deg": 0.01}``; any that
        ``earthtop.fit`` takes; an axis is ``axis_deg``
    every_s : float
        distance of the rows in time (s)
    until_s : float, optional
        time of the last row (s); default: the scenario's duration
    correlation_time_s : float
        errors of a quantity are correlated by exp(-dt / T) in time (s); 0: independent
    seed : int
        another seed gives other errors
    changes : mapping, optional
        other values of the scenario, by key
    progress : bool or callable, optional
        as of ``earthtop.run``

    Returns
    -------
    pandas.DataFrame
        ``t_s``, and each quantity with its standard error, as ``earthtop plan --write-data`` writes them
    """
    import pandas

    given = parts_of(as_scenario(scenario).changed(changes))
    with errors_named(), Reporter(progress) as reporter:
        when = times(every_s, until_s, correlation_time_s)
        text = _core.simulated_measurement(given, measured(measure), *when, seed, reporter)
    lines = text.splitlines()
    frame = pandas.read_csv(io.StringIO("\n".join(lines[1:])), float_precision="round_trip")
    frame = frame.astype({name: float for name in frame.columns if name != "extreme"})
    frame.attrs["origin"] = lines[0].lstrip("# ")
    return frame


def measured(measure: Mapping[str, float]) -> List[Tuple[str, float]]:
    """The measured quantities and their standard errors."""
    if not isinstance(measure, Mapping):
        raise refuse("measure gives each quantity its standard error, e.g. {'azimuth_deg': 0.01}")
    return [(name, number(error, f"the standard error of {name}")) for name, error in measure.items()]


def times(every_s: float, until_s: Optional[float], correlation_time_s: float) -> Tuple[float, Optional[float], float]:
    """The times of a plan (s)."""
    until = None if until_s is None else number(until_s, "until_s")
    return number(every_s, "every_s"), until, number(correlation_time_s, "correlation_time_s")


def _data_of(data: "Data", columns: Optional[Mapping[str, str]], sigma: Optional[Mapping[str, float]],
             time_offset_s: float) -> Tuple[str, Optional[str], List[str], List[str], float]:
    """Data with what is said of them."""
    for given, example in ((columns, "columns={'phi': 'azimuth_deg'}"), (sigma, "sigma={'azimuth_deg': 0.2}")):
        if given is not None and not isinstance(given, Mapping):
            raise refuse(f"name each by its column: {example}")
    renamed = [f"{name}={column}" for name, column in (columns or {}).items()]
    errors = [f"{name}={number(error, f'the standard error of {name}')!r}" for name, error in (sigma or {}).items()]
    return (*_text_of(data), renamed, errors, number(time_offset_s, "time_offset_s"))


def _text_of(data: "Data") -> Tuple[str, Optional[str]]:
    """What data are called, and their CSV text; without text the name is a file's."""
    if isinstance(data, str) and ("\n" in data or not data.strip()):
        return "<text>", data if data.endswith("\n") else data + "\n"
    if isinstance(data, (str, os.PathLike)):
        return os.fspath(data), None
    name = f"<{type(data).__name__}>"
    index = getattr(data, "index", None)
    if "t_s" in getattr(index, "names", ()):
        data = data.reset_index("t_s")  # type: ignore[union-attr]
    try:
        columns = {str(key): _cells_of(data[key]) for key in data.keys() if not str(key).startswith("_")}
    except AttributeError:
        raise TypeError(f"data are a DataFrame, a mapping of arrays, a path or CSV text, not {type(data).__name__}") from None
    lengths = {len(cells) for cells in columns.values()}
    if len(lengths) > 1:
        raise refuse(f"the columns of the data have different lengths: {', '.join(map(str, sorted(lengths)))}")
    lines = io.StringIO()
    writer = csv.writer(lines, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values()))
    return name, lines.getvalue()


def _cells_of(column: Any) -> List[str]:
    """The numbers of a column as text that reads back to the same bits; an empty cell where there is none."""
    values = column.tolist() if hasattr(column, "tolist") else column
    return [repr(value) if isinstance(value, float) and value == value else _cell(value) for value in values]


def _cell(value: Any) -> str:
    if value is None or repr(value) in ("<NA>", "NaT") or value != value:
        return ""
    return repr(float(value)) if isinstance(value, (np.floating, float)) else str(value)
