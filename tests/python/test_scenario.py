# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenarios: what is accepted, what is refused and with which words."""

import copy
import json
import pickle
import random
import subprocess

import numpy as np
import pytest

import earthtop as et
from earthtop._scenario import pointer_of

BODY = {"mass_kg": 0.1, "center_of_mass_m": [0, 0, 0.04],
        "inertia": {"about": "pivot", "principal_kg_m2": [2e-4, 2e-4, 5e-5]}}
SMALL = {"site": {"latitude_deg": 48}, "body": BODY, "release": {"tilt_deg": 10, "spin_rad_s": 200},
         "motion": {"duration_s": 1, "output_step_s": 0.1}}


def places(tree, pointer=""):
    """The JSON pointers of everything in a document."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in items:
        yield f"{pointer}/{key}"
        yield from places(value, f"{pointer}/{key}")


def bad_texts(scenarios, count=120):
    """Scenarios with one thing wrong, drawn at random: wrong kinds, wild numbers, misspelt keys, cut texts."""
    draw = random.Random(20)
    files = sorted(scenarios.glob("*.json"))
    wrong = [None, True, "x", -1, 0, 1e300, -1e300, [], {}, [1, 2], "NaN", 1e-320, "\u202e", 3.5]
    while count > 0:
        text = draw.choice(files).read_text()
        kind = draw.randrange(5)
        if kind == 0:
            text = text[: draw.randrange(len(text))]
        elif kind == 1:
            at = draw.randrange(len(text))
            text = text[:at] + draw.choice("}{],:\x00\"e\\7") + text[at + 1:]
        else:
            tree = json.loads(text)
            *way, last = draw.choice([one for one in places(tree)]).split("/")[1:]
            node = tree
            for step in way:
                node = node[int(step)] if isinstance(node, list) else node[step]
            last = int(last) if isinstance(node, list) else last
            if kind == 2 and isinstance(node, dict):
                node[last + "x"] = node.pop(last)
            elif kind == 3:
                del node[last]
            else:
                node[last] = draw.choice(wrong)
            text = json.dumps(tree, indent=1)
        yield text
        count -= 1


def test_bad_inputs_give_the_same_findings_as_the_program(program, scenarios, tmp_path):
    texts = list(bad_texts(scenarios))
    paths = []
    for i, text in enumerate(texts):
        paths.append(tmp_path / f"{i}.json")
        paths[-1].write_bytes(text.encode())
    printed = subprocess.run([program, "check", "--json", *paths], stdout=subprocess.PIPE, check=False).stdout
    document = json.loads(printed)
    refused = 0
    for path, text in zip(paths, texts):
        for kind in ("errors", "warnings"):
            expected = [(one["line"], one["column"], one["pointer"], one["message"])
                        for one in document[kind] if one["file"] == str(path)]
            for check in (et.check(text), et.check(path)):
                assert [(one.line, one.column, one.pointer, one.message) for one in getattr(check, kind)] == expected
        if not et.check(path):
            refused += 1
            with pytest.raises(et.ScenarioError) as caught:
                et.load(path)
            assert caught.value.findings == et.check(path).errors
            assert all(one.path == str(path) for one in caught.value.findings)
    assert refused >= 80


def test_a_dictionary_is_a_scenario():
    top = et.Scenario(SMALL)
    assert top["site/latitude_deg"] == 48 and top["/release/tilt_deg"] == 10 and top["mass_kg"] == 0.1
    assert top["numerics/method"] == "auto", "a default that is not given"
    assert top["body/center_of_mass_m"] == [0, 0, 0.04] and top["body/center_of_mass_m/2"] == 0.04
    top["body/center_of_mass_m/2"] = np.float32(0.5)
    top["principal_kg_m2"] = np.array([0.1, 0.1, 0.02])
    assert et.Scenario(top.to_dict()) == top != et.Scenario(SMALL)
    assert top.top["mass_kg"] == 0.1
    with pytest.raises(KeyError):
        top["site/longitude"]


def test_numbers_keep_their_bits():
    draw = random.Random(5)
    top = et.Scenario(SMALL)
    for _ in range(50):
        value = draw.uniform(-90, 90)
        top["latitude_deg"] = value
        assert json.loads(top.canonical)["site"]["latitude_deg"] == value == et.Scenario(top.text)["latitude_deg"]


def test_what_is_refused_says_where():
    with pytest.raises(et.ScenarioError) as caught:
        et.Scenario({**SMALL, "site": {"latitude_deg": 100}})
    assert [one.pointer for one in caught.value.findings] == ["/site/latitude_deg"]
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, et.Error)
    assert pickle.loads(pickle.dumps(caught.value)).findings == caught.value.findings
    top = et.Scenario(SMALL)
    top["latitude_deg"] = 100  # may be put right by the next line
    assert not top.check() and "100" in str(top.check())
    with pytest.raises(et.ScenarioError, match="/site/latitude_deg"):
        et.run(top)
    top["latitude_deg"] = 10
    assert top.check()
    with pytest.raises(et.ScenarioError, match='did you mean "/site/latitude_deg"'):
        top["latitud_deg"] = 3
    with pytest.raises(et.ScenarioError, match="no rim or edge rolls on the table"):
        top["rim_radius_m"] = 0.03
    with pytest.raises(et.ScenarioError, match="give /body/mass_kg; 1 g = 0.001 kg"):
        top["mass_g"] = 3
    with pytest.raises(et.ScenarioError, match="earthtop.load"):
        et.Scenario("toy-top.json")
    with pytest.raises(TypeError):
        et.Scenario({**SMALL, "title": object()})
    with pytest.raises(ValueError):
        top["latitude_deg"] = float("nan")


def test_the_spin_in_another_unit_replaces_it(tmp_path):
    top = et.Scenario(SMALL)
    top["spin_rpm"] = 6000
    assert abs(top["spin_rad_s"] - 200 * np.pi) < 1e-12 and "spin_rad_s" not in top.text
    assert et.load(top.save(tmp_path / "top.json")).canonical == top.changed(name="top").canonical


def test_a_bare_name_keeps_its_meaning_beside_the_parts_of_a_top():
    """What 1.0 understood, before a rotor and gimbals had such keys, too; where only parts have it, all are named."""
    for name, pointer in (("mass_kg", "/body/mass_kg"), ("spin_rpm", "/release/spin_rpm"), ("frequency_hz", "/platform/frequency_hz"),
                          ("viscous_torque_N_m_s", "/effects/viscous_torque_N_m_s")):
        assert pointer_of(name) == pointer
    with pytest.raises(et.ScenarioError, match="/gimbals/outer/torsion_N_m_rad, /gimbals/inner/torsion_N_m_rad"):
        pointer_of("torsion_N_m_rad")


def test_copies_are_apart():
    top = et.Scenario(SMALL)
    for other in (copy.copy(top), copy.deepcopy(top), top.changed(), pickle.loads(pickle.dumps(top))):
        assert other == top
        other["latitude_deg"] = 0
        assert top["latitude_deg"] == 48 and other != top


def test_a_file_keeps_its_text(scenarios, tmp_path):
    text = (scenarios / "toy-top.json").read_text()
    top = et.load(scenarios / "toy-top.json")
    assert top.text == text
    assert et.load(top.save(tmp_path / "copy.json")) == top
    top["duration_s"] = 5
    with pytest.raises(et.ScenarioError, match="already exists.*or force=True to overwrite it"):
        top.save(tmp_path / "copy.json")
    assert et.load(top.save(tmp_path / "copy.json", force=True))["duration_s"] == 5
    assert top.text == text.replace('"duration_s": 60', '"duration_s": 5'), "layout and comments are as they were"
    assert et.example("toy-top").sha256 == et.load(str(scenarios / "toy-top.json")).sha256
    with pytest.raises(et.ScenarioError, match="did you mean 'toy-top'"):
        et.example("toytop")


def test_a_file_is_looked_for_beside_the_scenario(tmp_path):
    (tmp_path / "angles.csv").write_text("t_s,angle_rad\n0,0\n0.4,0.1\n0.7,0.2\n1,0.3\n")
    content = {**SMALL, "platform": {"motion": "table", "file": "angles.csv", "pivot_offset_m": [0.2, 0, 0]}}
    (tmp_path / "moving.json").write_text(json.dumps(content))
    top = et.load(tmp_path / "moving.json")
    assert et.check(tmp_path / "moving.json") and top.check()
    for moved in (top, et.Scenario(content, path=tmp_path / "another.json"), pickle.loads(pickle.dumps(top))):
        assert et.run(moved).drift.axis_final_rad == et.run(top).drift.axis_final_rad
    assert et.run(top).drift.axis_final_rad != et.run(et.Scenario(SMALL)).drift.axis_final_rad
    refused = et.check(content)
    assert not refused and refused.errors[0].pointer == "/platform/file", "it is not in the working directory"
