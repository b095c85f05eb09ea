# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of many results."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, List, Mapping, Optional, Sequence, Union

from ._errors import refuse
from ._result import Result, load_result

if TYPE_CHECKING:
    import pandas

_COLUMNS = ("drift.axis_final_rad", "drift.axis_bound_rad", "drift.azimuth_final_rad", "drift.tilt_final_rad", "drift.verdict",
            "drift.verdict_reason")


def table(results: Union[Iterable[Union[Result, str, os.PathLike]], Mapping[str, Union[Result, str, os.PathLike]]],
          collect: Optional[Union[str, Sequence[str], Mapping[str, str]]] = None) -> "pandas.DataFrame":
    """A DataFrame with one row for each of many results.

    >>> import earthtop as et
    >>> top = et.example("toy-top").changed(duration_s=1)
    >>> both = et.table([et.run(top), et.run(top, name="south", latitude_deg=-48)])
    >>> list(both["name"])
    ['toy-top', 'south']

    Parameters
    ----------
    results : iterable of Result or path, or mapping
        results, or directories of results; a mapping gives the rows other names than the scenarios'
    collect : str, sequence of str or mapping, optional
        quantities of the summary, by their dotted paths, as of ``earthtop.study``; a mapping gives columns other names. Default: the
        drift of the axis, its bound, its parts, the verdict and its reason

    Returns
    -------
    pandas.DataFrame
        ``name`` and ``status``, then what was collected, under the names that study.csv has; units end the names. What a summary
        does not have is NaN or None.

    Raises
    ------
    ScenarioError
        if a path is in no summary
    FileError
        if a directory is missing
    """
    import pandas

    if isinstance(results, (Result, str, os.PathLike)):
        results = [results]  # type: ignore[list-item]
    given = list(results.items()) if isinstance(results, Mapping) else [(None, one) for one in results]
    wanted = [collect] if isinstance(collect, str) else _COLUMNS if collect is None else collect
    paths = dict(wanted) if isinstance(wanted, Mapping) else {path: path for path in wanted}
    read = [(name, one if isinstance(one, Result) else load_result(one)) for name, one in given]
    columns = {"name": [one.name if name is None else name for name, one in read], "status": [one.status for _, one in read]}
    for column, path in paths.items():
        if column in ("name", "status"):
            raise refuse(f"the table has a column {column!r} already; give this one another name")
        found = [_look_up(one.summary, path) for _, one in read]
        if read and collect is not None and all(is_there is False for is_there, _ in found):
            raise refuse(f"no summary has {path!r}; it is a dotted path such as 'drift.axis_final_rad'")
        columns[column] = _column([value for _, value in found])
    return pandas.DataFrame(columns)


def _look_up(summary: Any, path: str) -> Any:
    """Whether a summary has a path, and what it has there."""
    for step in path.split("."):
        if isinstance(summary, list) and step.isdigit() and int(step) < len(summary):
            summary = summary[int(step)]
        elif isinstance(summary, Mapping) and step in summary:
            summary = summary[step]
        else:
            return False, None
    return True, summary


def _column(values: List[Any]) -> List[Any]:
    """None becomes NaN in a column of numbers."""
    has_words = any(isinstance(one, (str, bool, dict, list)) for one in values)
    return values if has_words else [float("nan") if one is None else one for one in values]
