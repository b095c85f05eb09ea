# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: the program's digits, arrays, pickles, files."""

import base64
import copy
import copyreg
import json
import pickle
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import earthtop as et

FILES = ("trajectory.csv", "torques.csv", "summary.json", "drift.svg")
# Of every kind: fixed pivot, free rotor, closed form, friction, table, platform, long, a rotor in the body.
IN_SUITE = {"toy-top", "free-gyro", "dzhanibekov", "cusped-top", "toy-top-on-table", "turntable", "foucault-pendulum",
            "tumbling-gyrostat"}


def files_of(directory):
    return {name: (directory / name).read_bytes() for name in FILES if (directory / name).exists()}


@pytest.mark.parametrize("name", [pytest.param(name, marks=[] if name in IN_SUITE else [pytest.mark.long]) for name in et.examples()])
def test_same_digits_as_the_program(name, program, scenarios, tmp_path):
    subprocess.run([program, "run", scenarios / f"{name}.json", "--out", tmp_path / "program", "--quiet"], check=True)
    r = et.run(et.load(scenarios / f"{name}.json"))
    r.save(tmp_path / "python")
    expected = files_of(tmp_path / "program")
    assert expected.keys() >= {"trajectory.csv", "summary.json", "drift.svg"}
    assert files_of(tmp_path / "python") == expected
    summary = json.loads(expected["summary.json"])
    assert {"files", "checksum"} <= summary.keys()
    assert r.summary == {key: value for key, value in summary.items() if key not in ("files", "checksum")}

    # The arrays are the numbers of the file, to the last bit, and so is what a pickle and a directory give back.
    lines = expected["trajectory.csv"].decode().splitlines()
    columns = dict(zip(lines[0].split(","), zip(*(line.split(",") for line in lines[1:]))))
    seen = ["t_s"]
    for result in (r, pickle.loads(pickle.dumps(r)), et.load_result(tmp_path / "program")):
        frame = result.to_pandas().reset_index()
        assert list(frame.columns) == list(columns)
        for column, texts in columns.items():
            if column == "contact_state":
                assert list(frame[column]) == list(texts)
            else:
                numbers = np.array([float(text) if text else np.nan for text in texts])
                assert np.array_equal(frame[column].astype(float), numbers, equal_nan=True), column
                seen.append(column)
    assert len(seen) > 20


def test_arrays_are_read_only_views_with_stated_shapes():
    r = et.run(et.example("toy-top"), duration_s=1)
    n = len(r.t_s)
    assert n == 11 and r.t_s[-1] == 1
    assert r.q_LB.shape == (n, 4) and r.w_LB_B_rad_s.shape == (n, 3) and r.drift.axis_rad.shape == (n,)
    assert r.drift.reliable.dtype == bool and r.drift.reliable.all()
    for name in r.rows:
        assert not r.rows[name].flags.writeable, name
        with pytest.raises(ValueError):
            r.rows[name][0] = 0
        assert r.rows.meaning(name)
    # No copies: all of them lie in the same memory, a row apart.
    assert r.q_LB.strides[0] == r.t_s.strides[0] == r.drift.axis_rad.strides[0] > 8 * 30
    assert r.q_LB.__array_interface__["data"][0] - r.t_s.__array_interface__["data"][0] == 8
    # They outlive the result.
    q_LB, expected = r.q_LB, r.q_LB.copy()
    del r
    assert np.array_equal(q_LB, expected)
    assert np.allclose(np.linalg.norm(q_LB, axis=1), 1, atol=1e-14)


def test_numbers_of_the_drift_are_those_of_the_summary():
    r = et.run(et.example("toy-top"), duration_s=1)
    assert r.drift.axis_final_rad == r.summary["drift"]["axis_final_rad"] == r.drift.axis_rad[-1]
    assert r.verdict == r.summary["drift"]["verdict"] == "reliable"
    assert r.status == "completed"
    assert "axis_rad" in dir(r.drift) and "axis_final_rad" in dir(r.drift) and "q_LB" in dir(r)
    with pytest.raises(AttributeError, match="there is no 'axis'"):
        r.drift.axis
    with pytest.raises(AttributeError, match="table"):
        r.tip_L_m
    assert "(rows, 4)" in et.Result.q_LB.__doc__


@pytest.mark.parametrize("name", ["toy-top", "dzhanibekov"])
def test_says_of_a_drift_what_its_rows_say(name):
    r = et.run(et.example(name))
    drift = r.summary["drift"]
    intervals, reliable = drift["verdict_intervals"], drift["reliable"]
    assert r.drift.verdict_intervals == intervals and bool(intervals) == (name == "dzhanibekov")
    for t, trusted in zip(r.t_s, r.drift.reliable):
        assert trusted == (not any(t >= one["from_s"] and (one["until_s"] is None or t < one["until_s"]) for one in intervals)), t
    assert reliable["until_s"] == (intervals[0]["from_s"] if intervals else r.t_s[-1])
    last = np.flatnonzero(r.drift.reliable)[-1]
    assert reliable["at_s"] == r.t_s[last]
    assert f"after {r.t_s[last]:g} s the axis has drifted by {r.drift.axis_rad[last]:.6g} rad" in repr(r)
    assert ("later rows cannot be trusted" in repr(r)) == bool(intervals)


def test_annotations_are_the_quantities_that_there_are():
    rows = {kind.name for kind in et._arrays.ROW_KINDS}
    drift = {name[len("drift_"):] for name in rows if name.startswith("drift_")}
    assert set(et.Drift.__annotations__) == drift
    assert set(et.Result.__annotations__) == {name for name in rows if not name.startswith("drift_")}


def test_changes_by_name_by_pointer_and_by_item_are_the_same():
    top = et.example("toy-top")
    one = et.run(top, duration_s=2, spin_rad_s=210)
    two = et.run(top, {"/motion/duration_s": 2, "release/spin_rad_s": np.float64(210)})
    other = copy.copy(top)
    other["duration_s"] = 2
    other["release/spin_rad_s"] = 210
    assert np.array_equal(one.drift.axis_rad, two.drift.axis_rad)
    assert np.array_equal(one.drift.axis_rad, et.run(other).drift.axis_rad)
    assert top["motion/duration_s"] == 60, "the original is as it was"
    assert one.scenario["spin_rad_s"] == 210
    assert one.drift.axis_final_rad != et.run(top, duration_s=2).drift.axis_final_rad


def test_threads_do_not_change_a_result():
    top = et.example("toy-top")
    assert np.array_equal(et.run(top, jobs=1, duration_s=5).drift.axis_rad, et.run(top, jobs=2, duration_s=5).drift.axis_rad)


@pytest.mark.parametrize("precision, digits", [("long_double", 19), ("float128", 34)])
def test_extended_precision_is_never_rounded_silently(precision, digits, program, scenarios, tmp_path):
    mpmath = pytest.importorskip("mpmath")
    changes = {"numerics/precision": precision, "motion/duration_s": 0.5}
    r = et.run(et.example("toy-top"), changes)
    subprocess.run([program, "run", scenarios / "toy-top.json", "--out", tmp_path, "--quiet",
                    *(f"--set=/{key}={json.dumps(value)}" for key, value in changes.items())], check=True)
    lines = (tmp_path / "trajectory.csv").read_text().splitlines()
    column = lines[0].split(",").index("drift_axis_rad")
    text = lines[-1].split(",")[column]
    assert r.drift.digits("axis_rad")[-1] == text and len(text.split("e")[0]) >= digits
    number = r.drift.axis_rad[-1]
    assert isinstance(number, mpmath.mpf)
    with mpmath.workdps(60):
        assert abs(number - mpmath.mpf(text)) <= mpmath.mpf(10) ** -36 * abs(number)
        assert number != mpmath.mpf(float(text)), "it has more digits than a double"
    assert r.t_s.dtype == np.float64 and r.q_LB.shape == (len(r.t_s), 4)
    again = pickle.loads(pickle.dumps(r))
    assert (again.drift.axis_rad == r.drift.axis_rad).all() and (again.q_LB == r.q_LB).all()


def test_numerical_trouble_is_a_result():
    r = et.run(et.example("toy-top"), {"numerics/method": "abm8", "numerics/step_s": 0.1})
    assert r.status == "not_finite" == r.summary["outcome"]["status"]
    assert 2 <= len(r.t_s) < 601 and r.t_s[-1] < 60, "the rows before it are kept"
    assert not any(np.isnan(r.rows[name]).any() for name in ("t_s", "q_LB", "ref_q_LB"))
    assert pickle.loads(pickle.dumps(r)).status == "not_finite"


def test_a_ledger_gives_torques():
    r = et.run(et.example("toy-top"), {"numerics/ledger": "laboratory"}, duration_s=1)
    assert r.torques["tau_cor_N_m"].shape == (len(r.t_s), 3)
    assert np.abs(r.torques.residual_N_m).max() < 1e-12 * np.abs(r.torques.tau_phys_N_m).max()
    total = sum(r.torques[f"tau_{name}_N_m"] for name in ("phys", "cor", "trans", "cent"))
    assert np.allclose(total, r.torques.dL_dt_N_m, atol=1e-15)
    again = pickle.loads(pickle.dumps(r))
    assert np.array_equal(again.torques.tau_cor_N_m, r.torques.tau_cor_N_m)
    assert len(et.run(et.example("toy-top"), duration_s=1).torques) == 0


def test_a_top_on_a_table_has_the_contact():
    r = et.run(et.example("toy-top-on-table"), duration_s=0.5)
    assert r.tip_L_m.shape == (len(r.t_s), 2)
    assert set(r.contact_state) <= {"slide", "roll", "mixed"}
    assert np.array_equal(np.hypot(r.drift.tip_x_m, r.drift.tip_y_m) > 0, r.drift.tip_m > 0)


def test_saving_a_result_that_was_pickled(tmp_path):
    r = et.run(et.example("toy-top"), duration_s=1)
    again = pickle.loads(pickle.dumps(r))
    r.save(tmp_path / "a")
    again.save(tmp_path / "b")
    assert files_of(tmp_path / "a") == files_of(tmp_path / "b")
    other = pickle.loads(pickle.dumps(et.run(et.example("toy-top"), duration_s=2)))
    with pytest.raises(et.ScenarioError, match="another scenario"):
        other.save(tmp_path / "a")
    other.save(tmp_path / "a", force=True)
    assert len(et.load_result(tmp_path / "a").t_s) == 21
    et.load_result(tmp_path / "b").save(tmp_path / "c")
    assert files_of(tmp_path / "c") == files_of(tmp_path / "b")


@pytest.mark.parametrize("name", ["trajectory.csv", "summary.json", "timing.json", "drift.svg"])
def test_a_damaged_result_is_refused(name, tmp_path):
    et.run(et.example("toy-top"), duration_s=1).save(tmp_path)
    content = bytearray((tmp_path / name).read_bytes())
    content[len(content) // 3] ^= 1
    (tmp_path / name).write_bytes(content)
    with pytest.raises(et.ScenarioError, match=f"{name}.* is damaged"):
        et.load_result(tmp_path)


def without_checksums(directory):
    for name in ("summary.json", "timing.json"):
        document = {key: value for key, value in json.loads((directory / name).read_text()).items() if key not in ("files", "checksum")}
        (directory / name).write_text(json.dumps(document, indent=2) + "\n")


def test_results_without_checksums_warn(tmp_path):
    r = et.run(et.example("toy-top"), duration_s=1)
    r.save(tmp_path / "r")
    et.load_result(tmp_path / "r")  # warnings are errors here
    without_checksums(tmp_path / "r")
    with pytest.warns(et.UnverifiedWarning, match="r has no checksums: damage to it would go unnoticed") as caught:
        again = et.load_result(tmp_path / "r")
    assert [Path(one.filename).name for one in caught] == ["test_run.py"], "of the caller's line"
    assert np.array_equal(again.q_LB, r.q_LB)
    with pytest.warns(et.UnverifiedWarning, match="r has no checksums"):
        et.report(tmp_path / "r", tmp_path / "page.html")
    assert "Note: " in (tmp_path / "page.html").read_text()


def test_a_timing_of_another_result_is_refused(tmp_path):
    for latitude in (10, 20):
        et.run(et.example("toy-top"), duration_s=1, latitude_deg=latitude).save(tmp_path / str(latitude))
    (tmp_path / "10/timing.json").write_bytes((tmp_path / "20/timing.json").read_bytes())
    with pytest.raises(et.ScenarioError, match="timing.json.* belongs to another result"):
        et.load_result(tmp_path / "10")


def test_a_damaged_pickle_is_refused():
    r = et.run(et.example("toy-top"), duration_s=1)
    good = pickle.dumps(r)
    digit = good.index(r._files["trajectory.csv"].splitlines()[3].encode()) + 20
    for at in (digit, digit + 1, len(good) // 2, len(good) // 4):
        damaged = bytearray(good)
        damaged[at] ^= 1
        with pytest.raises(et.ScenarioError, match="the pickle is damaged: it is not what was written; make it anew"):
            pickle.loads(bytes(damaged))


class _AsOlder:
    """Is pickled as an older earthtop has pickled an object: its class and its state."""

    def __init__(self, made):
        self._made = made

    def __reduce__(self):
        return copyreg._reconstructor, (type(self._made), object, None), self._made.__getstate__()


def test_pickles_of_an_older_earthtop_are_read_with_a_warning():
    r = et.run(et.example("toy-top"), duration_s=1)
    for made in (r, et.explain(et.example("toy-top"), duration_s=1)):
        with pytest.warns(et.UnverifiedWarning, match="the pickle has no checksum: damage"):
            again = pickle.loads(pickle.dumps(_AsOlder(made)))
        assert repr(again) == repr(made)


def test_a_copy_of_a_result_is_the_same():
    r = et.run(et.example("toy-top"), duration_s=1)
    for again in (copy.copy(r), copy.deepcopy(r)):
        assert np.array_equal(again.q_LB, r.q_LB) and again.summary == r.summary


def test_pictures_of_files_are_shown_as_images(tmp_path):
    et.run(et.example("toy-top"), duration_s=1).save(tmp_path)
    without_checksums(tmp_path)
    (tmp_path / "drift.svg").write_text("<svg onload='alert(1)'><script>alert(2)</script></svg>")
    with pytest.warns(et.UnverifiedWarning):
        r = et.load_result(tmp_path)
    html = r._repr_html_()
    assert r.svg.startswith("<svg onload") and "alert" not in html and "<script" not in html and "<svg" not in html
    assert base64.b64decode(re.search('src="data:image/svg[+]xml;base64,([^"]*)"', html)[1]).decode() == r.svg


def test_errors_of_files(tmp_path):
    with pytest.raises(et.ScenarioError, match="no-such-file.json"):
        et.load(tmp_path / "no-such-file.json")
    with pytest.raises(et.ScenarioError, match="no summary.json"):
        et.load_result(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(et.Error):
        et.run(et.example("toy-top"), duration_s=1).save(tmp_path / "file")


def test_picture_and_headline():
    r = et.run(et.example("toy-top"), duration_s=1)
    html = r._repr_html_()
    assert "toy-top: after 1 s" in html and f"{r.drift.axis_final_rad:.6g}" in html and 'src="data:image/svg+xml;base64,' in html


def test_plot_of_files_has_rows_alone(tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    et.run(et.example("toy-top"), duration_s=1).save(tmp_path / "r")
    r = et.load_result(tmp_path / "r")
    ax = r.plot()
    assert np.array_equal(ax.lines[0].get_ydata(), r.drift.axis_rad) and ax.get_title() == "toy-top, at its output rows"
    matplotlib.pyplot.close("all")


def test_plot_of_many_swings_has_a_band():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    r = et.run(et.example("toy-top"), duration_s=600, output_step_s=600)
    ax = r.plot("drift_tilt_rad")
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["least to most"]
    band = ax.collections[0].get_paths()[0].vertices[:, 1]
    assert max(abs(band)) == pytest.approx(r.drift.tilt_max_rad, rel=0.05)
    matplotlib.pyplot.close("all")


def test_plot():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    r = et.run(et.example("toy-top"), duration_s=1, output_step_s=1)
    ax = r.plot()
    drawn = ax.lines[0].get_ydata()
    # The swings of 0.1057 s are drawn, twelve points each or more, though there is no row but the last.
    assert len(r.t_s) == 2 and len(drawn) > 12 / 0.1057 and drawn[-1] == r.drift.axis_rad[-1]
    assert max(drawn) == pytest.approx(r.drift.axis_max_rad, rel=0.02) and ax.get_xlabel() == "time (s)"
    assert len(r.plot("q_LB", ax=ax).lines) == 5
    with pytest.raises(et.ScenarioError, match="there is no quantity"):
        r.plot("axis")
    matplotlib.pyplot.close("all")
