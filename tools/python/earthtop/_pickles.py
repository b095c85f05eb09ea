# SPDX-License-Identifier: GPL-3.0-or-later
"""Pickles of results and documents: a damaged one is refused, and not read as other numbers.

The checksum finds accidents. It is no protection against intent: a pickle is code, whoever wrote it.
"""

from __future__ import annotations

import hashlib
import pickle
import warnings
from typing import Any, Tuple

from ._errors import UnverifiedWarning, refuse


def _checksum(kind: type, state: bytes) -> str:
    return hashlib.sha256(kind.__name__.encode() + b"\0" + state).hexdigest()


def restored(kind: type, state: bytes, checksum: str) -> Any:
    """An object as it was pickled. Pickles name this function."""
    if not isinstance(kind, type) or not isinstance(state, bytes) or _checksum(kind, state) != checksum:
        raise refuse("the pickle is damaged: it is not what was written; make it anew")
    made = kind.__new__(kind)
    made._restore(pickle.loads(state))
    return made


class Pickled:
    """An object whose ``__getstate__`` is pickled with a checksum, and which ``_restore`` makes of it."""

    def __reduce__(self) -> Tuple[Any, ...]:
        state = pickle.dumps(self.__getstate__(), protocol=4)  # type: ignore[attr-defined]
        return restored, (type(self), state, _checksum(type(self), state))

    def __setstate__(self, state: Any) -> None:
        """Pickles of earthtop 1.0 come here."""
        warnings.warn("the pickle has no checksum: damage to it would go unnoticed",
                      UnverifiedWarning, stacklevel=2)
        self._restore(state)

    def _restore(self, state: Any) -> None:
        self.__dict__.update(state)
