# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of exceptions and warnings, and what objects say that they have."""

import ast
import json
import pickle
import re
import sys
import types
import warnings
from pathlib import Path

import numpy as np
import pytest

import earthtop as et
from earthtop import _core
from earthtop._errors import as_arguments

ROOT = Path(__file__).resolve().parents[2]
STUB = ROOT / "tools/python/earthtop/_core.pyi"


@pytest.fixture(scope="module")
def r():
    return et.run(et.example("toy-top"), duration_s=1)


MISSING = {
    "load": lambda path: et.load(path),
    "run": lambda path: et.run(path),
    "explain": lambda path: et.explain(path),
    "study": lambda path: et.study(path),
    "load_result": lambda path: et.load_result(path),
    "load_study": lambda path: et.load_study(path),
    "compare": lambda path: et.compare(path, path),
    "report": lambda path: et.report(path),
    "fit": lambda path: et.fit(et.example("toy-top"), path, estimate=["spin_rad_s"]),
    "fit_releases": lambda path: et.fit_releases([(et.example("toy-top"), path)], estimate=["spin_rad_s"]),
    "table": lambda path: et.table([path]),
}


@pytest.mark.parametrize("name", MISSING)
def test_a_missing_file_is_a_file_error(name, tmp_path):
    path = str(tmp_path / "no --force file.json")
    for kind in (et.FileError, et.ScenarioError, FileNotFoundError, ValueError):  # what handlers of 1.0 and of Python catch
        with pytest.raises(kind) as caught:
            MISSING[name](path)
    error = caught.value
    assert error.path == error.filename == error.findings[0].path == path and path in str(error)
    assert error.errno == 2 and error.reason == error.findings[0].message
    assert "standard input" not in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and again.findings == error.findings


def test_other_refusals_are_no_file_errors(tmp_path):
    for refused in (lambda: et.load(tmp_path), lambda: et.run(et.example("toy-top"), tilt_deg=999)):
        with pytest.raises(et.ScenarioError) as caught:
            refused()
        assert not isinstance(caught.value, OSError)


def sentences():
    """String literals of the library, neighbouring ones joined, that name an option of the program."""
    literal = re.compile(r'"((?:[^"\\\n]|\\.)*)"(?:\s*"((?:[^"\\\n]|\\.)*)")*')
    for file in sorted((ROOT / "src").rglob("*.cpp")):
        for found in literal.finditer(file.read_text(encoding="utf-8")):
            text = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', found[0]))
            if re.search(r"(^|[ (`])--[a-z]|\bearthtop (run|compare|study)\b", text) and "cmake" not in text:
                yield text


def test_no_sentence_of_the_library_has_words_of_the_command_line():
    told = list(sentences())
    assert len(told) > 40 and any("--allow-missing" in text or "--force" in text for text in told)
    for text in told:
        said = as_arguments(text)
        assert not re.search(r"(^|[ (`])--[a-z]", said), said
        assert "earthtop run" not in said, said


def test_refusals_name_arguments(r, tmp_path):
    r.save(tmp_path / "r")
    other = et.run(et.example("toy-top"), duration_s=2)
    with pytest.raises(et.ScenarioError, match="choose another directory, or force=True to overwrite them"):
        other.save(tmp_path / "r")
    with pytest.raises(et.ScenarioError, match="from changes"):
        et.run(et.example("toy-top"), tilt_deg=999)
    (tmp_path / "doc.json").write_text("mine")
    with pytest.raises(et.ScenarioError, match="force=True"):
        et.example("toy-top").save(tmp_path / "doc.json")


def test_warnings_are_at_the_line_of_the_call(r, tmp_path):
    r.save(tmp_path / "r")
    for name in ("summary.json", "timing.json"):
        text = (tmp_path / "r" / name).read_text()
        document = {key: value for key, value in json.loads(text).items() if key not in ("files", "checksum")}
        (tmp_path / "r" / name).write_text(json.dumps(document))
    calls = [lambda: et.load_result(tmp_path / "r"), lambda: et.compare(tmp_path / "r", tmp_path / "r"),
             lambda: et.report(tmp_path / "r", tmp_path / "page.html", force=True), lambda: et.table([tmp_path / "r"])]
    for call in calls:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            call()
        assert caught and {(one.filename, one.lineno) for one in caught} <= {
            (__file__, line) for line in range(call.__code__.co_firstlineno, call.__code__.co_firstlineno + 2)}


def test_findings_of_changed_scenarios_are_at_the_line_of_the_call(tmp_path):
    top = et.example("toy-top")
    bursting = top.changed(spin_rad_s=1e9)
    checked, line = et.check(bursting), sys._getframe().f_lineno
    finding = (checked.errors + checked.warnings)[0]
    assert (finding.path, finding.line, finding.column, finding.pointer) == (__file__, line, None, "/body/inertia")
    assert str(finding).startswith(f"{__file__}:{line}: ") and "toy-top.json" not in str(finding)
    with pytest.raises(et.ScenarioError, match=re.escape(__file__)):
        et.run(top.changed(precession="steady_slow", spin_rad_s=0))
    # Without changes they are where they are in the file.
    text = top.text.replace('"spin_rad_s": 200', '"spin_rad_s": 1e9')
    (tmp_path / "top.json").write_text(text)
    checked = et.check(tmp_path / "top.json")
    in_file = (checked.errors + checked.warnings)[0]
    assert in_file.path == str(tmp_path / "top.json") and in_file.line == text[:text.index('"inertia"')].count("\n") + 1


@pytest.mark.parametrize("name", ["toy-top", "toy-top-on-table", "tumbling-gyrostat"])
def test_dir_lists_what_there_is(name):
    r = et.run(et.example(name), duration_s=0.5)
    for thing in (r, r.drift, r.rows, r.torques, r.scenario):
        assert [one for one in dir(thing) if not hasattr(thing, one)] == []
    assert {one for one in r.rows if not one.startswith("drift_")} <= set(dir(r))
    assert {*r.summary["drift"], *(one[6:] for one in r.rows if one.startswith("drift_"))} <= set(dir(r.drift))
    assert ("tip_L_m" in dir(r)) == (name == "toy-top-on-table")
    assert {"rotation", "to_pandas", "summary"} <= set(dir(r))


def test_the_stub_states_what_the_module_has():
    tree = ast.parse(STUB.read_text(encoding="utf-8"))
    stated, classes = set(), {}
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            stated.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            stated.add(node.target.id)
        if isinstance(node, ast.ClassDef):
            classes[node.name] = {one.name if isinstance(one, ast.FunctionDef) else one.target.id for one in node.body}
    assert stated == {name for name in dir(_core) if not name.startswith("_")}
    for name, members in classes.items():
        of_enums = {"name", "value"} if name == "OutputKind" else set()
        there = {one for one in dir(getattr(_core, name)) if not one.startswith("_")} - of_enums
        assert {one for one in members if not one.startswith("_")} == there, name
    used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    imported = {alias.name for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert {"Dict", "List", "Tuple"} & used <= imported


def test_results_are_equal_if_they_hold_the_same(r, tmp_path):
    top = et.example("toy-top")
    same = et.run(top, duration_s=1)
    assert r == same and not r != same and r is not same
    assert r == pickle.loads(pickle.dumps(r)) == et.load_result(r.save(tmp_path / "r"))
    assert r != et.run(top, duration_s=1, spin_rad_s=np.nextafter(200, 201))
    assert r != et.run(top, {"numerics/ledger": "laboratory"}, duration_s=1)
    assert r != "toy-top" and r != None  # noqa: E711
    for thing in (r, top, et.compare(r, same)):
        with pytest.raises(TypeError, match="unhashable"):
            hash(thing)
    assert et.explain(top) == et.explain(top) != et.explain(top, latitude_deg=10)


def test_rotation_is_that_of_scipy(r):
    pytest.importorskip("scipy")
    rotation = r.rotation()
    assert len(rotation) == len(r.t_s)
    assert np.allclose(rotation.apply([0, 0, 1]), r.axis_L, atol=1e-14)  # a few roundings of numbers up to 1
    assert np.allclose(rotation.as_quat(), np.roll(r.q_LB, -1, axis=1), atol=1e-14)  # the same


def test_rotation_puts_the_scalar_last_and_says_what_it_needs(r, monkeypatch):
    spatial = types.ModuleType("scipy.spatial.transform")
    spatial.Rotation = types.SimpleNamespace(from_quat=lambda q: q)
    monkeypatch.setitem(sys.modules, "scipy", types.ModuleType("scipy"))
    monkeypatch.setitem(sys.modules, "scipy.spatial", types.ModuleType("scipy.spatial"))
    monkeypatch.setitem(sys.modules, "scipy.spatial.transform", spatial)
    assert np.array_equal(r.rotation(), r.q_LB[:, [1, 2, 3, 0]])
    monkeypatch.setitem(sys.modules, "scipy.spatial.transform", None)
    with pytest.raises(ImportError, match="needs SciPy, which is not installed"):
        r.rotation()


def test_a_table_of_results(r, tmp_path):
    top = et.example("toy-top").changed(duration_s=1)
    study = et.study(top, {"latitude_deg": [10.0, 20.0]})
    results = [et.run(top, latitude_deg=latitude) for latitude in (10.0, 20.0)]
    table = et.table(results)
    for column in study.columns.intersection(table.columns).drop("status"):
        if table[column].dtype == float:  # a study computes its points side by side, whose last digits differ
            assert np.allclose(table[column], study[column], rtol=1e-11, atol=1e-15), column  # thousands of roundings
        else:
            assert list(table[column]) == list(study[column]), column
    assert {"drift.axis_final_rad", "drift.axis_bound_rad", "drift.verdict"} <= set(table.columns)
    assert list(table["status"]) == ["completed"] * 2
    named = et.table({"a": r.save(tmp_path / "r"), "b": results[1]}, collect={"drift": "drift.axis_final_rad"})
    assert list(named.columns) == ["name", "status", "drift"] and list(named["name"]) == ["a", "b"]
    assert named["drift"][0] == r.drift.axis_final_rad
    assert len(et.table([])) == 0
    with pytest.raises(et.ScenarioError, match="no summary has 'drift.nothing'"):
        et.table(results, "drift.nothing")
