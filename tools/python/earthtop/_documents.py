# SPDX-License-Identifier: GPL-3.0-or-later
"""What all answers have in common that are documents of the program: JSON, a picture, tables."""

from __future__ import annotations

import contextlib
import json
import os
from math import nan
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

from . import _core
from ._errors import Finding, ScenarioError, refuse
from ._html import html_of
from ._pickles import Pickled
from ._scenario import Scenario, json_text

if TYPE_CHECKING:
    import pandas

Given = Tuple[str, str, List[Tuple[str, str]]]


class Document(Pickled):
    """A document of the program. ``text`` is what ``earthtop ... --json`` prints, ``document`` its content as a dictionary.

    It can be pickled, and ``earthtop.report`` makes a page of most of them.
    """

    def __init__(self, text: str, svg: str = "") -> None:
        self.text = text  #: the document as the program prints it
        self.svg = svg  #: its picture as SVG; empty if it has none
        self._document: Optional[Dict[str, Any]] = None

    @property
    def document(self) -> Dict[str, Any]:
        """The content of the document."""
        if self._document is None:
            self._document = json.loads(self.text)
        return self._document

    def save(self, path: Union[str, os.PathLike], *, force: bool = False) -> Path:
        """Writes the document to a file, of which ``earthtop report`` makes a page.

        A document of the same kind is replaced; another file that is there needs ``force``.
        """
        with errors_named():
            _core.write_files([(_core.OutputKind.document, os.fspath(path), self.text)], [], force)
        return Path(path)

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_document": None}

    def __eq__(self, other: object) -> bool:
        """Whether both are of one kind and say the same."""
        if not isinstance(other, Document):
            return NotImplemented
        return type(self) is type(other) and self.document == other.document

    __hash__ = None  # type: ignore[assignment]

    def _headline(self) -> str:
        return type(self).__name__

    def _lines(self) -> Sequence[str]:
        return ()

    def __repr__(self) -> str:
        lines = [f"<earthtop.{type(self).__name__} {self._headline()}", *(f"  {line}" for line in self._lines())]
        return "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        return html_of(self._headline(), self._lines(), self.svg)


def label(one: Mapping[str, Any]) -> str:
    """The name of an input in a document; with its release where there are several and it is not that of all."""
    return f"{one['name']} of release {one['release']}" if "release" in one else one["name"]


def exact_of(document: Mapping[str, Any]) -> "pandas.DataFrame":
    """The inputs that each estimate of a document takes as exact."""
    rows = [{"estimate": label(one), **exact, "name": label(exact)}
            for one in document["estimates"] for exact in one.get("exact", [])]
    return table(rows, ["estimate", "name", "unit"], ["value", "stated", "shift", "misfit", "error_of_one_sigma"])


def findings_of(document: Mapping[str, Any]) -> List[Dict[str, Any]]:
    """The estimates of a document, each with the outcome of its finding in the place of the finding."""
    return [{**one, "name": label(one), "finding": (one.get("finding") or {}).get("outcome")} for one in document["estimates"]]


def table(rows: Sequence[Mapping[str, Any]], words: Sequence[str], numbers: Sequence[str], *, index: str = "",
          order: Sequence[str] = ()) -> "pandas.DataFrame":
    """A DataFrame of some keys of JSON objects.

    Parameters
    ----------
    rows : sequence of mappings
    words : sequence of str
        keys whose values are kept as they are
    numbers : sequence of str
        keys of numbers: null becomes NaN
    index : str
        the column whose values are the index, too
    order : sequence of str
        the columns in their order; default: words, then numbers
    """
    import pandas

    columns: Dict[str, Any] = {}
    for key in order or [*words, *numbers]:
        values = [row.get(key) for row in rows]
        columns[key] = values if key in words else pandas.Series([nan if x is None else x for x in values], dtype=float)
    frame = pandas.DataFrame(columns)
    return frame.set_index(pandas.Index(frame[index], name=None)) if index else frame


def correlation_of(document: Mapping[str, Any]) -> "pandas.DataFrame":
    """Correlation matrix of the estimates' errors, of shape (estimates, estimates), by their names; empty if there is none."""
    import pandas

    matrix = document["correlation"]
    names = [label(one) for one in document["estimates"]] if matrix else []
    return pandas.DataFrame(matrix, index=names, columns=names, dtype=float)


def parts_of(scenario: Scenario) -> Given:
    """A scenario as the compiled module takes it: the file, its text, and the changes after it."""
    return scenario._path, scenario._text, list(scenario._changes.items())


def names_of(given: Union[str, Sequence[str]]) -> List[str]:
    """Names or keys of numbers to be estimated, from one or several."""
    return [given] if isinstance(given, str) else list(given)


def number(value: Any, name: str) -> float:
    """A number that was given as an argument."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise refuse(f"{name} must be a number, not {value!r}") from None


def plain_json(value: Any, what: str) -> str:
    """A value as JSON; what has no form in JSON is refused."""
    try:
        return json_text(value)
    except ValueError as error:
        raise refuse(f"{what}: {error}; numbers must be finite") from None


@contextlib.contextmanager
def errors_named(names: Optional[Mapping[str, str]] = None) -> Iterator[None]:
    """Raises errors in which temporary files are called what they stand for.

    Parameters
    ----------
    names : mapping, optional
        what to call the paths that the user has not given
    """

    def changed(text: str) -> str:
        return renamed(text, names or {})

    try:
        yield
    except ScenarioError as error:
        raise type(error)([
            Finding(changed(one.path), one.line, one.column, changed(one.pointer), changed(one.message), changed(one.text))
            for one in error.findings
        ]) from None


def renamed(text: str, names: Mapping[str, str]) -> str:
    """A text with other names for paths."""
    for path, name in names.items():
        text = text.replace(path, name)
    return text
