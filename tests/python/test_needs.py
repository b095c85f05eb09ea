# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel's metadata say which NumPy an extension can use that is built with one version of pybind11 or another."""

import os
import subprocess
import sys
from email.parser import Parser
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "tools" / "python"
pytest.importorskip("setuptools")
pytest.importorskip("wheel")


@pytest.mark.parametrize("pybind11, limits", [
    ("2.11.9", {">=1.24", "<2"}),
    ("2.12.0", {">=1.24"}),
    ("3.0.0", {">=1.24"}),
])
def test_numpy_by_version_of_pybind11(pybind11, limits, tmp_path):
    """In front of the pybind11 of this machine CMake is given one of another version, in which there is nothing but its name."""
    (tmp_path / "pybind11Config.cmake").write_text("add_library(pybind11::module INTERFACE IMPORTED)\n")
    (tmp_path / "pybind11ConfigVersion.cmake").write_text(f"set(PACKAGE_VERSION {pybind11})\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
    code = "import setuptools.build_meta, sys; setuptools.build_meta.prepare_metadata_for_build_wheel(sys.argv[1])"
    subprocess.run([sys.executable, "-c", code, tmp_path], cwd=PACKAGE, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "pybind11_DIR": str(tmp_path)})
    [file] = tmp_path.glob("*/METADATA")
    stated = Parser().parsestr(file.read_text(encoding="utf-8")).get_all("Requires-Dist")
    [numpy] = [needed for needed in stated if needed.startswith("numpy")]
    assert set(numpy[len("numpy"):].strip(" ()").split(",")) == limits
