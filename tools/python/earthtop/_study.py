# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameter studies."""

from __future__ import annotations

import contextlib
import json
import os
import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._documents import errors_named, plain_json
from ._errors import refuse, warn
from ._progress import Progress, Reporter
from ._scenario import Scenario, ScenarioLike, as_scenario, pointer_of

if TYPE_CHECKING:
    import pandas

Axes = Mapping[Union[str, Tuple[str, ...]], Any]
Collect = Union[str, Sequence[str], Mapping[str, str]]


class StudyDocument(dict):
    """The content of study.json: statistics, means along the axes, fits, indices.

    pandas copies what a DataFrame has in ``attrs`` with every operation; this is shared instead.
    """

    def __copy__(self) -> "StudyDocument":
        return self

    def __deepcopy__(self, memory: dict) -> "StudyDocument":
        return self


def study(base: ScenarioLike, axes: Optional[Axes] = None, *, collect: Optional[Collect] = None,
          design: Union[None, str, Mapping[str, Any]] = None, points: Optional[int] = None, seed: Optional[int] = None,
          name: Optional[str] = None, out: Union[None, str, os.PathLike] = None, jobs: Optional[int] = None,
          force: bool = False, keep_going: bool = False, retry_failed: bool = False, repair: bool = False,
          progress: Progress = None, **more: Any) -> "pandas.DataFrame":
    """Runs a scenario at many points and returns a DataFrame with one row for each.

    >>> import earthtop as et
    >>> top = et.example("toy-top").changed(duration_s=1)
    >>> table = et.study(top, {"latitude_deg": [-45, 0, 45]}, collect=["drift.axis_final_rad"])
    >>> list(table.columns)
    ['point', 'latitude_deg', 'drift.axis_final_rad', 'status', 'reason']

    Parameters
    ----------
    base : Scenario, dict, JSON text or path
        the scenario that is varied. Without ``axes``: a study file's path, its text, or its content as a dictionary, the base
        of which may be a Scenario
    axes : mapping
        what is varied, by key: a list or an array of values, or a mapping with ``from``, ``to`` and ``points`` (equal steps),
        or one of a study file's axis, e.g. ``{"name": "rate", "log_range": {"from": 1, "to": 100, "points": 5}}``. In a drawn
        design a tuple ``(from, to)`` is the range that is drawn from. A tuple of keys is varied together, over values of shape
        (values, keys). Several axes make a grid; the first one is the slowest.
    collect : str, sequence of str or mapping, optional
        quantities of the summary, by their dotted paths; a mapping gives columns other names: ``{"drift":
        "drift.axis_final_rad"}``. Default: the drift of the axis, its bound, its parts and the verdict.
    design : str or mapping, optional
        ``"grid"`` (default), ``"random"``, ``"latin_hypercube"``, ``"sobol"`` or ``"one_at_a_time"``; or that part of a study
        file
    points, seed : int, optional
        of a drawn design
    name : str, optional
        of the study; default: the scenario's
    out : path, optional
        directory of the store and of study.csv, study.json and study.svg. An interrupted study goes on there when the same call
        is made again: nothing that has been computed is lost. Default: none, the DataFrame is all that is kept
    jobs : int, optional
        threads; default: one for each core. The results are the same.
    force : bool
        throw away a store of another study that is in ``out``
    keep_going : bool
        compute it even if all points that were tried beforehand are refused for one reason
    retry_failed : bool
        compute failed points of the store again
    repair : bool
        keep the intact points of a damaged store, and compute the others again
    progress : bool or callable, optional
        as of ``earthtop.run``
    **more
        other parts of a study file: ``title``, ``rows``, ``fits``, ``figures``, ``limits``

    Returns
    -------
    pandas.DataFrame
        the columns of study.csv: the number of the point, its axes, what was collected, status and reason. Numbers have all
        their digits; what a point does not have is NaN or None. A point that fails is a row with its ``status`` and ``reason``.
        ``attrs["study"]`` is the content of study.json: statistics, fits, indices; ``attrs["store"]`` the path of the store.

    Raises
    ------
    ScenarioError
        if the study is refused: ``findings`` lists why
    KeyboardInterrupt
        Ctrl-C ends a study at once; with ``out`` the points that are complete are kept
    """
    given: Dict[str, Any] = {"collect": collect, "design": design, "points": points, "seed": seed, "name": name, **more}
    if axes is None:
        file, text = _study_text(base, [key for key, value in given.items() if value is not None])
    else:
        scenario = as_scenario(base)
        file, text = scenario.path, _with_base(scenario, _document(scenario, axes, **given))
    workers = 0 if jobs is None else _at_least_one(jobs)
    with contextlib.ExitStack() as stack:
        stack.enter_context(errors_named())
        reporter = stack.enter_context(Reporter(progress))
        directory = os.fspath(out) if out is not None else stack.enter_context(_temporary_directory())
        store = _core.run_study(file, text, directory, workers, force, keep_going, retry_failed, repair, out is not None,
                                reporter)
        if out is None:
            return _frame(store, _core.study_json(store), None)
        return _frame(store, (Path(store).parent / "study.json").read_text(encoding="utf-8"), store)


def load_study(path: Union[str, os.PathLike]) -> "pandas.DataFrame":
    """Reads the points of a study that ``earthtop.study`` or ``earthtop study`` has computed, or has begun to compute.

    An ``UnverifiedWarning`` tells of a store without checksums.

    Parameters
    ----------
    path : str or path
        the study's directory, or its store, e.g. study.sqlite

    Returns
    -------
    pandas.DataFrame
        as of ``earthtop.study``; the points that have been computed so far

    Raises
    ------
    ScenarioError
        if points are not what was stored, which their checksums tell
    """
    given = os.fspath(path)
    with errors_named():
        note = _core.study_note(given)
        warn([note] if note else [])
        return _frame(given, _core.study_json(given), given)


def store_of(given: Any) -> str:
    """The path of a store, from the DataFrame of a study or as a path."""
    if hasattr(given, "attrs") and "study" in given.attrs:
        if not given.attrs.get("store"):
            raise refuse("the points of this study have not been kept; give it out=DIRECTORY")
        return given.attrs["store"]
    return os.fspath(given)


def _temporary_directory() -> "tempfile.TemporaryDirectory[str]":
    return tempfile.TemporaryDirectory(prefix="earthtop-study-")


def _at_least_one(jobs: int) -> int:
    if jobs < 1:
        raise refuse(f"jobs must be 1 or more, not {jobs}")
    return jobs


# The document of a study ----------------------------------------------------------------------------------------------------


def _document(base: Scenario, axes: Axes, *, design: Union[None, str, Mapping[str, Any]], points: Optional[int],
              seed: Optional[int], collect: Optional[Collect], name: Optional[str], **more: Any) -> Dict[str, Any]:
    """The study file that the arguments stand for, without its base."""
    if not isinstance(axes, Mapping):
        raise TypeError(f"axes are a mapping of keys and values, not {type(axes).__name__}")
    chosen: Dict[str, Any] = dict(design) if isinstance(design, Mapping) else {} if design is None else {"kind": design}
    chosen.update({key: value for key, value in (("points", points), ("seed", seed)) if value is not None})
    is_drawn = chosen.get("kind", "grid") not in ("grid", "one_at_a_time")
    document: Dict[str, Any] = {"name": name or _name_of(base), **more, "axes": [_axis(key, axes[key], is_drawn) for key in axes]}
    if chosen:
        document["design"] = chosen
    if isinstance(collect, Mapping):
        document["collect"] = [{"name": column, "path": path} for column, path in collect.items()]
    elif collect is not None:
        document["collect"] = [collect] if isinstance(collect, str) else list(collect)
    return document


def _name_of(base: Scenario) -> str:
    given = base.to_dict().get("name") or Path(base.path).stem
    return given if isinstance(given, str) and re.fullmatch("[a-z0-9][a-z0-9-]{0,63}", given) else "unnamed"


def _axis(key: Union[str, Tuple[str, ...]], given: Any, is_drawn: bool) -> Dict[str, Any]:
    keys = list(key) if isinstance(key, (tuple, list)) else [key]
    pointers = [pointer_of(one) for one in keys]
    axis: Dict[str, Any] = {"pointer": pointers[0]} if len(pointers) == 1 else {"pointers": pointers}
    if isinstance(given, Mapping):
        return {**axis, **(given if "from" not in given and "to" not in given else {"range": given})}
    if is_drawn and isinstance(given, tuple) and len(given) == 2:
        return {**axis, "range": {"from": given[0], "to": given[1]}}
    if isinstance(given, str) or not hasattr(given, "__iter__"):
        raise refuse(f"values must be a list, an array or a range, not {given!r}", pointers[0])
    return {**axis, "values": given.tolist() if hasattr(given, "tolist") else list(given)}


def _with_base(base: Scenario, document: Mapping[str, Any]) -> str:
    """The text of a study. The text of its base stays as it is; what was changed in it comes after it."""
    changes = {pointer: json.loads(value) for pointer, value in base._changes.items()}
    rest = {**document, "set": {**changes, **document.get("set", {})}}
    return '{"base": ' + base._text.lstrip("\ufeff") + ", " + plain_json(rest, "the study")[1:]


def _study_text(given: Any, more: List[str]) -> Tuple[str, str]:
    """File and text of a study that is given as a whole."""
    if more:
        raise refuse(f"{', '.join(more)}: belongs to a study that is given by its base and its axes")
    if isinstance(given, Scenario):
        raise refuse("a study of a scenario needs axes: what is varied, and its values")
    if isinstance(given, Mapping):
        base = given.get("base")
        if isinstance(base, Scenario):
            return base.path, _with_base(base, {key: value for key, value in given.items() if key != "base"})
        return "", plain_json(given, "the study")
    if isinstance(given, str) and given.lstrip("\ufeff \t\r\n").startswith("{"):
        return "", given
    if isinstance(given, (str, os.PathLike)):
        return _core.read_scenario(os.fspath(given))
    raise TypeError(f"a study is a dictionary, JSON text or a path, not {type(given).__name__}")


# Its table ------------------------------------------------------------------------------------------------------------------


def _frame(store: str, text: str, kept: Optional[str]) -> "pandas.DataFrame":
    import pandas

    columns = {name: _cells(has_numbers, numbers, words, places)
               for name, has_numbers, numbers, words, places in _core.study_columns(store)}
    columns["point"] = columns["point"].astype(np.int64)
    frame = pandas.DataFrame(columns)
    frame["reason"] = frame["reason"].astype(object).where(frame["reason"].notna(), "")
    frame.attrs["study"] = StudyDocument(json.loads(text))
    frame.attrs["store"] = kept
    return frame


def _cells(has_numbers: bool, numbers: Optional[np.ndarray], words: Tuple[str, ...], places: Optional[np.ndarray]) -> Any:
    """A column of the table: floats, booleans, words, or a mixture.

    Parameters
    ----------
    numbers : array of shape (rows)
        NaN in a cell without a number
    words : tuple of str
        the different words of the column
    places : array of shape (rows)
        which of the words a cell holds, -1 for none
    """
    if numbers is None:
        return np.empty(0)
    if places is None:
        return numbers
    if has_numbers:
        cells = numbers.astype(object)
        cells[places >= 0] = np.array(words, dtype=object)[places[places >= 0]]
        return cells
    if not {"true", "false"}.issuperset(words):
        return np.array([*words, None], dtype=object)[places]
    flags = np.array([*(word == "true" for word in words), False])[places]
    if (places >= 0).all():
        return flags
    import pandas

    return pandas.arrays.BooleanArray(flags, places < 0)
