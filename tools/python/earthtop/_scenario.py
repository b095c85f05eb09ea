# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenarios: what a top is, where it stands, and how it is released."""

from __future__ import annotations

import copy
import difflib
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple, Union

from . import _core
from ._errors import Finding, ScenarioError, of_scenario, refuse

ScenarioLike = Union["Scenario", Mapping, str, os.PathLike]


def json_text(value: Any) -> str:
    """A value as JSON. Numbers keep all their digits; NumPy's numbers and arrays are taken, NaN is not."""

    def plain(thing: Any) -> Any:
        if hasattr(thing, "tolist"):  # numbers and arrays of NumPy
            return thing.tolist()
        if isinstance(thing, Mapping):
            return dict(thing)
        if isinstance(thing, os.PathLike):
            return os.fspath(thing)
        raise TypeError(f"a scenario cannot hold {type(thing).__name__}")

    return json.dumps(value, default=plain, allow_nan=False, ensure_ascii=False)


def pointer_of(key: str) -> str:
    """The JSON pointer that a user means: ``"/site/latitude_deg"``, ``"site/latitude_deg"``, ``"site.latitude_deg"``, or the bare name of a key that
    only one section has; ``"mass_kg"``, which a rotor has, too, is the body's.

    >>> pointer_of("latitude_deg")
    '/site/latitude_deg'
    """
    if not isinstance(key, str):
        raise TypeError("a key is a string such as 'site/latitude_deg'")
    return _core.scenario_pointer(key)


def _steps(pointer: str) -> List[str]:
    return [step.replace("~1", "/").replace("~0", "~") for step in pointer.split("/")[1:]]


def _look_up(tree: Any, pointer: str) -> Any:
    for step in _steps(pointer):
        tree = tree[int(step)] if isinstance(tree, list) else tree[step]
    return tree


@dataclass(frozen=True)
class Check:
    """What was found in a scenario."""

    errors: Tuple[Finding, ...]  #: at most 20, then one that says how many more there are
    warnings: Tuple[Finding, ...]  #: allowed values that look like mistakes
    error_count: int

    def __bool__(self) -> bool:
        """Whether the scenario can be run."""
        return self.error_count == 0

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors + self.warnings)) or "nothing is wrong"


class Scenario:
    """A scenario, made of a dictionary or of JSON text with the keys of a scenario file.

    >>> top = Scenario({
    ...     "site": {"latitude_deg": 48},
    ...     "body": {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.04],
    ...              "inertia": {"about": "pivot", "principal_kg_m2": [2e-4, 2e-4, 5e-5]}},
    ...     "release": {"tilt_deg": 10, "spin_rad_s": 200},
    ...     "motion": {"duration_s": 10, "output_step_s": 0.1},
    ... })
    >>> top["site/latitude_deg"]
    48
    >>> top["latitude_deg"] = -33.9

    It is checked when it is made: all that is wrong is in the ``findings`` of the ScenarioError. A changed value is
    checked when the scenario is used, so that values can be changed one after the other.

    Parameters
    ----------
    content : mapping or str
        the scenario
    path : str or path, optional
        the file that the scenario is said to be from; files that it names are looked for beside it
    """

    def __init__(self, content: Union[Mapping, str], *, path: Union[str, os.PathLike, None] = None) -> None:
        if isinstance(content, os.PathLike) or (isinstance(content, str) and content.endswith(".json") and "{" not in content):
            raise refuse(f"{os.fspath(content)!r} is the name of a file; earthtop.load reads one")
        self._path = os.fspath(path) if path is not None else ""
        self._text = content if isinstance(content, str) else json_text(content)
        self._changes: Dict[str, str] = {}  # JSON values by their pointers
        self._scene: Optional[_core.Scene] = None
        self.scene()

    # The keys ---------------------------------------------------------------------------------------------------------

    def __getitem__(self, key: str) -> Any:
        """The value at a key, e.g. ``"site/latitude_deg"``; a default where the scenario does not give it."""
        pointer = pointer_of(key)
        try:
            return _look_up(self.to_dict(), pointer)
        except (KeyError, IndexError, ValueError, TypeError):
            pass
        try:
            return _look_up(json.loads(self.scene().canonical), pointer)
        except (KeyError, IndexError, ValueError, TypeError):
            raise KeyError(key) from None

    def __setitem__(self, key: str, value: Any) -> None:
        pointer = pointer_of(key)
        self._changes.pop(pointer, None)
        self._changes[pointer] = json_text(value)
        self._scene = None

    def changed(self, changes: Optional[Mapping[str, Any]] = None, **more: Any) -> "Scenario":
        """A copy with other values, e.g. ``top.changed(duration_s=60)`` or ``top.changed({"site/latitude_deg": 0})``."""
        other = copy.copy(self)
        other._changes = dict(self._changes)
        for key, value in {**(changes or {}), **more}.items():
            other[key] = value
        return other

    def keys(self) -> Iterator[str]:
        """The JSON pointers of all keys that a scenario may have; elements of lists have index 0."""
        return iter(_core.scenario_pointers())

    # What it is -------------------------------------------------------------------------------------------------------

    def scene(self) -> "_core.Scene":
        """The checked scenario. Raises ScenarioError with all findings if something is wrong."""
        if self._scene is None:
            scene, _, errors, _ = _core.examine(self._path, self._text, list(self._changes.items()))
            if scene is None:
                raise ScenarioError(of_scenario(errors, bool(self._changes)))
            self._scene = scene
        return self._scene

    def check(self) -> Check:
        """All that is wrong, and what looks like a mistake."""
        return check(self)

    def to_dict(self) -> Dict[str, Any]:
        """The scenario as a dictionary of its own, without defaults that it does not give."""
        tree: Dict[str, Any] = json.loads(self.text.lstrip("\ufeff"))
        return tree

    @property
    def name(self) -> str:
        return self.scene().name

    @property
    def path(self) -> str:
        """The file that it is from; empty if it is from none."""
        return self._path

    @property
    def text(self) -> str:
        """The scenario as JSON text: the text that it was made of, comments and layout included, with the changes in it."""
        return _core.changed_text(self._text, list(self._changes.items()))

    @property
    def canonical(self) -> str:
        """One line of JSON with every default written out."""
        return self.scene().canonical

    @property
    def sha256(self) -> str:
        """The identity of its results: equal for scenarios that compute the same."""
        return self.scene().sha256

    @property
    def top(self) -> Dict[str, Any]:
        """Mass, moments, critical spin, rates of precession and nutation, as in ``summary["top"]``."""
        return json.loads(self.scene().top)

    def save(self, path: Union[str, os.PathLike], *, force: bool = False) -> Path:
        """Writes it to a file. A file that is there, unless it has the same content, needs ``force``."""
        from ._documents import errors_named

        with errors_named():
            _core.write_files([(_core.OutputKind.scenario, os.fspath(path), self.text)], [], force)
        return Path(path)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scenario):
            return NotImplemented
        return self.canonical == other.canonical

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> "Scenario":
        other = object.__new__(Scenario)
        other.__dict__.update(self.__dict__, _changes=dict(self._changes))
        return other

    def __deepcopy__(self, memory: dict) -> "Scenario":
        return copy.copy(self)

    def __getstate__(self) -> Dict[str, Any]:
        return {"path": self._path, "text": self._text, "changes": self._changes}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self._path, self._text, self._changes = state["path"], state["text"], state["changes"]
        self._scene = None

    def __repr__(self) -> str:
        try:
            scene = self.scene()
        except ScenarioError as error:
            return f"<earthtop.Scenario, not valid: {error.findings[0].message}>"
        return f"<earthtop.Scenario {scene.name!r}: {scene.rows} rows, method {scene.method}>"


def load(path: Union[str, os.PathLike]) -> Scenario:
    """Reads a scenario file. ScenarioError if it is refused, FileError if it is missing or cannot be read."""
    name, text = _core.read_scenario(os.fspath(path))
    return Scenario(text, path=name)


def _examples() -> Path:
    return Path(__file__).parent / "scenarios"


def examples() -> List[str]:
    """The names of the shipped scenarios."""
    return sorted(file.stem for file in _examples().glob("*.json"))


def example(name: str) -> Scenario:
    """A shipped scenario by its name, e.g. ``example("toy-top")``."""
    names = examples()
    if name not in names:
        near = difflib.get_close_matches(name, names, n=1)
        raise refuse(f"no shipped scenario is called {name!r}" + (f"; did you mean {near[0]!r}?" if near else ""))
    return load(_examples() / f"{name}.json")


def _is_text(what: Any) -> bool:
    """Whether a string is JSON text, or meant to be, and not the path of a file."""
    return isinstance(what, str) and (not what.strip() or "\n" in what or what.lstrip("\ufeff \t").startswith(("{", "[")))


def as_scenario(what: ScenarioLike) -> Scenario:
    """A scenario from what a user may give: a Scenario, a dictionary, JSON text, or the path of a file."""
    if isinstance(what, Scenario):
        return what
    if isinstance(what, Mapping) or _is_text(what):
        return Scenario(what)  # type: ignore[arg-type]
    if isinstance(what, (str, os.PathLike)):
        return load(what)
    raise TypeError(f"a scenario is a Scenario, a dictionary, JSON text or a path, not {type(what).__name__}")


def check(what: ScenarioLike) -> Check:
    """All that is wrong in a scenario, as ``earthtop check`` finds it; nothing is run and nothing raised for it.

    ``what`` may be the path of a file, JSON text, a dictionary or a Scenario.
    """
    path, text, changes = "", "", []
    if isinstance(what, Scenario):
        path, text, changes = what._path, what._text, list(what._changes.items())
    elif isinstance(what, Mapping):
        text = json_text(what)
    elif _is_text(what):
        text = str(what)
    else:
        try:
            path, text = _core.read_scenario(os.fspath(what))
        except ScenarioError as error:
            return Check(error.findings, (), len(error.findings))
    _, count, errors, warnings = _core.examine(path, text, changes)
    return Check(of_scenario(errors, bool(changes)), of_scenario(warnings, bool(changes)), count)
