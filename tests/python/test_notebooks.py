# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks run from the beginning to the end, and every picture in them is drawn."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.long

NOTEBOOKS = sorted((Path(__file__).resolve().parents[2] / "tools" / "python" / "examples").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(path, tmp_path):
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("nbconvert")
    given = nbformat.read(path, as_version=4)
    assert not any(cell.get("outputs") for cell in given.cells), "notebooks are kept without outputs"

    # The kernel is that of this Python, and finds the package where this Python does.
    import earthtop

    folder = str(Path(earthtop.__file__).parents[1])
    environment = {**os.environ, "PYTHONPATH": folder, "PYDEVD_DISABLE_FILE_VALIDATION": "1", "JUPYTER_PLATFORM_DIRS": "1",
                   "IPYTHONDIR": str(tmp_path / "ipython"), "HOME": str(tmp_path)}
    subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", tmp_path, path],
                   env=environment, check=True)

    outputs = [output for cell in nbformat.read(tmp_path / path.name, as_version=4).cells for output in cell.get("outputs", [])]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == sum("plt.subplots" in cell.source for cell in given.cells) > 2
    stderr = [output.text for output in outputs if output.output_type == "stream" and output.name == "stderr"]
    assert stderr == [], "no warnings"


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 2
