# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python package share."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    """The earthtop program of the same build."""
    path = os.environ.get("EARTHTOP_PROGRAM", str(ROOT / "build/release/tools/earthtop/earthtop"))
    assert Path(path).is_file(), f"{path} was not built; EARTHTOP_PROGRAM names another"
    return path


@pytest.fixture(scope="session")
def scenarios():
    """The directory of the shipped scenarios."""
    return ROOT / "scenarios"
