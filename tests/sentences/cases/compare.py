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
OTHER_AXIS = AXIS.replace("axis", "ref_axis")
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

def comparison(**members):
    """The files of a document of a comparison."""
    document = {"$schema": "earthtop-comparison-1.json", "verdict": "same", "pairs": [], **members}
    return {"c.json": json.dumps(document, indent=2) + "\n"}


OF_PATHS = [
    *told(["c.json: error: is damaged: its contents are not what was written; write it anew; if you have changed it yourself, remove its "
           'member "checksum"'], comparison(checksum="0123456789abcdef"), 2, comparison(), command="report c.json"),
    *told("note: c.json has no checksums: damage to it would go unnoticed", comparison(), 0,
          command="report c.json"),
    *told("c.json: error: /least_p_value: is 1.1757, but must be a probability, from 0 to 1: the file is not as earthtop wrote it; "
          "write it anew", comparison(least_p_value=1.1757), 2, comparison(least_p_value=0.17), command="report c.json"),
    *told("ref.json: error: is damaged: its contents are not what was written",
          {**results(), "ref.json": json.dumps({**reference(), "checksum": "0123456789abcdef"}, indent=2) + "\n"}, 2,
          {**results(), "ref.json": json.dumps(reference(), indent=2) + "\n"}, command="compare ref.json new"),
    *told("new.csv:1:1: error: the header has none of the columns of trajectory.csv, or no t_s; if another program wrote the "
          "file, say with "
          "--mapping what its columns mean", {**results("old"), "new.csv": csv("t_s,x", ROWS)}, 2,
          {**results("old"), "new.csv": csv(DRIFT, ROWS)}, command="compare old new.csv"),
    *told("does not state its number of rows (/outcome/rows), a whole number", both(stated="3"), 2, both()),
    *told("timing.json: error: is damaged: its contents are not what was written; run the scenario again",
          both(timing={"solution_s": 1.0, "checksum": "0123456789abcdef"}), 2, both(timing={"solution_s": 1.0})),
    *told("the path is empty; give a directory of results, a study store, or a file", both(), 2, command="compare '' new"),
    *told("there is no such file or directory; check the path", both(), 2, command="compare old neu"),
    *told("has a trajectory.csv without its summary.json: writing it was interrupted; run the scenario again",
          {**results("old"), "new/trajectory.csv": csv(DRIFT, ROWS)}, 2, both()),
    *told("holds no results: it has no summary.json, no study.sqlite, no directories with one, and no compact references",
          {**results("old"), "new/readme.txt": "nothing"}, 2, both()),
    *told("old and many are of different kinds: give two results, two directories of results, or two study stores",
          {**results("old"), **results("many/top")}, 2, {**results("old/top"), **results("many/top")},
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
TORQUES = "t_s,tau_cor_x_N_m,tau_cor_y_N_m,tau_cor_z_N_m\n0,0,0,1\n1,0,0,1\n2,0,0,1\n"
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
    *told("scenario hash aaaaaaaaaaaa in the reference, bbbbbbbbbbbb now, though no key differs: an older version made one of "
          "them",
          both(provenance={"scenario_sha256": OTHER_HASH}), 1, both(provenance={"scenario_sha256": OTHER_HASH}, **OTHER_SPIN), 1),
    *told("note: --allow-change /x: neither scenario has such a key", both(), 0, command=PAIR + " --all --allow-change /x"),
    *told("trusted until t = 1 s in the reference, to the end now", both(old={"drift": UNSTABLE}), 1,
          both(old={"drift": UNSTABLE}, drift=UNSTABLE)),
    *told("1 rows after t = 1 s were not compared, since a verdict does not trust them", both(old={"drift": UNSTABLE},
                                                                                              drift=UNSTABLE),
          0, both(), command=PAIR + " --all"),
    *told("torques.csv is missing in the new result", both(old={"torques": TORQUES}), 1, both(old={"torques": TORQUES},
                                                                                              torques=TORQUES)),
    *told("torques.csv is missing in the reference", both(torques=TORQUES), 1, both(old={"torques": TORQUES}, torques=TORQUES)),
    *told("is a partial result: its run was interrupted before it had error bounds and a verdict",
          both(outcome={"status": "interrupted", "reached_s": 2, "rows": 3}), 2, both()),
    *told("not compared: means over the rows, since the rows are different now",
          both(old={"scenario": {"motion": {"output_step_s": 1}}}, scenario={"motion": {"output_step_s": 2}},
               provenance={"scenario_sha256": OTHER_HASH}), 0, both(), command=PAIR + " --all --allow-change /"),
    *told("not compared: largest values, swings and turns seen, since one of the results is of an older version",
          both(), 0, both(old={"drift": {"axis_max_at_s": None}}, drift={"axis_max_at_s": None}), command=PAIR + " --all"),
    *told("note: and 10 more notes of this kind", {key: text for i in range(9) for old in ("old", "new")
                                                   for key, text in results(f"{old}/{i}").items()}, 0, both()),
    *told("new has no checksums: damage to it would go unnoticed", both(), 0,
          command=PAIR + " --all"),
]


ALLOWED = PAIR + " --allow-change /"


def other(old=None, **new):
    """The files of old and new results, of which the scenarios differ."""
    return both(old, **{"provenance": {"scenario_sha256": OTHER_HASH}, **OTHER_SPIN, **new})


BOUNDED = "t_s,drift_axis_rad,drift_axis_bound_rad"


def bounded(first=0, second=0, bound=1e-9, later_bound=1e-9):
    """Rows with a difference in the second and in the third of them."""
    return {"columns": BOUNDED, "rows": [[0, 0, bound], [1, 1e-6 + first, bound], [2, 1e-5 + second, later_bound]]}


COST = {"solution": {"steps_accepted": 100, "steps_rejected": 0, "right_hand_side_evaluations": 900},
        "certificate": {"steps_accepted": 100, "steps_rejected": 0, "right_hand_side_evaluations": 1100}}
DEARER = {"solution": {"steps_accepted": 150, "steps_rejected": 50, "right_hand_side_evaluations": 1900},
          "certificate": COST["certificate"]}
TABLE = {"$schema": "earthtop-tolerances-1.json", "quantities": {"drift_axis_rad": {"absolute": 4e-6}}}
TOLD = PAIR + " --tolerances s.json"


def by_table(says, change, unless=None, status=1, command=TOLD, files=None, table=TABLE, **more):
    """A sentence about tolerances of the file s.json."""
    return Case(command, says, scenario=table, set=change, unless=unless, status=status, files=files or LARGER, **more)


LARGER = both(rows=[[0, 0], [1, 1e-6], [2, 5e-6]])  # by 2e-6 in its last row
OF_CONCLUSIONS = [
    *told(["All 4 quantities agree to the last bit.", "Not a bit has changed."], both(), 0, LARGER, 1),
    *told("The only quantity agrees to the last bit.", {"a.csv": csv(DRIFT, ROWS), "b.csv": csv(DRIFT, ROWS)}, 0,
          command="compare a.csv b.csv"),
    *told("1 of 4 quantities changed by more than allowed, drift_axis_rad (angle between the two spin axes): "
          "2e-06 rad at t = 2 s, where nothing is allowed.", LARGER, 1, both(), command=PAIR + " --profile bitwise"),
    by_table(["All 4 quantities are within their tolerances.", "Nearest to its tolerance is drift_axis_rad",
              "2e-06 rad at t = 2 s, 0.5 of its tolerance."], {}, {"/quantities/drift_axis_rad/absolute": 1.9e-6}, 0),
    by_table("changed by more than allowed, drift_axis_rad (angle between the two spin axes): 2e-06 rad at t = 2 s, 4 times its "
             "tolerance.", {"/quantities/drift_axis_rad/absolute": 5e-7}, {"/quantities/drift_axis_rad/absolute": 2.1e-6}),
    *told("2e-08 rad at t = 2 s, 0.02 of its tolerance, but 5 times its tolerance elsewhere",
          other(bounded(), **bounded(1e-8, 2e-8, later_bound=1e-6)), 1, other(bounded(), **bounded(1e-9, 2e-8, later_bound=1e-6)),
          command=ALLOWED),
    *told("2 of 5 quantities changed by more than allowed, most of all drift_tilt_rad (angle of the axis from the vertical, "
          "rotating minus prediction): "
          "2e-07 rad at t = 0 s", both({"columns": DRIFT + ",drift_tilt_rad", "rows": [[0, 1, 1e-6]]},
                                       columns=DRIFT + ",drift_tilt_rad",
                                       rows=[[0, 1 + 1e-9, 1.2e-6]])),
    *told('1 quantity differs otherwise than by a number, outcome.status: "completed" in the reference, "stopped" now.',
          both(outcome={"status": "stopped", "reached_s": 2.0, "rows": 3}), 1, both()),
    *told(["2 quantities differ otherwise than by a number, the first one outcome.status",
           "No quantity's number has changed by a bit; what else differs is named below."],
          both(outcome={"status": "stopped", "reached_s": 2.0, "rows": 3}, drift={"verdict": "noise_floor"})),
    *told("1 quantity differs otherwise than by a number, drift_axis_rad: different digits at t = 1 s.",
          both({"rows": [[0, 0], [1, "1.00000000000000000001e-6"]]}, rows=[[0, 0], [1, "1.00000000000000000002e-6"]]), 1,
          both({"rows": [[0, 0], [1, "1.001e-6"]]}, rows=[[0, 0], [1, "1.002e-6"]]), 1, command=PAIR + " --profile bitwise"),
    *told("The two cannot be compared: new/top/summary.json: error: does not state its number of rows",
          {**results("old/top"), **results("new/top", stated="3")}, 2, {**results("old/top"), **results("new/top")}),
    *told(["3 results: 1 same, 1 differ, 1 refused.", "First b: The two cannot be compared: new/b/summary.json"],
          {**results("old/a"), **results("old/b"), **results("old/c"), **results("new/a"), **results("new/b", stated="3"),
           **results("new/c", rows=[[0, 0], [1, 1e-6], [2, 4e-6]])}, 2),
    *told(["Steps went from 200 to 300, more than 1.4 times. Evaluations went from 2000 to 3000, more than 1.4 times.",
           "FAILED steps: 300 where the reference has 200, 1.5 times; limit 1.4 times"],
          both(COST, **DEARER), 1, both(COST, **COST), command=PAIR + " --max-steps-ratio 1.4"),
    *told("steps: 300 where the reference has 200, 1.5 times", both(COST, **DEARER), 0, both(COST, **COST),
          command=PAIR + " --all"),
    *told("cost: a limit was set, but steps are not known for both results", both(COST), 1, both(COST, **COST),
          command=PAIR + " --max-steps-ratio 1.4"),
    *told("All numbers that have changed are within both error bounds.",
          other(bounded(), **bounded(1e-10)), 0, other(bounded(), **bounded(1e-8)), 1, command=ALLOWED),
]


FROM_NED, HALF_ABOUT_X, FROM_X_FORWARD = turn(math.pi, (math.sqrt(0.5), math.sqrt(0.5), 0)), turn(math.pi, X), \
    turn(-2 * math.pi / 3, [math.sqrt(1 / 3)] * 3)
QUATERNION = {"time": {"column": "t_s"}, "quaternion": {"columns": ATTITUDE.split(",")[1:]}}


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def mixed_up(what, change, mapping=None, columns=ATTITUDE, rows=attitudes):
    """A file with another convention: the guess names it and, with a mapping that says so, the file is the same."""
    files = {**results("old", rows(), columns), "new.csv": csv(columns, rows(change)), "m.json": json.dumps(mapping)}
    guess = re.compile(r"hint: the new result agrees to (\S+) rad if " + re.escape(what))
    cases = [Case("compare old new.csv", "if " + what, scenario=None, files=files, status=1,
                  holds=lambda text: float(guess.search(text).group(1)) < 1e-14)]
    if mapping:
        cases.append(Case("compare old new.csv --mapping m.json", "same: new.csv against old", scenario=None, files=files))
    return cases


def scaled(what, factor, columns=DRIFT, rows=ROWS):
    """A file with another unit."""
    first = columns.split(",")[1].replace("w_LB_B_x", "rates")
    changed = [[row[0], *(cell * factor for cell in row[1:])] for row in rows]
    beside = [[row[0], *(cell * factor * (1 + 2e-3) for cell in row[1:])] for row in rows]  # a ratio that is not known
    says = f"{first}: new values are {factor:.6g} times the reference's, as with {what}"
    if columns == RATES:
        says = f"if its rates, {factor:.6g} times the reference's, are taken as in {what}" if factor > 0 else what
    return told(says, both({"columns": columns, "rows": rows}, columns=columns, rows=changed), 1,
                both({"columns": columns, "rows": rows}, columns=columns, rows=beside), 1)


RATE_ROWS = [[0, 1, 2, 200], [1, 2, 1, 200], [2, 2, 2, 200]]
OF_HINTS = [
    *mixed_up("its quaternions are taken as world-to-body", inverse,
              {**QUATERNION, "quaternion": {**QUATERNION["quaternion"], "rotation": "world_to_body"}}),
    *mixed_up("its quaternions are read with the scalar part last", lambda q: (*q[1:], q[0]),
              {**QUATERNION, "quaternion": {**QUATERNION["quaternion"], "order": "xyzw"}}),
    *mixed_up("its world axes are taken as North, East, Down (\"NED\")", lambda q: product(inverse(FROM_NED), q),
              {**QUATERNION, "world_axes": "NED"}),
    *mixed_up("its world axes are taken as North, East, Down (\"NED\") and its body axes are taken as our 1, -2, -3",
              lambda q: product(product(inverse(FROM_NED), q), HALF_ABOUT_X),
              {**QUATERNION, "world_axes": "NED", "body_axes": ["1", "-2", "-3"]}),
    *mixed_up("its body axes are taken as our 1, -2, -3", lambda q: product(q, HALF_ABOUT_X),
              {**QUATERNION, "body_axes": ["1", "-2", "-3"]}),
    *mixed_up("its body axes are taken as our 3, 1, 2 (\"x-forward\")", lambda q: product(q, FROM_X_FORWARD),
              {**QUATERNION, "body_axes": "x-forward"}),
    *mixed_up("its quaternions are taken as world-to-body and its world axes are taken as North, East, Down (\"NED\")",
              lambda q: inverse(product(inverse(FROM_NED), q)),
              {**QUATERNION, "world_axes": "NED", "quaternion": {**QUATERNION["quaternion"], "rotation": "world_to_body"}}),
    *mixed_up("its world axes are taken as North, East, Down (\"NED\")", lambda n: (n[1], n[0], -n[2]),
              {"time": {"column": "t_s"}, "axis": {"columns": AXIS.split(",")[1:]}, "world_axes": "NED"}, AXIS, axes),
    *mixed_up("its world axes are taken as North, West, Up (\"NWU\")", lambda n: (n[1], -n[0], n[2]),
              {"time": {"column": "t_s"}, "axis": {"columns": AXIS.split(",")[1:]}, "world_axes": "NWU"}, AXIS, axes),
    *mixed_up("its axis is reversed", lambda n: [-part for part in n], None, AXIS, axes),
    *scaled("degrees instead of radians", 180 / math.pi),
    *scaled("radians instead of degrees", math.pi / 180),
    *scaled("arcseconds instead of radians", 180 * 3600 / math.pi),
    *scaled("a unit a thousand times smaller", 1e3),
    *scaled("a unit a thousand times larger", 1e-3),
    *scaled("turns instead of radians", 0.5 / math.pi),
    *scaled("rpm", 30 / math.pi, RATES, RATE_ROWS),
    *scaled("its rates have the opposite sign", -1, RATES, RATE_ROWS),
    *scaled("turns per minute instead of radians per second", 30 / math.pi),
    *scaled("the opposite sign", -1),
    *told("ref_axis_rad: each new row is that of the reference one row later: are the times shifted by a sample?",
          both({"columns": OTHER_AXIS, "rows": axes()[:-1]}, columns=OTHER_AXIS,
               rows=[[t, *n] for t, (_, *n) in zip(TIMES, axes()[1:])]), 1,
          both({"columns": OTHER_AXIS, "rows": axes()[1:]}, columns=OTHER_AXIS,
               rows=[[t, *n] for t, (_, *n) in zip(TIMES[1:], axes())]), 1),
    *told("if each row is taken as that of the reference one row later: are the times shifted by a sample?",
          both({"columns": AXIS, "rows": axes()[:-1]}, columns=AXIS, rows=[[t, *n] for t, (_, *n) in zip(TIMES, axes()[1:])]), 1,
          both({"columns": AXIS, "rows": axes()[1:]}, columns=AXIS, rows=[[t, *n] for t, (_, *n) in zip(TIMES[1:], axes())]), 1),
    *told("if each row is taken as that of the reference one row before: are the times shifted by a sample?",
          both({"columns": AXIS, "rows": axes()[1:]}, columns=AXIS, rows=[[t, *n] for t, (_, *n) in zip(TIMES[1:], axes())]), 1,
          both({"columns": AXIS, "rows": axes()[:-1]}, columns=AXIS, rows=[[t, *n] for t, (_, *n) in zip(TIMES, axes()[1:])]), 1),
    *told("12 quaternions have the opposite sign, which is the same attitude",
          both({"columns": ATTITUDE, "rows": attitudes()}, columns=ATTITUDE, rows=attitudes(lambda q: [-part for part in q])), 0,
          both({"columns": ATTITUDE, "rows": attitudes()}, columns=ATTITUDE,
               rows=attitudes(lambda q: product(q, turn(math.radians(200), Z)))), 1, command=PAIR + " --all"),
]

TWO = "t_s,drift_axis_rad,drift_axis_bound_rad,drift_attitude_rad"


def two(first=0, second=0):
    """Rows of a quantity with bounds, and of one without: with differences in their last row."""
    return {"columns": TWO, "rows": [[0, 0, 1e-9, 0], [1, 1e-6, 1e-9, 1e-6], [2, 1e-5 + first, 1e-9, 1e-5 + second]]}


ENGINE = {"time": {"column": "t"}, "axis": {"columns": ["x", "y", "z"]}}
LEANING = {"m.json": json.dumps(ENGINE),
           "engine.csv": csv("t,x,y,z", [[t, math.sin(math.radians(21)), 0, math.cos(math.radians(21))] for t in (0, 1e-9)])}
# A laboratory that travels, and a file without the columns of its way; an engine that leaves its laboratory where it is.
ABOARD = {"/travel": {"path": "rhumb", "course_deg": 90, "speed_m_s": 250, "reference": "at_rest"}, "/headline": None, "/criteria": None,
          "/motion": {"duration_s": 20, "output_step_s": 1}}


def engine_aboard(prefix, says, **more):
    mapping = {"time": {"column": "t_s"}, "quaternion": {"columns": [f"{prefix}q_LB_{c}" for c in "wxyz"]}}
    return Case(["run s.json --out old --quiet", "compare old old/trajectory.csv --mapping m.json --profile physics"], says,
                scenario="free-gyro", set=ABOARD, files={"m.json": json.dumps(mapping)}, **more)


OF_ENGINES = [
    engine_aboard("", "same: old/trajectory.csv against old (profile physics; compared from 0 to 20 s, 21 of 21 rows)"),
    engine_aboard("ref_", "the motion in a laboratory that stays at the place of the release", status=1,
                  unless={"/travel/reference": "same_path"}),
    Case("compare s.json engine.csv --mapping m.json --estimate tilt_deg",
         ["engine.csv against toy-top: 2 rows, all of the same weight, since the file states no errors",
          "as given: the differences are 0.0123 rad (root mean square; rates divided by the fastest one)", "fitted: ",
          "tilt_deg 21", "deg (the scenario has 20)"], files=LEANING),
    Case("compare s.json engine.csv --mapping m.json --priors",
         "a file with a --mapping is another program's, which states no standard errors: beside it there may be --estimate, --set, "
         "--json and --quiet", files=LEANING, status=2),
]

OF_PICTURES = [
    Case(ALLOWED + " --svg d.svg", ["Differences over time", "new against old", "tolerance", "difference, beyond it"],
         scenario=None,
         files=other(bounded(), **bounded(0, 1e-8)), status=1, page="d.svg"),
    Case(ALLOWED + " --svg d.svg", "Differences over time", scenario=None, files=other(bounded(), **bounded(0, 1e-9)),
         page="d.svg",
         holds=lambda text: "difference, beyond it" not in text and "(rad) difference tolerance" in text),
]

OF_CHANGES = [
    *told("Something has changed by more than both error bounds.", other(two(), **two(1e-8)), 1, other(two(), **two(1e-9)),
          command=ALLOWED),
    *told("All numbers that have changed are within both error bounds.", other(two(), **two(1e-9)), 0,
          other(two(), **two(1e-9, 1e-18)),
          command=ALLOWED),
    *told("Where error bounds are known, what has changed is within them; the rest is within its tolerance.",
          other(two(), **two(1e-9, 5e-18)), 0, other(two(), **two(1e-9, 2e-17)), 1, command=ALLOWED),
    *told("What has changed has no error bounds, and is within its tolerance.",
          other(two(), **two(0, 5e-18)), 0, other(two(), **two(1e-9, 5e-18)), command=ALLOWED),
    *told("What has changed by more than its tolerance has no error bounds.",
          other(two(), **two(1e-9, 2e-17)), 1, other(two(), **two(1e-9, 5e-18)), command=ALLOWED),
    *told("Where error bounds are known, what has changed is within them; something without them is beyond its tolerance.",
          both(two(), **two(1e-9, 1e-14)), 1, both(two(), **two(1e-18, 1e-14)), 1),
    # A file without error bounds states none: no change in it is above them.
    *told(["What has changed by more than its tolerance has no error bounds; what else",
           "missing column: drift_axis_bound_rad is missing in the new trajectory"],
          {**results("old", **bounded()), "new.csv": csv(DRIFT, [row[:2] for row in bounded(1e-8)["rows"]])}, 1,
          {**results("old", **bounded()), "new.csv": csv(BOUNDED, bounded(1e-8)["rows"])}, 1, command="compare old new.csv"),
    *told("There is nothing to compare.", {**results("old/a"), **results("old/b"), **results("new/a")}, 0,
          {**results("old/a"), **results("old/b"), **results("new/a"), **results("new/b")},
          command=PAIR + " --allow-missing --json"),
    *told("No number could be compared.", {**results("old/a"), **results("new/b")}, 1, {**results("old/a"), **results("new/a")}),
    *told("FAILED missing result: the new directory has no result of this name",
          {**results("old/a"), **results("old/b"), **results("new/a")}, 1, {**results("old/a"), **results("new/a")}),
    *told("note: the new directory has no result of this name", {**results("old/a"), **results("old/b"), **results("new/a")}, 0,
          command=PAIR + " --allow-missing --all"),
    *told("FAILED extra result: the reference has no result of this name; --update adds it",
          {**results("old/a"), **results("new/b"), **results("new/a")}, 1, {**results("old/a"), **results("new/a")}),
    *told("within both errors both error bounds; largest at t = 1 s", other(bounded(), **bounded(1e-9)), 0,
          other(bounded(), **bounded(1e-8)), 1,
          command=ALLOWED + " --all"),
    *told("above both errors both error bounds; largest at t = 1 s; beyond it 1 times, first at t = 1 s",
          other(bounded(), **bounded(1e-8)), 1, other(bounded(), **bounded(1e-9)), 0, command=ALLOWED + " --all"),
]

FINAL = {"drift": {"verdict": "reliable", "axis_final_rad": 1e-6}}
OF_FIGURES = [
    *told("drift.axis_final_rad: is missing in the new summary", both(FINAL), 1, both(FINAL, **FINAL)),
    *told("drift.axis_final_rad: is missing in the reference's summary", both(**FINAL), 1, both(FINAL, **FINAL)),
    *told("drift.axis_final_rad: not a finite number", both(FINAL, drift={"verdict": "reliable", "axis_final_rad": None}), 1,
          both(FINAL, **FINAL)),
]

MAPPING = {"time": {"column": "t_s"}, "quaternion": {"columns": ["q_LB_w", "q_LB_x", "q_LB_y", "q_LB_z"]},
           "rates": {"columns": ["w_LB_B_x_rad_s", "w_LB_B_y_rad_s", "w_LB_B_z_rad_s"]}, "world_axes": "ENU"}
FOREIGN = {"old.csv": csv(ATTITUDE + RATES[3:], [[*row, 0, 0, 1] for row in attitudes()])}
FOREIGN["new.csv"] = FOREIGN["old.csv"]
MAPPED = "compare old.csv new.csv --mapping s.json"


def mapped(says, change, good=None):
    return refused(says, change, MAPPED, MAPPING, good, FOREIGN)


OF_MAPPINGS = [
    mapped("/quaternion/columns: must be an array of 4 different names", {"/quaternion/columns/3": "q_LB_x"}),
    mapped('/world_axes: must be "ENU", "NED", "NWU", "y-up", or an array of three of east, west, north, south, up, down, with '
           'each '
           "direction once", {"/world_axes": ["east", "west", "up"]}, ["north", "west", "up"]),
    mapped('/body_axes: must be "z-spin", "x-forward", or an array of three of 1, -1, 2, -2, 3, -3, with each direction once',
           {"/body_axes": ["1", "2", "4"]}, ["1", "2", "3"]),
    mapped("/world_axes: is a left-handed frame; reverse one of its axes", {"/world_axes": ["north", "east", "up"]},
           ["north", "east", "down"]),
    mapped("/separator: must be one character that does not occur in numbers", {"/separator": "."}, ","),
    Case(MAPPED, "/rates/axes: the rates along body axes cannot be found without a quaternion; give one", scenario=MAPPING,
         set={"/quaternion": None, "/rates/axes": "world"}, unless={"/rates/axes": "body"}, status=2, files=FOREIGN),
    Case(MAPPED, "/quaternion: is missing, and so are the rates and the axis, so that there is nothing to compare; give one of "
                 "them",
         scenario=MAPPING, set={"/quaternion": None, "/rates": None}, unless={"/rates": MAPPING["rates"]}, status=2,
         files=FOREIGN),
    mapped('there is no column "q_w", which s.json names; the columns are t_s, q_LB_w,', {"/quaternion/columns/0": "q_w"}),
]


KNOWN = {"/quantities": {"drift_axis_rad": {"absolute": 4e-6}}}
OF_TOLERANCES = [
    by_table("/quantities/drift_axis_rad/absolute: must be a number of at least 0",
             {"/quantities/drift_axis_rad/absolute": -1e-9},
             {"/quantities/drift_axis_rad/absolute": 0}, 2),
    by_table("/quantities: must be an object of quantity names and their tolerances", {"/quantities": 1}, KNOWN, 2),
    by_table(["/quantities/drift_rad: is not a known quantity; known are the dotted paths of summary.json, attitude_rad, rates_rad_s,"], {"/quantities": {"drift_rad": {"absolute": 1}}}, KNOWN, 2),
    by_table("/quantities/drift_axis_rad: must be an object with absolute, relative or bounds",
             {"/quantities/drift_axis_rad": 1e-6},
             KNOWN, 2),
    by_table("/quantities/drift_axis_rad/abs: unknown key; allowed here: absolute, relative, bounds",
             {"/quantities/drift_axis_rad/abs": 1}, {"/quantities/drift_axis_rad/abs": None}, 2),
    by_table("unused tolerance: drift.tip_max_m: no quantity with this name was compared",
             {"/quantities/drift.tip_max_m": {"absolute": 1}},
             {"/quantities/drift.tip_max_m": None}, 1),
    by_table("0.5 x its size 3e-06 (s.json); largest", {"/quantities/drift_axis_rad": {"relative": 0.5}}, KNOWN, 1),
]

CLOCK = [[t, 1e-6 * t] for t in range(11)]


def at(*times):
    return [[t, 1e-6 * t] for t in times]


OF_ROWS = [
    *told("missing column: drift_axis_rad is missing in the new trajectory, which has drift_axis_deg instead: is it in another "
          "unit, or "
          "under another name?", {**results("old", columns=DRIFT + ",drift_tilt_rad", rows=[[*row, 0] for row in ROWS]),
                                  "new.csv": csv("t_s,drift_axis_deg,drift_tilt_rad", [[*row, 0] for row in ROWS])}, 1,
          {**results("old"), "new.csv": csv(DRIFT, ROWS)}, command="compare old new.csv"),
    *told("missing column: drift_tilt_rad is missing in the trajectory of the reference",
          both(columns=DRIFT + ",drift_tilt_rad", rows=[[*row, 0] for row in ROWS]), 1, both()),
    *told("nothing in common: the two have no quantity in common",
          {**results("old"), "new.csv": csv("t_s,drift_tilt_rad", ROWS)}, 1,
          {**results("old"), "new.csv": csv(DRIFT, ROWS)}, command="compare old new.csv"),
    *told("drift_axis_rad empty in the new rows alone at t = 1 s", both(rows=[[0, 0], [1, ""], [2, 3e-6]]), 1, both()),
    *told("drift_axis_rad empty in the reference alone at t = 1 s", both({"rows": [[0, 0], [1, ""], [2, 3e-6]]}), 1, both()),
    *told("drift_axis_rad not a finite number in the new rows at t = 1 s", both(rows=[[0, 0], [1, "nan"], [2, 3e-6]]), 1, both()),
    *told("drift_axis_rad not a finite number in the reference at t = 2 s", both({"rows": [[0, 0], [1, 1e-6], [2, "inf"]]}), 1,
          both()),
    *told("not finite: 2 times of the reference are not finite numbers", both({"rows": [*ROWS, ["nan", 1], ["inf", 2]]}), 1,
          both()),
    *told("not finite: new/trajectory.csv:3: the time is not a finite number",
          both(rows=[[0, 0], ["nan", 1], [1, 1e-6], [2, 3e-6]]), 1,
          both()),
    *told("the time 1 s is not later than that of the row before, 1 s", both(rows=[[0, 0], [1, 1], [1, 1]]), 2, both()),
    *told("other times: t = 1.5 s is not a time of the reference, though both are results of the same scenario",
          both(rows=at(0, 1.5, 2)), 1, other(rows=at(0, 1, 2)), 1),
    *told("extra rows: the new result has rows that the reference of the same scenario lacks", both(rows=[*ROWS, [3, 0]]), 1,
          both()),
    *told("note: 2 new rows lie outside the reference's times, 0 s to 2 s: not compared", other(rows=[*ROWS, [3, 0], [4, 0]]), 0,
          other(), command=ALLOWED + " --all"),
    *told("missing rows: 2 of the reference's 3 rows are missing in the new result, the first one at t = 0 s",
          both(rows=[[1, 1e-6]]), 1,
          both()),
    *told("note: 2 of the reference's 3 rows are missing in the new result, which was allowed", both(rows=[[1, 1e-6]]), 0, both(),
          command=PAIR + " --all --allow-missing"),
    # Rows between those of the reference stand for its rows there: only later ones are missing.
    *told(["5 of the reference's 11 rows are missing in the new result, the first one at t = 6 s",
           "3 rows lie between the reference's: they are compared with its cubic Hermite interpolation, whose error (for rows "
           "twice as "
           "far apart) is added to the tolerances"],
          other({"rows": CLOCK}, rows=at(0, 1.25, 2.5, 3.75, 5)), 1, other({"rows": CLOCK}, rows=CLOCK), command=ALLOWED),
    *told("nothing in common: no row of the new result was compared", other(rows=at(5, 6)), 1, other(), command=ALLOWED),
    *told("the two have rows at different times, and those of the reference are too far apart for interpolation: the body turns "
          "by "
          "1.2 rad from row to row; give both the same times, run the reference with a shorter motion.output_step_s, or allow "
          "more",
          other({"columns": RATES, "rows": [[t, 0, 0, 1.2] for t in range(9)]}, columns=RATES,
                rows=[[0, 0, 0, 1.2], [1.5, 0, 0, 1.2]]), 2,
          other({"columns": RATES, "rows": [[t, 0, 0, 0.9] for t in range(9)]}, columns=RATES,
                rows=[[0, 0, 0, 0.9], [1.5, 0, 0, 0.9]]), 1,
          command=ALLOWED),
    *told("too far apart for interpolation: the error of drift_axis_rad between them may be 6.3e-05, above its tolerance 6.3e-17",
          other({"rows": [[t, 63e-6 * (t == 8)] for t in range(17)]}, rows=[[0, 0], [1.5, 0]]), 2, other(), command=ALLOWED),
    *told("The only quantity is within its tolerance. Nearest to its tolerance is drift_axis_rad (angle between the two spin "
          "axes): "
          "1e-18 rad at t = 2 s, 0.33 of its tolerance.",
          {"a.csv": csv(DRIFT, ROWS), "b.csv": csv(DRIFT, [*ROWS[:2], [2, 3e-6 + 1e-18]])}, 0,
          {"a.csv": csv(DRIFT, ROWS), "b.csv": csv(DRIFT, ROWS)}, command="compare a.csv b.csv"),
]

# A bound ten times as large as the reference's is of one size with it; a larger one is not.
OF_ORIGINS = [
    *told("FAILED drift_axis_bound_rad 1.01e-08 1e-08 - a factor of 10; largest at t = 1 s", both(bounded(), columns=BOUNDED,
                                                                                                    rows=[
        [0, 0, 1e-9], [1, 1e-6, 1.11e-8], [2, 1e-5, 1e-9]]), 1, both(bounded(), columns=BOUNDED, rows=[
            [0, 0, 1e-9], [1, 1e-6, 0.99e-8], [2, 1e-5, 1e-9]])),
    *told("drift_axis_bound_rad (bound on the error of drift_axis_rad): 9.5e-09 rad at t = 1 s, not within a factor of 10.",
          both(bounded(), columns=BOUNDED, rows=[[0, 0, 1e-9], [1, 1e-6, 1.05e-8], [2, 1e-5, 1e-9]]), 1,
          both(bounded(), **bounded())),
    *told("Nearest to its tolerance is drift_axis_bound_rad (bound on the error of drift_axis_rad): 8.5e-09 rad at t = 1 s, "
          "within "
          "a factor of 10.",
          both(bounded(), columns=BOUNDED, rows=[[0, 0, 1e-9], [1, 1e-6, 9.5e-9], [2, 1e-5, 1e-9]]), 0,
          both(bounded(), **bounded())),
    *told("drift_axis_rad 2e-05 1e-05 2 within both errors the largest that error bounds may allow here; largest at t = 2 s",
          other(bounded(), **bounded(0, 2e-5, 1e-9, 1)), 1, other(bounded(), **bounded(0, 2e-5, 1e-9, 1e-9)), 1, command=ALLOWED),
    *told("drift_axis_rad 1e-10 2e-11 5 within both errors 0.01 x both error bounds; largest at t = 1 s",
          both(bounded(), **bounded(1e-10)), 1, other(bounded(), **bounded(1e-10)), 0, command=ALLOWED),
    *told("rates_rad_s 1 0.2 5 0.001 x the Earth's effect 200; largest at t = 1 s",
          both({"columns": RATES + ",ref_" + RATES[4:].replace(",", ",ref_"),
                "rows": [[t, 0, 0, 200, 0, 0, 0] for t in range(3)]},
               columns=RATES, rows=[[0, 0, 0, 200], [1, 0, 0, 201], [2, 0, 0, 200]]), 1, command=PAIR + " --profile physics"),
]

REASON = " --update --reason better"
COMPLETE = {"solution": {}, "motion": {}, "scenario": {}, "drift": {}, "invariants": []}
STUDY = {"base": "scenarios/toy-top.json", "set": {"/motion/duration_s": 0.1},
         "axes": [{"pointer": "/release/spin_rad_s", "values": [180, 190, 200]}], "collect": ["drift.axis_final_rad",
                                                                                              "drift.verdict"]}
STORE = {"new/study.sqlite": "any"}


def updated(says, files, status=2, without=None, without_status=0, command=PAIR + REASON, **more):
    return told(says, files, status, without, without_status, command, **more)


OF_UPDATES = [
    *updated("old.json: error: already exists, and is not a reference; choose another place",
             {**results(), "old.json": '{"a": 1}'},
             command="compare old.json new" + REASON),
    *updated("new: error: its run was not completed, so that it cannot become a reference",
             results(outcome={"status": "stopped", "reached_s": 2.0, "rows": 3})),
    *updated('new: error: its summary has no "solution"; run the scenario again', results()),
    *updated("new: error: its trajectory.csv has no q_LB_w; run the scenario again", results(solution={})),
    *updated("new: error: study.sqlite-wal in it says that its store is in use; wait until that has ended",
             {**STORE, "new/study.sqlite-wal": ""}, 2, STORE, 2),
    *updated("old: error: is a file; give a directory", {**STORE, "old": ""}, 2, STORE, 2),
    *updated("old: error: is a reference of another kind; choose another place", {**STORE, **results("old")}, 2, STORE, 2),
    *updated("old: error: is a reference of another kind; choose another place", {**results(), "old/study.sqlite": ""}),
    *updated("shard.sqlite: error: give the study's directory, or its study.sqlite", {"shard.sqlite": ""},
             command="compare old shard.sqlite" + REASON),
    *updated("old: error: is a single reference, but there are several new results; give a directory",
             {**results("old"), **results("new/a"), **results("new/b")}),
    *updated("old: error: is the reference itself; give new results", results("old"), command="compare old old" + REASON),
    *updated("new.csv: error: cannot be a reference; give a directory that `earthtop run` or a study has written, or a directory "
             "of such "
             "directories", {"new.csv": csv(DRIFT, ROWS)}, command="compare old new.csv" + REASON),
    *updated("a new reference needs a reason; give one with --reason TEXT", results(), command="compare old new --update"),
    Case(["study a.json --jobs 1 --quiet --out new", PAIR + REASON],
         "old/study.csv: error: is a directory, where a file of the reference belongs; move it away", scenario=None, status=2,
         files={"a.json": json.dumps(STUDY), "old/study.csv/any": ""}),
    *updated(["old/.earthtop-update/journal: error: is damaged, so that the reference may be, too; remove ",
              "old/.earthtop-update, and update the reference again"],
             {**both(), "old/.earthtop-update/journal": "earthtop-update-1\n"}, 2, both(), command=PAIR),
]

MEASURED = {"m.csv": "t_s,azimuth_rad,azimuth_se_rad\n1,0.1,0.01\n", "there.json": "{}"}
WITH = "compare s.json m.csv "
OTHER_OPTIONS = ("a measurement is compared with a scenario by its own standard errors: the only options are then --columns, "
                 "--sigma, --time-offset, --estimate, --shared, --priors, --free-start, "
                 "--correlation-time, --write-scenario, --force, --set, --svg, --json and --quiet")


def measured(says, options):
    """An option that a comparison with a measurement refuses."""
    return Case(WITH + options, says, scenario="free-gyro", status=2, files=MEASURED)


OF_OPTIONS = [
    *told("--junit and --svg name the same file; give two", both(), 2, command=PAIR + " --junit x --svg x"),
    measured("--write-scenario and --svg name the same file; give two",
             "--estimate spin_rad_s --write-scenario x.json --svg x.json"),
    *told("old.csv: error: is one of the inputs; write to another place", {"old.csv": csv(DRIFT, ROWS),
                                                                              "new.csv": csv(DRIFT, ROWS)}, 2,
          command="compare old.csv new.csv --svg old.csv"),
    measured("--write-scenario writes estimates into the scenario; name them with --estimate", "--write-scenario x.json"),
    measured("there.json: error: already exists, and is not as earthtop wrote it; give another name, or --force to overwrite it", "--estimate spin_rad_s --write-scenario there.json"),
    *[measured(OTHER_OPTIONS, option) for option in ("--profile physics", "--tolerances t.json", "--until 1",
                                                     "--junit j.xml",
                                                     "--allow-change /", "--max-steps-ratio 2", "--max-seconds-ratio 2",
                                                     "--allow-missing")],
    measured("--correlation-time must be above 0 (s); leave it out where errors are independent", "--correlation-time 0"),
    *[case for option in ("--estimate spin_rad_s", "--set /site/latitude_deg=1") for case in told(
        "--estimate and --set belong to a measurement, where REFERENCE is a scenario and NEW a CSV file", both(), 2,
        command=f"{PAIR} {option}")],
    *[case for option in ("--write-scenario x.json", "--correlation-time 1", "--priors") for case in told(
        "--write-scenario, --correlation-time, --priors, --free-start, --columns, --sigma and --time-offset belong to a measurement, where REFERENCE is a scenario and NEW a CSV file",
        both(), 2, command=f"{PAIR} {option}")],
    *told("pictures/: error: is not the name of a file; give the name of a file", both(), 2, command=PAIR + " --svg pictures/"),
    *told("plain: error: is not a directory; give the name of a file in one", {**both(), "plain": "a file"}, 2,
          command=PAIR + " --svg plain/x.svg"),
    *told("--reason belongs to --update, which writes a new reference", both(), 2, command=PAIR + " --reason better"),
    *told('several sections have "locked"; say which: /gimbals/outer/locked, /gimbals/inner/locked', both(), 2,
          command=PAIR + " --allow-change locked"),
]


def studied(says, other=None, status=1, shard="", options="", unless_same=True, study=STUDY, reverse=False):
    """What is said of two stores: of the study, and of another one or of a shard."""
    files = {"a.json": json.dumps(study), "b.json": json.dumps({**study, **(other or {})})}
    stores = "old/study.sqlite " + ("new/shard-1-of-2.sqlite" if shard else "new/study.sqlite")
    if reverse:
        stores = " ".join(reversed(stores.split()))
    commands = ["study a.json --jobs 1 --quiet --out old", f"study b.json --jobs 1 --quiet --out new {shard}",
                f"compare {stores} {options}"]
    cases = [Case(commands, says, scenario=None, files=files, status=status)]
    if unless_same:
        cases.append(Case([commands[0], "compare old old " + options], [], scenario=None, files=files,
                          holds=lambda text: not any(one in text for one in ([says] if isinstance(says, str) else says))))
    return cases


def spins(*values):
    return {"axes": [{"pointer": "/release/spin_rad_s", "values": list(values)}]}


OF_STORES = [
    Case(["study a.json --jobs 1 --quiet --out old", "compare old old --until 3"],
         "--until belongs to a CSV file; studies have no rows over time", scenario=None, status=2, files={"a.json": json.dumps(STUDY)}),
    Case([f"study a.json --jobs 1 --quiet --shard {i}/2 --out {out}" for i, out in ((1, "old"), (2, "new"))] +
         ["compare old/shard-1-of-2.sqlite new/shard-2-of-2.sqlite"],
         ["nothing in common: no point of the new store was compared",
          "missing rows: 2 points are missing in the new store, the first one point 0",
          "extra rows: 1 points are in the new store alone, the first one point 1"], scenario=None,
         files={"a.json": json.dumps(STUDY)}, status=1),
    *studied('top.nutation_kind "of_release" in the reference, "small_amplitude" now',
             {"base": "scenarios/steady-precession-slow.json"},
             options="--allow-change /", study={**STUDY, "collect": ["top.nutation_kind"]}),
    *studied("missing rows: 1 points are missing in the new store, the first one point 1 (spin_rad_s 190)", shard="--shard 1/2"),
    *studied("note: 1 points are missing in the new store, which was allowed", shard="--shard 1/2",
             options="--allow-missing --all", status=0),
    *studied("extra rows: 1 points are in the new store alone, the first one point 1 (spin_rad_s 190)", shard="--shard 1/2",
             reverse=True),
    *studied("other points: 2 points have different values of the axes, the first one point 1 (spin_rad_s 191)",
             spins(180, 191, 201),
             options="--allow-change /"),
    *studied("now; axes, design, quantities or base differ (--allow-change / allows it)", spins(180, 190, 200, 210)),
    *studied("now, which was allowed", spins(180, 190, 200, 210), options="--allow-change / --all"),
    *studied("missing column: drift.verdict is missing in the new store", {"collect": ["drift.axis_final_rad"]},
             options="--allow-change /"),
]

# Two methods agree within the bounds on the rotor's drift; another spin is told by the rotor's own names.
ROTOR_RUNS = ["run s.json --out old --quiet", "run s.json --set {} --out new --quiet", "compare old new --allow-change / --all"]


def rotor_runs(change):
    return [ROTOR_RUNS[0], ROTOR_RUNS[1].format(change), ROTOR_RUNS[2]]


OF_ROTORS = [
    Case(rotor_runs("/numerics/method=rkf78"), ["same: new against old", "drift_rotor_rate_rad_s", "drift_rotor_angle_rad"],
         scenario="hard/g02-general-cage"),
    Case(rotor_runs("/rotor/spin_rad_s=301"),
         ["FAILED rotor_rate_rad_s", "FAILED ref_rotor_angle_rad", "FAILED drift_rotor_axis_rad", "FAILED top.rotor_spin_rad_s"],
         scenario="hard/g02-general-cage", status=1),
]

CASES = [*OF_REFERENCES, *OF_PATHS, *OF_SCENARIOS, *OF_CONCLUSIONS, *OF_HINTS, *OF_ENGINES, *OF_PICTURES, *OF_CHANGES, *OF_FIGURES,
         *OF_MAPPINGS, *OF_TOLERANCES, *OF_ROWS, *OF_ORIGINS, *OF_UPDATES, *OF_OPTIONS, *OF_STORES,
         *OF_ROTORS]
