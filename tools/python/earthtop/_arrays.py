# SPDX-License-Identifier: GPL-3.0-or-later
"""The quantities of a result's rows as NumPy arrays."""

from __future__ import annotations

from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._extended import as_mpmath

Texts = Callable[["Quantity"], np.ndarray]


class Kind(NamedTuple):
    """A quantity that rows may have."""

    name: str  #: with its unit, e.g. ``w_LB_B_rad_s``
    components: str  #: letters of its components; empty for a single number
    meaning: str
    columns: Tuple[str, ...]  #: its columns in the file
    words: str  #: of words: those it may be, separated by ``|``
    is_flag: bool

    @property
    def doc(self) -> str:
        shape = f"(rows, {len(self.components)})" if self.components else "(rows)"
        return f"array of shape {shape}: {self.meaning}"


class Quantity(NamedTuple):
    """A quantity of the rows, with its numbers."""

    name: str
    array: np.ndarray  #: read-only, of shape (rows) or (rows, components); words as their places among ``words``
    meaning: str
    columns: Tuple[str, ...]
    words: str


ROW_KINDS = tuple(Kind(*one) for one in _core.row_array_kinds())
TORQUE_KINDS = tuple(Kind(*one) for one in _core.torque_array_kinds())


def read_only(array: np.ndarray) -> np.ndarray:
    array.setflags(write=False)
    return array


def quantities_of(table: Dict[str, List[str]], kinds: Sequence[Kind]) -> List[Quantity]:
    """The quantities in a file's columns of text."""
    found = []
    for kind in kinds:
        if kind.columns[0] not in table:
            continue
        columns = [table[column] for column in kind.columns]
        if kind.words:
            words = kind.words.split("|")
            array = np.array([words.index(text) for text in columns[0]], dtype=np.uint8)
        elif kind.is_flag:
            array = np.array([text == "1" for text in columns[0]], dtype=bool)
        else:
            numbers = [[float(text) if text else np.nan for text in column] for column in columns]
            array = np.array(numbers).T.copy() if kind.components else np.array(numbers[0])
        found.append(Quantity(kind.name, read_only(array), kind.meaning, kind.columns, kind.words))
    return found


class Arrays:
    """Quantities of all rows as NumPy arrays, by attribute or by name; ``print`` and ``dir`` list them.

    Arrays are read-only, of shape (rows) or (rows, components); the unit is the end of the name. What a row does not have
    is NaN. In extended precision they hold numbers of mpmath, and ``digits(name)`` has them as text.
    """

    def __init__(self, quantities: Sequence[Quantity], texts: Optional[Texts] = None, prefix: str = "") -> None:
        self._by_name = {one.name[len(prefix):]: one for one in quantities if one.name.startswith(prefix)}
        self._texts = texts
        self._made: Dict[str, np.ndarray] = {}

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in self._by_name:
            return self[name]
        raise AttributeError(name if name.startswith("_") else f"there is no {name!r}; there are {', '.join(self)}")

    def __getitem__(self, name: str) -> np.ndarray:
        one = self._by_name[name]
        if one.words:
            return self._once(name, lambda: np.array(one.words.split("|"), dtype=str)[one.array])
        if self._texts is None or one.array.dtype != np.float64 or one.name == "t_s":
            return one.array
        texts = self._texts
        return self._once(name, lambda: as_mpmath(texts(one)))

    def _once(self, name: str, make: Callable[[], np.ndarray]) -> np.ndarray:
        if name not in self._made:
            self._made[name] = read_only(make())
        return self._made[name]

    def digits(self, name: str) -> np.ndarray:
        """The numbers of a quantity as text, with all the digits that the program writes; empty where there is no number."""
        one = self._by_name[name]
        if self._texts is not None:
            return self._texts(one)
        return np.array(["" if x != x else repr(x) for x in one.array.ravel().tolist()]).reshape(one.array.shape)

    def meaning(self, name: str) -> str:
        """What a quantity is, with its frames and axes."""
        return self._by_name[name].meaning

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_name)

    def __len__(self) -> int:
        return len(self._by_name)

    def __contains__(self, name: object) -> bool:
        return name in self._by_name

    def __dir__(self) -> List[str]:
        return sorted({*super().__dir__(), *self._by_name})

    def __repr__(self) -> str:
        lines = [f"  {name:<26}{str(one.array.shape):<14}{one.meaning}" for name, one in self._by_name.items()]
        return "\n".join(["<earthtop arrays:", *lines, ">"])
