# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the installed Python package says which NumPy it needs: from 1.24 on, and below 2 if its extension was built with a pybind11
before 2.12, which knows nothing of NumPy 2.

    needs.py [DEPENDS]     DEPENDS: what its Debian package depends on
"""

import sys
from importlib.metadata import requires, version

from earthtop import _core

limited = tuple(map(int, _core.pybind11.split("."))) < (2, 12)
stated = [needed for needed in requires("earthtop") if needed.startswith("numpy")]
limits = [set(needed[len("numpy"):].strip(" ()").split(",")) for needed in stated]
assert limits == [{">=1.24", "<2"} if limited else {">=1.24"}], f"built with pybind11 {_core.pybind11}, it needs {stated}"
for depends in sys.argv[1:]:
    limits = {needed for needed in depends.split(", ") if needed.startswith("python3-numpy")}
    expected = {"python3-numpy (>= 1:1.24)", "python3-numpy (<< 1:2)"} if limited else {"python3-numpy (>= 1:1.24)"}
    assert limits == expected, f"built with pybind11 {_core.pybind11}, its Debian package depends on {limits}"
print(f"built with pybind11 {_core.pybind11}, it needs {stated[0]}; NumPy here: {version('numpy')}")
