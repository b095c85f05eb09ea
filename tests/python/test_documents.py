# SPDX-License-Identifier: GPL-3.0-or-later
"""explain, compare and report: the program's documents."""

import contextlib
import json
import pickle
import sqlite3
import subprocess
import xml.dom.minidom

import pytest

import earthtop as et

pandas = pytest.importorskip("pandas")


@pytest.fixture(scope="module")
def results():
    top = et.example("toy-top").changed(duration_s=2, output_step_s=0.1)
    return et.run(top), et.run(top, tilt_deg=20.001)


@pytest.fixture
def printed(program):
    """What the program prints with --json."""

    def run(*arguments):
        command = [program, *map(str, arguments), "--json"]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False).stdout

    return run


# explain --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["toy-top", "southern-hemisphere", "free-gyro", "foucault-pendulum", "toy-top-on-table"])
def test_an_explanation_is_the_programs(printed, scenarios, name):
    assert et.explain(et.example(name)).text == printed("explain", scenarios / f"{name}.json")


def test_effects_are_chosen_first_where_the_scenario_leaves_that_open(printed, scenarios):
    changes = {"/effects": {"select": "auto"}, "/accuracy/drift_rad": 1e-12, "/motion/duration_s": 5}
    sets = [word for pointer, value in changes.items() for word in ("--set", f"{pointer}={json.dumps(value)}")]
    explained = et.explain(scenarios / "toy-top.json", changes)
    assert explained.text == printed("explain", scenarios / "toy-top.json", *sets)
    assert explained.effects.loc["gravity_gradient", "modelled"]
    assert not et.explain(scenarios / "toy-top.json", duration_s=5).effects.loc["gravity_gradient", "modelled"]


def test_the_tables_of_an_explanation():
    explained = et.explain(et.example("toy-top"), duration_s=5, latitude_deg=90)
    effects, inputs = explained.effects, explained.inputs
    assert effects.loc["coriolis", "modelled"] and not effects.loc["tide", "modelled"]
    assert effects["drift_rad"].dtype == float and effects.loc["platform_motion", ["drift_rad"]].isna().all()
    assert effects["name"].tolist() == [one["name"] for one in explained.document["effects"]]
    assert inputs.loc["latitude_deg", "value"] == 90 and inputs.loc["spin_rad_s", "hides_earth"] > 0
    assert explained.method == "taylor" and "coriolis" in repr(explained) and "<table" in explained._repr_html_()
    on_table = et.explain(et.example("toy-top-on-table"), duration_s=1)
    assert on_table.effects.loc["friction", "force_largest_N"] > 0.1
    assert on_table.inputs.loc["table_tilt", "step"] == "1 arcsec" and "friction" in repr(on_table)


def test_a_refused_scenario_is_not_explained():
    with pytest.raises(et.ScenarioError, match="/release/tilt_deg"):
        et.explain(et.example("toy-top"), tilt_deg=200)


# compare --------------------------------------------------------------------------------------------------------------------


def test_a_comparison_is_the_programs(printed, results, tmp_path):
    places = [result.save(tmp_path / name) for result, name in zip(results, ("a", "b"))]
    compared = et.compare(*places)
    assert compared.text == printed("compare", *places)
    assert et.compare(*places, profile="physics", may_change="/", may_lack_rows=True, steps_ratio=1.5).text == printed(
        "compare", *places, "--profile", "physics", "--allow-change", "/", "--allow-missing", "--max-steps-ratio", 1.5)
    of_objects = et.compare(*results)
    assert not compared.passed and of_objects.verdict == "differs"
    assert of_objects.document["reference"] == "toy-top (reference)" and of_objects.document["new"] == "toy-top (new)"
    for text in (of_objects.text, of_objects.svg, of_objects.junit):
        assert "/tmp" not in text and "earthtop-" not in text.replace("earthtop-comparison-1.json", "")
    left_out = ["reference", "new"]
    for pair, pair_of_paths in zip(of_objects.document["pairs"], compared.document["pairs"]):
        assert {k: v for k, v in pair.items() if k not in left_out + ["cost"]} == {
            k: v for k, v in pair_of_paths.items() if k not in left_out + ["cost"]}


def test_what_a_comparison_tells(results):
    reference, new = results
    same = et.compare(reference, reference)
    assert same and same.passed and same.verdict == "same" and repr(same).startswith("<earthtop.Comparison same")
    differs = et.compare(reference, new)
    assert not differs and "/release/tilt_deg" in repr(differs)
    quantities = differs.quantities.set_index("name")
    assert not quantities.loc["axis_rad", "passed"]
    assert quantities.loc["axis_rad", "largest_difference"] > quantities.loc["axis_rad", "tolerance"] > 0
    assert quantities["violations"].dtype == "int64"
    assert "<svg" in differs.svg and "<testsuite" in differs.junit and 'src="data:image/svg+xml;base64,' in differs._repr_html_()
    assert et.compare(reference, new, may_change="release/tilt_deg", tolerances={
        "quantities": {name: {"absolute": 1} for name in quantities.index[~quantities["passed"]]}}).passed


def test_runs_of_unlike_lengths_are_compared_up_to_their_common_end():
    top = et.example("toy-top")
    brief, longer = (et.run(top.changed(duration_s=t)) for t in (1, 2))
    for pair in ((brief, longer), (longer, brief)):
        compared = et.compare(*pair, may_change="/motion", may_lack_rows=True)
        assert compared and compared.document["pairs"][0]["common_end_s"] == 1
        assert "compared up to t = 1 s, the end of the shorter run" in compared._repr_html_()
        assert compared.left_out["drift.axis_max_rad"].startswith("a figure of a whole run")
        assert "drift.axis_final_rad" in set(compared.quantities["name"])
    assert et.compare(brief, brief).left_out == {} and not et.compare(brief, longer)


def test_pickled_results_compare_the_same(results):
    again = pickle.loads(pickle.dumps(results[0]))
    assert et.compare(results[0], again, profile="bitwise").passed


def test_studies_compare(tmp_path):
    top = et.example("toy-top").changed(duration_s=0.5)
    frames = [et.study(top.changed(spin_rad_s=spin), {"latitude_deg": [0, 30]}, out=tmp_path / str(spin))
              for spin in (200, 201)]
    assert et.compare(frames[0], tmp_path / "200").passed
    assert not et.compare(frames[0], frames[1]).passed
    with pytest.raises(et.ScenarioError, match="out=DIRECTORY"):
        et.compare(frames[0], et.study(top, {"latitude_deg": [0, 30]}))


@pytest.mark.parametrize("options, message", [
    (dict(profile="loose"), "regression"),
    (dict(may_change="latitude"), "did you mean"),
    (dict(tolerances={"quantities": {"axis_rad": {"absolut": 1}}}), "tolerances.*absolut"),
    (dict(tolerances="missing.json"), "missing.json"),
    (dict(mapping={"columns": {}}), "mapping"),
])
def test_bad_options_of_a_comparison(results, options, message):
    with pytest.raises(et.ScenarioError, match=message) as caught:
        et.compare(*results, **options)
    assert "/tmp" not in str(caught.value) and "--" not in str(caught.value)


def test_what_cannot_be_compared(results, tmp_path):
    with pytest.raises(et.ScenarioError, match="nothing-there"):
        et.compare(results[0], tmp_path / "nothing-there")
    place = results[1].save(tmp_path / "cut")
    (place / "trajectory.csv").write_text((place / "trajectory.csv").read_text()[:-20])
    with pytest.raises(et.ScenarioError, match="trajectory.csv"):
        et.compare(results[0], place)


# report ---------------------------------------------------------------------------------------------------------------------


def page_of(program, what, page):
    subprocess.run([program, "report", str(what), "--out", str(page), "--quiet"], check=True)
    return page.read_text()


def test_pages_are_the_programs(program, results, tmp_path):
    place = results[0].save(tmp_path / "toy-top")
    assert et.report(place) == place / "report.html"
    assert (place / "report.html").read_text() == page_of(program, place, tmp_path / "theirs.html")
    page = et.report(results[0], tmp_path / "ours.html", svg=True)
    assert page == tmp_path / "ours.html" and "/tmp" not in page.read_text()
    assert [picture.name for picture in sorted(tmp_path.glob("ours-*.svg"))] != []
    compared = et.compare(place, place)
    file = compared.save(tmp_path / "compared.json")
    theirs = page_of(program, file, tmp_path / "theirs.html")
    for what in (compared, compared.document, file):
        assert et.report(what, tmp_path / "ours.html").read_text() == theirs
    assert et.report(file) == tmp_path / "compared.html"


def test_the_page_of_a_study(program, tmp_path):
    frame = et.study(et.example("toy-top").changed(duration_s=0.5), {"latitude_deg": [0, 30, 60]}, out=tmp_path / "study")
    theirs = page_of(program, tmp_path / "study", tmp_path / "theirs.html")
    for what in (frame, tmp_path / "study"):
        assert et.report(what, tmp_path / "ours.html").read_text() == theirs


def test_what_has_no_page(results, tmp_path):
    with pytest.raises(et.ScenarioError, match="where the page"):
        et.report(results[0])
    with pytest.raises(et.ScenarioError, match="no document"):
        et.report(et.explain(et.example("toy-top"), duration_s=1), tmp_path / "page.html")
    with pytest.raises(et.ScenarioError, match="nothing-there"):
        et.report(tmp_path / "nothing-there")
    (tmp_path / "data.csv").write_text("1\n")
    with pytest.raises(et.ScenarioError, match="not as earthtop.report wrote it; give another name, or force=True"):
        et.report(results[0], tmp_path / "data.csv")
    assert (tmp_path / "data.csv").read_text() == "1\n"
    with pytest.raises(et.FileError):
        et.report(results[0], "/proc/page.html")


def test_names_of_results_are_text_wherever_they_go(results, tmp_path):
    """A result is called by the name in its summary, which another may have written."""
    name = "\"<script>alert(1)</script>'&"
    hostile = pickle.loads(pickle.dumps(results[0]))
    hostile.summary["name"] = name
    compared = et.compare(hostile, results[1])
    assert compared.document["reference"] == f"{name} (reference)" and json.loads(compared.text) == compared.document
    for text in (compared.svg, compared.junit, compared._repr_html_()):
        assert "<script" not in text
    xml.dom.minidom.parseString(compared.junit)
    page = et.report(compared, tmp_path / "page.html")  # its checksum is right
    assert "<script>alert" not in page.read_text()


def test_a_study_without_checksums_warns(tmp_path):
    et.study(et.example("toy-top").changed(duration_s=1), {"latitude_deg": [10, 20]}, out=tmp_path)
    et.load_study(tmp_path)
    with contextlib.closing(sqlite3.connect(tmp_path / "study.sqlite")) as store, store:
        store.execute("ALTER TABLE point DROP COLUMN row_checksum")
        store.execute("DELETE FROM study WHERE key IN ('facts_checksum', 'contents')")
    with pytest.warns(et.UnverifiedWarning, match="study.sqlite has no checksums"):
        assert len(et.load_study(tmp_path)) == 2
    with pytest.warns(et.UnverifiedWarning, match="study.sqlite has no checksums"):
        et.report(tmp_path, tmp_path / "page.html")


def test_documents_pickle(results):
    for one in (et.compare(*results), et.explain(et.example("toy-top"), duration_s=1)):
        len(one.document)
        again = pickle.loads(pickle.dumps(one))
        assert (again.text, again.svg, repr(again)) == (one.text, one.svg, repr(one))
