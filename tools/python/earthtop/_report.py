# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages for people."""

from __future__ import annotations

import contextlib
import os
import tempfile
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Tuple, Union

from . import _core
from ._documents import Document, errors_named, plain_json, renamed
from ._errors import refuse, warn
from ._result import Result
from ._study import store_of

if TYPE_CHECKING:
    import pandas

    Reportable = Union[Result, Document, Mapping[str, Any], pandas.DataFrame, str, os.PathLike]


def report(what: "Reportable", path: Union[None, str, os.PathLike] = None, *, svg: bool = False,
           force: bool = False) -> Path:
    """Writes one self-contained HTML page, which needs no other file and no network.

    Parameters
    ----------
    what : Result, Comparison, Fit, Plan, their documents, DataFrame of a study, or path
        what the page is about. A study must have been given ``out``. A path is that of a directory of results, of a study, or
        of a document.
    path : str or path, optional
        the page; default, where ``what`` is a path: report.html in the directory, or the document's name with .html
    svg : bool
        write its pictures beside it as SVG files, too
    force : bool
        overwrite files with these names that earthtop did not write, or that have been changed since

    Returns
    -------
    pathlib.Path
        the page

    Raises
    ------
    ScenarioError
        if there is no page about it; or if another file is in the way
    """
    with contextlib.ExitStack() as stack:
        place, names = _place(what, stack)
        if path is None and names:
            raise refuse("say where the page is to be written, e.g. earthtop.report(r, 'page.html')")
        stack.enter_context(errors_named(names))
        page = Path(_core.report_file(place) if path is None else path)
        html, pictures, notes = _core.make_report(place)
        warn(renamed(note, names) for note in notes)
        in_markup = {escape(name): escape(called) for name, called in names.items()}
        kind = _core.OutputKind
        files = [(kind.page, str(page), renamed(html, in_markup))]
        files += [(kind.page_picture, str(page.with_name(f"{page.stem}-{name}.svg")), picture)
                  for name, picture in (pictures if svg else ())]
        inside = [place] if os.path.isfile(place) else [os.path.join(place, name) for name in os.listdir(place)
                                                        if not name.endswith((".html", ".svg"))]
        _core.write_files(files, inside, force)
    return page


def _place(what: "Reportable", stack: contextlib.ExitStack) -> Tuple[str, Mapping[str, str]]:
    """The path of what is to be reported, and what to call it if it is a temporary one."""
    if isinstance(what, Result):
        directory = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="earthtop-"))) / "results"
        what.save(directory)
        return str(directory), {str(directory): what.summary["name"]}
    if isinstance(what, (Document, Mapping)):
        file = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="earthtop-"))) / "document.json"
        file.write_text(what.text if isinstance(what, Document) else _core.resealed(plain_json(what, "the document")),
                        encoding="utf-8")
        return str(file), {str(file): f"<{type(what).__name__}>"}
    return store_of(what), {}
