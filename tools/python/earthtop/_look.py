# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of the program's pictures, for those of matplotlib: the values of src/plot/palette.hpp and strokes.hpp, with which a
test of the program compares them."""

from __future__ import annotations

from typing import Any, Optional

# In the order in which a picture's curves take them.
CURVES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a8f98")
MUTED = "#5f6673"
BAND_OPACITY = 0.35


def axes(given: Optional[Any]) -> Any:
    """The axes given, or new ones whose curves have the program's colours."""
    if given is not None:
        return given
    import matplotlib.pyplot

    _, made = matplotlib.pyplot.subplots()
    made.set_prop_cycle(color=CURVES)
    return made
