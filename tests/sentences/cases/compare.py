# SPDX-License-Identifier: GPL-3.0-or-later
"""What `compare` says of results, compact references, stores and CSV files.

Most of its inputs are written here, without checksums, and as small as a sentence allows: a compact reference s.json, of which
`set` and `unless` change a part, and the results old/ and new/.
"""
import json
import math
import re

from case import Case

HASH, OTHER_HASH = "a" * 64, "b" * 64
ROWS = [[0, 0], [1, 1e-6], [2, 3e-6]]
DRIFT = "t_s,drift_axis_rad"
ATTITUDE = "t_s,q_LB_w,q_LB_x,q_LB_y,q_LB_z"
AXIS = "t_s,axis_L_x,axis_L_y,axis_L_z"
RATES = "t_s,w_LB_B_x_rad_s,w_LB_B_y_rad_s,w_LB_B_z_rad_s"
PAIR = "compare old new"


def summary(rows, **members):
    return {"$schema": "earthtop-summary-1.json", "outcome": {"status": "completed", "reached_s": 2.0, "rows": rows},
            "drift": {"verdict": "reliable"}, "motion": {}, "invariants": [], "scenario": {"release": {"spin_rad_s": 200}},
            "provenance": {"scenario_sha256": HASH}, "name": "top", **members}


def csv(columns, rows):
    return columns + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows)


def results(directory="new", /, rows=ROWS, columns=DRIFT, timing=None, torques=None, stated=None, **members):
    """The files of a run's results."""
    members = summary(len(rows) if stated is None else stated, **members)
    files = {f"{directory}/summary.json": json.dumps(members, indent=2) + "\n", f"{directory}/trajectory.csv": csv(columns, rows)}
    if timing:
        files[f"{directory}/timing.json"] = json.dumps(timing, indent=2) + "\n"
    if torques:
        files[f"{directory}/torques.csv"] = torques
    return files


def both(old=None, **new):
    """The files of old and new results."""
    return {**results("old", **(old or {})), **results("new", **new)}


def reference(rows=ROWS, columns=("t_s", "drift_axis_rad"), **members):
    """A compact reference."""
    return {"$schema": "earthtop-reference-1.json", "generator": "by hand", "summary": summary(len(rows), **members),
            "row_count": len(rows), "columns": list(columns), "rows": rows}


def refused(says, change, command="compare s.json new", scenario=None, good=None, files=None, status=2):
    """A fault of one key of s.json: without it, the sentence is not said."""
    scenario = scenario or reference()
    pointer = next(iter(change))
    if good is None:
        good = scenario
        for key in pointer.split("/")[1:]:
            good = good[int(key)] if isinstance(good, list) else good.get(key)
    return Case(command, says, scenario=scenario, set=change, unless={pointer: good}, status=status, files=files or results())


def told(says, files, status=1, without=None, without_status=0, command=PAIR, **more):
    """Something that is said of some files and, where there are others, not of these."""
    says = [says] if isinstance(says, str) else says
    cases = [Case(command, says, scenario=None, files=files, status=status, **more)]
    if without is not None:
        cases.append(Case(command, [], scenario=None, files=without, status=without_status,
                          holds=lambda text: not any(one in text for one in says)))
    return cases


def product(a, b):
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def turn(angle, axis):
    return (math.cos(angle / 2), *(math.sin(angle / 2) * part for part in axis))


X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
TIMES = [0.5 * i for i in range(12)]
PRECESSION = {t: product(turn(0.6 * t, Z), product(turn(0.5, Y), turn(t, Z))) for t in TIMES}  # body to East, North, Up


def attitudes(change=lambda q: q):
    return [[t, *change(q)] for t, q in PRECESSION.items()]


def axes(change=lambda n: n):
    return [[t, *change(product(product(q, (0, 0, 0, 1)), (q[0], -q[1], -q[2], -q[3]))[1:])] for t, q in PRECESSION.items()]


OF_REFERENCES = [
    refused('has no "columns"; write the reference again', {"/columns": None}),
    refused("its summary has no scenario hash; write the reference again", {"/summary/provenance/scenario_sha256": None}),
    refused('its summary has no "invariants"; write the reference again', {"/summary/invariants": None}),
    refused("its columns do not begin with t_s, or it has no rows; write the reference again", {"/columns/0": "drift_axis_rad"}),
    refused("its columns do not begin with t_s, or it has no rows; write the reference again", {"/rows": 3}),
    refused('its column "drift_axis" is not one of trajectory.csv, or occurs twice', {"/columns/1": "drift_axis"}),
    refused('its column "drift_axis_rad" is not one of trajectory.csv, or occurs twice', {"/columns/2": "drift_axis_rad"},
            scenario=reference([[t, x, x] for t, x in ROWS], ("t_s", "drift_axis_rad", "drift_tilt_rad"))),
    refused("its rows are not in order", {"/rows/2/0": 1}),
    refused("does not have as many rows as it states (row_count)", {"/row_count": 4}),
    refused("the number of cells in a row is not the number of columns, or a row has no time", {"/rows/1": [1]}),
]

OF_PATHS = [
    *told("does not state its number of rows (/outcome/rows), a whole number", both(stated=2.5), 2, both()),
    *told("timing.json: error: is damaged: run the scenario again",
          both(timing={"solution_s": 1.0, "checksum": "0123456789abcdef"}), 2, both(timing={"solution_s": 1.0})),
    *told("the path is empty; give a directory of results, a study store, or a file", both(), 2, command="compare '' new"),
    *told("there is no such file or directory; check the path", both(), 2, command="compare old neu"),
    *told("has a trajectory.csv without its summary.json: writing it was interrupted; run the scenario again",
          {**results("old"), "new/trajectory.csv": csv(DRIFT, ROWS)}, 2, both()),
    *told("holds no results: it has no summary.json, no study.sqlite, no directories with one, and no compact references",
          {**results("old"), "new/readme.txt": "nothing"}, 2, both()),
    *told("old and many are of different kinds: give two results, two directories of results, or two study stores",
          {**results("old"), **results("many/top")}, 2, {**results("few/top"), **results("many/top")},
          command="compare old many"),
    *told("old or new: a JSON file in it is not in the form that this program writes; write it again", both(scenario=[1]), 2,
          both()),
    *told('holds "top" twice, as top and as top.json; remove one of them',
          {**results("old/top"), **results("new/top"), "new/top.json": json.dumps(reference())}, 2,
          {**results("old/top"), **results("new/top")}),
    *told("a limit on the cost needs results of `run` on both sides, since only these state their cost",
          both(), 2, command="compare old new/trajectory.csv --max-steps-ratio 2"),
    *told("--mapping says what the columns of a CSV file mean, but neither of the two is a CSV file",
          {**both(), "m.json": '{"time": {"column": "t"}, "axis": {"columns": ["x", "y", "z"]}}'}, 2,
          command="compare old new --mapping m.json"),
    *told("new.csv: error: has no rows", {**results("old"), "new.csv": DRIFT + "\n"}, 2,
          {**results("old"), "new.csv": csv(DRIFT, ROWS)}, command="compare old new.csv"),
    *told("new/trajectory.csv: error: has no rows; run the scenario again", both(rows=[]), 2, both()),
    *told("has 3 rows where its summary states 4, the last at t = 2 s: truncated or changed; run the scenario again",
          both(stated=4), 2, both()),
    *told("has 4 rows where its summary states 5, and a gap after t = 1 s: truncated or changed; run the scenario again",
          both(rows=[[0, 0], [1, 0], [3, 0], [4, 0]], stated=5), 2),
]

OTHER_SPIN = {"scenario": {"release": {"spin_rad_s": 201}}}
UNSTABLE = {"verdict": "unstable", "reliable": {"until_s": 1}}
TORQUES = "t_s,tau_cor_L_x_N_m,tau_cor_L_y_N_m,tau_cor_L_z_N_m\n0,0,0,1\n1,0,0,1\n2,0,0,1\n"
OF_SCENARIOS = [
    *told("the scenarios do not match their hash: /release/spin_rad_s: 200 in the reference, 201 now", both(**OTHER_SPIN), 1,
          both(), command=PAIR + " --allow-change /"),
    *told("Other scenario: /release/spin_rad_s: 200 in the reference, 201 now",
          both(**OTHER_SPIN, provenance={"scenario_sha256": OTHER_HASH}), 1, both()),
    *told("note: other scenario, as allowed: /release/spin_rad_s: 200 in the reference, 201 now",
          both(**OTHER_SPIN, provenance={"scenario_sha256": OTHER_HASH}), 0, both(),
          command=PAIR + " --all --allow-change /release"),
    *told("the reference has no scenario hash", both(old={"provenance": {}}), 1, both(provenance={}), 1),
    *told("the new result has no scenario hash", both(provenance={}), 1, both(old={"provenance": {}}), 1),
    *told('the name is "top" in the reference, "gyro" now (--allow-change /name allows it)',
          both(name="gyro", provenance={"scenario_sha256": OTHER_HASH}), 1,
          both(title="any", provenance={"scenario_sha256": OTHER_HASH}), 1),
    *told("same: new against old", both(name="gyro", provenance={"scenario_sha256": OTHER_HASH}), 0,
          command=PAIR + " --allow-change /name"),
    *told("scenario hash aaaaaaaaaaaa in the reference, bbbbbbbbbbbb now, though no key differs: an older version made one of them",
          both(provenance={"scenario_sha256": OTHER_HASH}), 1, both(provenance={"scenario_sha256": OTHER_HASH}, **OTHER_SPIN), 1),
    *told("note: --allow-change /x: neither scenario has such a key", both(), 0, command=PAIR + " --all --allow-change /x"),
    *told("trusted until t = 1 s in the reference, to the end now", both(old={"drift": UNSTABLE}), 1,
          both(old={"drift": UNSTABLE}, drift=UNSTABLE)),
    *told("1 rows after t = 1 s were not compared, since a verdict does not trust them", both(old={"drift": UNSTABLE}, drift=UNSTABLE),
          0, both(), command=PAIR + " --all"),
    *told("torques.csv is missing in the new result", both(old={"torques": TORQUES}), 1, both(old={"torques": TORQUES}, torques=TORQUES)),
    *told("torques.csv is missing in the reference", both(torques=TORQUES), 1, both(old={"torques": TORQUES}, torques=TORQUES)),
    *told("is a partial result: its run was interrupted before it had error bounds and a verdict",
          both(outcome={"status": "interrupted", "reached_s": 2, "rows": 3}), 2, both()),
    *told("not compared: means over the rows, since the rows are different now",
          both(old={"scenario": {"motion": {"output_step_s": 1}}}, scenario={"motion": {"output_step_s": 2}},
               provenance={"scenario_sha256": OTHER_HASH}), 0, both(), command=PAIR + " --all --allow-change /"),
    *told("not compared: largest values, swings and turns seen, since one of the results is of an older version",
          both(), 0, both(old={"drift": {"axis_max_at_s": None}}, drift={"axis_max_at_s": None}), command=PAIR + " --all"),
    *told("new has no checksums, since an older earthtop wrote it: damage to it would go unnoticed", both(), 0, command=PAIR + " --all"),
]

CASES = OF_REFERENCES + OF_PATHS + OF_SCENARIOS
