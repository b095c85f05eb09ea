# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers with more digits than a double has: they pass as decimal text, and become numbers of mpmath when asked for."""

from __future__ import annotations

from typing import Any, Iterable

import numpy as np

_BITS = 128  #: enough to hold any number with the 36 digits of a float128


def as_mpmath(texts: Iterable[str]) -> np.ndarray:
    """An array of ``mpmath.mpf`` from decimal texts; an empty text gives NaN.

    The numbers keep all their digits, whatever ``mpmath.mp.dps`` is; what is computed with them later is rounded to that.
    Needs mpmath (Debian: python3-mpmath).
    """
    import mpmath

    def number(text: str) -> Any:
        if text == "":
            return mpmath.mpf("nan")
        return mpmath.mp.make_mpf(mpmath.libmp.from_str(text, _BITS, "n"))

    given = np.asarray(texts, dtype=object)
    numbers = np.empty(given.shape, dtype=object)
    for index, text in np.ndenumerate(given):
        numbers[index] = number(text)
    return numbers
