# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of the manual and of the docstrings are run, and print what they say."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import earthtop as et
from earthtop._arrays import ROW_KINDS, TORQUE_KINDS

MANUAL = Path(__file__).resolve().parents[2] / "tools" / "python" / "README.md"
MODULES = sorted(module.name for module in pkgutil.iter_modules(et.__path__) if module.name != "_core")


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Examples write files into a directory of their own, and pictures into no window."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")


@pytest.mark.parametrize("module", ["", *MODULES])
def test_docstrings(module):
    failed, _ = doctest.testmod(importlib.import_module(f"earthtop.{module}".rstrip(".")))
    assert failed == 0


def test_some_docstrings_have_examples():
    finder = doctest.DocTestFinder()
    modules = [et, *(importlib.import_module(f"earthtop.{module}") for module in MODULES)]
    assert sum(len(test.examples) for module in modules for test in finder.find(module)) >= 5


@pytest.mark.long
def test_manual():
    failed, number = doctest.testfile(str(MANUAL), module_relative=False, encoding="utf-8")
    assert failed == 0 and number > 20


def test_arrays_of_the_manual():
    """Its tables have every array that a result may have, with shape and meaning, in the order of the rows."""
    found = re.findall(r"^\| `(\w+)` \| (\(rows.*?\)) \| (.*) \|$", MANUAL.read_text(encoding="utf-8"), re.MULTILINE)
    assert found == [(kind.name, f"(rows, {len(kind.components)})" if kind.components else "(rows)", kind.meaning)
                     for kind in (*ROW_KINDS, *TORQUE_KINDS)]
    r = et.run(et.example("toy-top-on-table"), {"numerics/ledger": "laboratory"}, duration_s=0.1)
    widths = {name: len(shape.split(", ")[1:]) for name, shape, _ in found}
    assert all(arrays[name].ndim == 1 + widths[name] for arrays in (r.rows, r.torques) for name in arrays)


def test_every_public_name_is_documented():
    undocumented = [name for name in et.__all__ if not (getattr(et, name).__doc__ or "").strip()]
    assert undocumented == []
