# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: the program's numbers, resumption, threads, bad input."""

import contextlib
import copy
import json
import pickle
import sqlite3
import subprocess
import threading

import numpy as np
import pytest

import earthtop as et

pandas = pytest.importorskip("pandas")


@pytest.fixture
def top(scenarios):
    return et.load(scenarios / "toy-top.json").changed(duration_s=0.5)


def run_program(program, study, directory, *more):
    file = directory / "study.json"
    file.write_text(json.dumps(study))
    command = [program, "study", file, "--out", directory / "out", "--quiet", *more]
    assert subprocess.run(command, stderr=subprocess.DEVNULL, check=False).returncode in (0, 1)
    return pandas.read_csv(directory / "out/study.csv", float_precision="round_trip"), json.loads(
        (directory / "out/study.json").read_text())


def bits(values):
    return np.asarray(values, dtype=float).view(np.int64).tolist()


def test_a_grid_has_the_bits_and_the_document_of_the_program(program, scenarios, top, tmp_path):
    latitudes = np.linspace(-90, 90, 5) / 3
    expected, document = run_program(program, {
        "name": "toy-top", "base": str(scenarios / "toy-top.json"), "set": {"/motion/duration_s": 0.5},
        "axes": [{"pointer": "/site/latitude_deg", "values": latitudes.tolist()},
                 {"pointer": "/release/tilt_deg", "values": [10, 20, 200]}],
        "collect": ["drift.axis_final_rad", "drift.verdict", "solution.steps_accepted"]}, tmp_path)
    frame = et.study(top, {"latitude_deg": latitudes, "release/tilt_deg": [10, 20, 200]},
                     collect=["drift.axis_final_rad", "drift.verdict", "solution.steps_accepted"], out=tmp_path / "ours",
                     jobs=2)
    assert list(frame.columns) == list(expected.columns)
    for name in ("latitude_deg", "tilt_deg", "drift.axis_final_rad", "solution.steps_accepted"):
        assert frame[name].dtype == np.float64
        assert bits(frame[name]) == bits(expected[name])
    assert frame["point"].dtype == np.int64 and frame["point"].tolist() == list(range(15))
    assert frame["status"].tolist() == expected["status"].tolist()
    assert frame["reason"].tolist() == expected["reason"].fillna("").tolist()
    refused = frame[frame["tilt_deg"] == 200]
    assert (refused["status"] == "refused").all() and refused["reason"].str.contains("/release/tilt_deg").all()
    assert refused["drift.axis_final_rad"].isna().all() and refused["drift.verdict"].isna().all()
    assert frame.attrs["study"] == document
    assert (tmp_path / "ours/study.csv").read_bytes() == (tmp_path / "out/study.csv").read_bytes()
    assert (tmp_path / "ours/study.json").read_bytes() == (tmp_path / "out/study.json").read_bytes()
    pandas.testing.assert_frame_equal(et.load_study(tmp_path / "out"), frame)
    pandas.testing.assert_frame_equal(et.load_study(tmp_path / "out/study.sqlite"), frame)


def test_drawn_designs_linked_keys_and_names(program, scenarios, top, tmp_path):
    expected, _ = run_program(program, {
        "name": "drawn", "base": str(scenarios / "toy-top.json"), "set": {"/motion/duration_s": 0.5},
        "design": {"kind": "latin_hypercube", "points": 6, "seed": 7},
        "axes": [{"pointer": "/release/tilt_deg", "range": {"from": 5, "to": 60}},
                 {"name": "both", "pointers": ["/release/spin_rad_s", "/release/azimuth_deg"],
                  "values": [[200, 0], [300, 45]]}],
        "collect": [{"name": "drift", "path": "drift.axis_final_rad"}]}, tmp_path)
    frame = et.study(top, {"tilt_deg": (5, 60),
                           ("spin_rad_s", "release/azimuth_deg"): {"name": "both", "values": np.array([[200, 0], [300, 45]])}},
                     design="latin_hypercube", points=6, seed=7, collect={"drift": "drift.axis_final_rad"})
    assert list(frame.columns) == ["point", "tilt_deg", "both", "drift", "status", "reason"]
    for name in ("tilt_deg", "both", "drift"):
        assert bits(frame[name]) == bits(expected[name])
    assert frame.attrs["store"] is None


def test_in_a_grid_a_pair_is_two_values_and_a_mapping_a_range(top):
    frame = et.study(top, {"tilt_deg": (5, 60), "latitude_deg": {"from": 0, "to": 90, "points": 3}}, collect="drift.verdict")
    assert frame["tilt_deg"].tolist() == [5, 5, 5, 60, 60, 60]
    assert frame["latitude_deg"].tolist() == [0, 45, 90] * 2


def test_flags_and_mixed_values(top):
    frame = et.study(top, {"effects/coriolis": [True, False], "release/precession": ["none", "steady_slow"],
                           "output_step_s": pandas.Series([0.5, 0.25])}, collect=["drift.verdict"])
    assert frame["coriolis"].dtype == bool and frame["coriolis"].tolist() == [True] * 4 + [False] * 4
    assert frame["precession"].tolist() == ["none", "none", "steady_slow", "steady_slow"] * 2
    mixed = et.study(top, {"numerics/method": ["taylor"], "release/precession": ["none", {"rate_rad_s": 1}]})
    assert mixed["precession"].tolist() == ["none", '{"rate_rad_s":1.0}']


def test_study_files_texts_and_dictionaries(scenarios, top, tmp_path):
    document = {"name": "three", "base": top.to_dict(), "axes": [{"pointer": "/site/latitude_deg", "values": [0, 30, 60]}]}
    (tmp_path / "three.json").write_text(json.dumps(document))
    frames = [et.study(given) for given in (document, json.dumps(document), tmp_path / "three.json", {**document, "base": top})]
    for frame in frames[1:]:
        pandas.testing.assert_frame_equal(frame, frames[0])
    assert frames[0].attrs["study"]["name"] == "three"
    pandas.testing.assert_frame_equal(frames[0], et.study(top, {"latitude_deg": [0, 30, 60]}))


def test_the_changes_of_a_scenario_are_those_of_the_base(top):
    frame = et.study(top.changed(spin_rad_s=250.25, tilt_deg=15), {"tilt_deg": [15, 20]},
                     collect=["scenario.release.spin_rad_s", "scenario.motion.duration_s", "drift.axis_final_rad"])
    assert frame["scenario.release.spin_rad_s"].tolist() == [250.25] * 2
    assert frame["scenario.motion.duration_s"].tolist() == [0.5] * 2
    alone = et.run(top, spin_rad_s=250.25, tilt_deg=15).drift.axis_final_rad
    assert frame["drift.axis_final_rad"][0] == pytest.approx(alone, rel=1e-12)  # points are computed side by side


def test_files_beside_the_base_are_found(scenarios, tmp_path):
    table = "".join(f"{0.1 * i},{0.01 * i * i}\n" for i in range(20))
    (tmp_path / "motion.csv").write_text("t_s,angle_rad\n" + table)
    content = et.load(scenarios / "toy-top.json").changed(duration_s=0.5).to_dict()
    content["platform"] = {"motion": "table", "file": "motion.csv", "axis": [0, 0, 1]}
    (tmp_path / "turned.json").write_text(json.dumps(content))
    frame = et.study(tmp_path / "turned.json", {"latitude_deg": [0, 45]})
    assert frame["status"].tolist() == ["completed"] * 2


def test_the_document_is_shared_by_derived_frames(top):
    frame = et.study(top, {"latitude_deg": [0, 45]})
    assert copy.deepcopy(frame.attrs)["study"] is frame.attrs["study"]
    again = pickle.loads(pickle.dumps(frame))
    pandas.testing.assert_frame_equal(again, frame)
    assert again.attrs["study"] == frame.attrs["study"]


@pytest.mark.parametrize("arguments, message", [
    (dict(axes={"latitude": [1]}), "did you mean"),
    (dict(axes={"latitude_deg": 3}), "a list, an array or a range"),
    (dict(axes={"latitude_deg": []}), "array of values"),
    (dict(axes={}), "axes"),
    (dict(axes={"latitude_deg": [float("nan")]}), "finite"),
    (dict(axes={"latitude_deg": [1], "/site/latitude_deg": [2]}), "varied twice"),
    (dict(axes={"latitude_deg": [1, 2]}, collect=["drift.axis_final"]), "drift.axis_final"),
    (dict(axes={"latitude_deg": [1, 2]}, collect=[]), "collect"),
    (dict(axes={"latitude_deg": [1, 2]}, design="latin"), "latin_hypercube"),
    (dict(axes={"latitude_deg": (1, 2)}, design="random"), "points"),
    (dict(axes={"latitude_deg": [1, 2]}, points=4), "grid"),
    (dict(axes={"latitude_deg": [1, 2]}, colect=["drift.verdict"]), "colect"),
    (dict(axes={"latitude_deg": [1, 2]}, jobs=0), "jobs"),
    (dict(axes={"tilt_deg": [190, 200]}), "190 is out of range"),
    (dict(axes={"latitude_deg": {"from": 0, "to": 90, "points": 20_000_000}}), "20000000 points"),
    (dict(), "needs axes"),
])
def test_bad_input_is_refused_with_findings(top, arguments, message):
    with pytest.raises(et.ScenarioError) as caught:
        et.study(top, **arguments)
    assert caught.value.findings and message in str(caught.value)
    assert "--" not in str(caught.value).replace("(from --set)", "")


def test_refusals_of_files_and_stores(top, tmp_path):
    with pytest.raises(et.ScenarioError, match="missing.json"):
        et.study(tmp_path / "missing.json")
    with pytest.raises(et.ScenarioError, match="no such store"):
        et.load_study(tmp_path / "missing")
    with pytest.raises(et.ScenarioError, match="belongs to a study"):
        et.study({"axes": []}, collect=["drift.verdict"])
    (tmp_path / "text.sqlite").write_text("nothing")
    with pytest.raises(et.ScenarioError, match="not a study's store"):
        et.load_study(tmp_path / "text.sqlite")
    et.study(top, {"latitude_deg": [0]}, out=tmp_path / "out")
    with pytest.raises(et.ScenarioError, match="another study.*force=True"):
        et.study(top, {"latitude_deg": [1]}, out=tmp_path / "out")
    assert et.study(top, {"latitude_deg": [1]}, out=tmp_path / "out", force=True)["latitude_deg"].tolist() == [1]
    (tmp_path / "file").write_text("")
    with pytest.raises((et.FileError, et.ScenarioError), match="file"):
        et.study(top, {"latitude_deg": [0]}, out=tmp_path / "file")


def test_nothing_is_left_behind_without_out(top, tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    et.study(top, {"latitude_deg": [0, 10]})
    with pytest.raises(et.ScenarioError):
        et.study(top, {"tilt_deg": [200]})
    assert list(tmp_path.iterdir()) == []


def test_two_studies_at_once(top, tmp_path):
    axes = {"latitude_deg": list(range(40))}
    alone = et.study(top, axes)
    frames = [None, None]
    threads = [threading.Thread(target=lambda i=i: frames.__setitem__(i, et.study(top, axes, jobs=2))) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for frame in frames:
        pandas.testing.assert_frame_equal(frame, alone)


def test_one_store_is_written_by_one_study(top, tmp_path):
    began, may_end = threading.Event(), threading.Event()

    def progress(share, phase):
        began.set()
        may_end.wait(60)

    axes = {"latitude_deg": np.linspace(-60, 60, 2000)}
    work = threading.Thread(target=lambda: et.study(top, axes, out=tmp_path, jobs=1, progress=progress))
    work.start()
    try:
        assert began.wait(60)
        with pytest.raises(et.ScenarioError, match="is in use by process .* choose another out$"):
            et.study(top, axes, out=tmp_path)
    finally:
        may_end.set()
        work.join()
    assert len(et.load_study(tmp_path)) == 2000


def test_progress_is_told(top):
    told = []
    et.study(top, {"latitude_deg": np.linspace(-60, 60, 400)}, jobs=1, progress=lambda *what: told.append(what))
    shares = [share for share, _ in told]
    assert shares and shares == sorted(shares) and 0 <= shares[0] and shares[-1] <= 1
    assert {phase for _, phase in told} <= {"", "points"}


def test_an_interrupted_study_goes_on(tmp_path, interrupted):
    points = 1200
    work = ("et.study(et.example('toy-top').changed(duration_s=20, output_step_s=20), "
            "{'latitude_deg': {'from': -80, 'to': 80, 'points': int(sys.argv[2])}}, out=sys.argv[1], jobs=2, "
            "progress=lambda share, phase: print(share, flush=True))")
    interrupted(work, lambda process: float(process.stdout.readline()) >= 0.1, tmp_path / "out", points)
    part = et.load_study(tmp_path / "out")
    assert 0 < len(part) < points
    assert part.attrs["study"]["points_computed"] == len(part) and (part["status"] == "completed").all()

    # What the store has is not computed again: a trigger would refuse it, and is there to the end.
    with contextlib.closing(sqlite3.connect(tmp_path / "out/study.sqlite")) as database:
        database.execute("CREATE TRIGGER again BEFORE INSERT ON point WHEN EXISTS (SELECT 1 FROM point WHERE number = NEW.number) "
                         "BEGIN SELECT RAISE(ABORT, 'computed again'); END")
    top = et.example("toy-top").changed(duration_s=20, output_step_s=20)
    axes = {"latitude_deg": {"from": -80, "to": 80, "points": points}}
    whole = et.study(top, axes, out=tmp_path / "out")
    assert len(whole) == points
    with contextlib.closing(sqlite3.connect(tmp_path / "out/study.sqlite")) as database:
        assert database.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall() == [("again",)]
    pandas.testing.assert_frame_equal(whole.iloc[part["point"]].reset_index(drop=True), part)
    assert not list((tmp_path / "out").glob("*.lock"))


def test_a_damaged_store_is_refused_and_repaired(top, tmp_path):
    axes = {"latitude_deg": np.linspace(-60, 60, 5)}
    whole = et.study(top, axes, out=tmp_path)
    with contextlib.closing(sqlite3.connect(tmp_path / "study.sqlite")) as database:
        database.execute('UPDATE point SET "drift.axis_final_rad" = 1 WHERE number = 3')
        database.commit()
    with pytest.raises(et.ScenarioError, match="of 5 points 1 [(]3[)] .*study.* with repair"):
        et.load_study(tmp_path)
    with pytest.raises(et.ScenarioError, match="of 5 points 1 [(]3[)]"):
        et.study(top, axes, out=tmp_path)
    pandas.testing.assert_frame_equal(et.study(top, axes, out=tmp_path, repair=True), whole)
    pandas.testing.assert_frame_equal(et.load_study(tmp_path), whole)


@pytest.mark.long
def test_a_study_costs_what_it_costs_the_program(program, scenarios, tmp_path):
    import resource

    def seconds(who):
        usage = resource.getrusage(who)
        return usage.ru_utime + usage.ru_stime

    study = {"name": "thousand", "base": str(scenarios / "toy-top.json"),
             "set": {"/motion/duration_s": 1, "/motion/output_step_s": 1},
             "axes": [{"pointer": "/site/latitude_deg", "range": {"from": -60, "to": 60, "points": 40}},
                      {"pointer": "/release/spin_rad_s", "range": {"from": 200, "to": 400, "points": 25}}]}
    (tmp_path / "thousand.json").write_text(json.dumps(study))
    theirs, ours = [], []
    for i in range(8):
        before = seconds(resource.RUSAGE_CHILDREN)
        command = [program, "study", tmp_path / "thousand.json", "--out", tmp_path / f"theirs{i}", "--jobs", "1", "--quiet"]
        subprocess.run(command, check=True)
        theirs.append(seconds(resource.RUSAGE_CHILDREN) - before)
        before = seconds(resource.RUSAGE_SELF)
        assert len(et.study(tmp_path / "thousand.json", out=tmp_path / f"ours{i}", jobs=1)) == 1000
        ours.append(seconds(resource.RUSAGE_SELF) - before)
    assert min(ours[1:]) < 1.1 * min(theirs)  # the first call imports pandas
