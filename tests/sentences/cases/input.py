# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a text that is no scenario, of a scenario that contradicts itself, and of files that cannot be read."""
import hashlib
import json

from case import Case, changed


def text(bad, good, says):
    """A scenario in which a value is written wrongly is refused with the sentence; with the value mended it is accepted."""
    whole = json.dumps(changed("toy-top", {"/_value": "@"}))
    files = {f"{name}.json": whole.replace('"@"', value) for name, value in (("bad", bad), ("good", good))}
    return Case("check bad.json good.json", ["bad.json:1:", says, "good.json: ok"], scenario=None, files=files, status=1,
                holds=lambda text: text.count(says) == 1)


def refused(says, changes, unless, scenario="toy-top", **more):
    """A scenario that is refused with the sentence, and is not after a change."""
    return Case("check s.json", says, scenario=scenario, set=changes, unless=unless, status=1, **more)


def table(lines, says, **more):
    """A table of measured values that is refused with the sentence."""
    return Case("compare s.json m.csv", says, scenario="toy-top", files={"m.csv": lines}, status=2, **more)


def platform(rows, says, mended):
    """A table of angles that is refused with the sentence, and a table that is not."""
    changes = {"/platform": {"motion": "table", "file": "angles.csv", "axis": [0, 0, 1]}, "/motion/duration_s": 1,
               "/motion/output_step_s": 0.1}
    return refused(says, changes, {"/platform/file": "mended.csv"},
                   files={"angles.csv": "t_s,angle_rad\n" + rows, "mended.csv": "t_s,angle_rad\n" + mended})


def solid(**members):
    """The changes that make a body of one solid."""
    return {"/body": {"solids": [members]}}


BLOCK = {"/body/inertia/principal_kg_m2": None, "/body/inertia/matrix_kg_m2": [[1.2e-4, 1e-5, 0], [1e-5, 1.2e-4, 0], [0, 0, 4e-5]]}
RAMP = "0,0\n0.5,0.1\n1,0.2\n1.5,0.3\n"
TABLE = "t_s,angle_rad\n" + RAMP
CRITERION = {"kind": "invariant", "quantity": "energy", "tolerance": 1e-9, "why": "closed form"}

CASES = [
    # JSON texts
    text(".5", "0.5", "a number begins with a digit or '-'; write 0.5, not .5 or +0.5"),
    text("+0.5", "0.5", "a number begins with a digit or '-'; write 0.5, not .5 or +0.5"),
    text("'a'", '"a"', "single quotes; JSON strings are written in double quotes"),
    text("True", "true", "\"True\" is not a JSON value; strings are written in double quotes, and the literals are true, false "
                         "and null"),
    text("2e+", "2e5", "an exponent needs a digit, not '}'; write 2e5 or 2e-5"),
    text("1.7977e308", "1.7976931348623157e308",
         "1.7977e308 is too large for a double; the largest is 1.7976931348623157e308"),
    text('"\\q"', '"\\b"', 'an escape that JSON does not have; allowed: \\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX'),
    text('"\\u00e"', '"\\u00e9"', "\\u must be followed by four hexadecimal digits; write \\u00e9"),
    text("[1 2]", "[1, 2]", "unexpected '2'; ',' or ']' is expected here"),
    text("[1, 2,]", "[1, 2]", "a comma after the last element; leave it out"),
    text('{"a": 1,}', '{"a": 1}', "a comma after the last member; leave it out"),
    text("{a: 1}", '{"a": 1}', "unexpected 'a'; a key in double quotes is expected here"),
    Case("check bad.json good.json", ["/title: a NUL character in a string; leave it out", "good.json: ok"], scenario=None,
         files={f"{name}.json": json.dumps(changed("toy-top", {"/title": title}))
                for name, title in (("bad", "a\0b"), ("good", "ab"))}, status=1),
    Case("check t.json", ["t.json:1:", "more than 200000 values; a scenario has far fewer"], scenario=None,
         files={"t.json": json.dumps({"_": [0] * 199_999})}, status=1),
    Case("check s.json --set '/site={\"latitude_deg\": 1, \"latitude_deg\": 2}'",
         "/site/latitude_deg: duplicate key; give it once (from --set)", status=1),
    Case("check s.json --set /~2=3", "/~2: --set: malformed JSON pointer; write --set /site/latitude_deg=45", status=1),
    Case("schema", "Keys that begin with _ or // are comments.", scenario=None),
    Case("schema --study --markdown", "| `base` | as its meaning says | required |", scenario=None),

    # what a key may have
    refused("/body/mass_kg: 0 is out of range; must be a number above 0 and at most 1e+06 (kg)", {"/body/mass_kg": 0},
            {"/body/mass_kg": 1e6}),
    # The limit that is given is rounded to what is allowed, and what is too many is seen to be more than that.
    refused("/motion/output_step_s: about 2000001 output rows; at most 2000000 are allowed: output_step_s must be at least "
            "3.00001e-05 s for this duration", {"/motion/duration_s": 60, "/motion/output_step_s": 3e-5},
            {"/motion/output_step_s": 3.00001e-5}),
    refused("/numerics/step_s: about 2.0000001e+09 steps; at most 2e+09 are allowed: step_s must be at least 3e-08 s for this "
            "duration", {"/motion/duration_s": 60, "/motion/output_step_s": 0.6, "/numerics": {"method": "gauss", "step_s": 2.99999999e-8}},
            {"/numerics": {"method": "gauss", "step_s": 3e-8}}),
    refused("/release/quaternion_LB: has the norm 1.0000010000001; must be 1 to within 1e-06 (it is then normalised)",
            {"/release": {"quaternion_LB": {"w": 1.0000010000001, "x": 0, "y": 0, "z": 0}, "spin_rad_s": 100}},
            {"/release": {"quaternion_LB": {"w": 1.000000999, "x": 0, "y": 0, "z": 0}, "spin_rad_s": 100}}),
    Case("plan s.json --measure tilt_deg --sigma 1 --every 2.0000001",
         "--every: 2.0000001 s is longer than the measurement, 2 s; take a shorter one", set={"/motion/duration_s": 2}, status=2),
    Case("run s.json --json=maybe", "--json takes no value", status=2),
    Case("report c.json", "is not as this program writes it; write it anew (a value is of another kind, or a list has another length)",
         files={"c.json": '{"$schema": "earthtop-comparison-1.json", "pairs": [7]}'}, status=2),
    Case("report p.json", "is not as this program writes it; write it anew (a member is missing: scenario)",
         files={"p.json": '{"$schema": "earthtop-plan-1.json"}'}, status=2),
    Case("study show store.sqlite", "store.sqlite: error: is not a study's store, or is damaged (it is not a database); the same study",
         files={"store.sqlite": "no database" * 100}, status=2),
    refused("/body/inertia/matrix_kg_m2: is an array of 2; must be an array of 3 rows of 3 numbers from -1e+18 to 1e+18 (kg m^2)",
            {**BLOCK, "/body/inertia/matrix_kg_m2": [[1.2e-4, 0, 0], [0, 1.2e-4, 0]]},
            {"/body/inertia/matrix_kg_m2": [[1.2e-4, 0, 0], [0, 1.2e-4, 0], [0, 0, 4e-5]]}),
    refused("/criteria/0/set: is \"/release/spin_rad_s=1\"; must be an array of \"/json/pointer=value\"",
            {"/criteria": [{**CRITERION, "set": "/release/spin_rad_s=1"}]},
            {"/criteria": [{**CRITERION, "set": ["/release/spin_rad_s=100"]}]}),

    # pointers, as a study gives them
    *[Case("study study.json --out studied", f"/axes/0/pointer: {says}", status=2,
           files={"study.json": json.dumps({"base": "s.json", "axes": [{"pointer": pointer, "values": [1]}]})})
      for pointer, says in (("/site/a~2", "/site/a~2: is not a JSON pointer; write e.g. /site/latitude_deg"),
                            ("/site/_a", '/site/_a: "_a" is a comment: it changes nothing'),
                            ("/motion/duration_s/x", "/motion/duration_s/x: /motion/duration_s has no members, so there is no "
                                                     '"x"'))],

    # files
    Case("check /dev/null", "/dev/null: error: is not a regular file; give a file, or '-' and redirect standard input",
         scenario=None, status=2),
    Case("compare s.json /dev/null", "/dev/null: error: is not a regular file; give a file", status=2,
         holds=lambda text: "standard input" not in text),
    Case("check scenarios", "scenarios: error: is a directory; give a scenario file in it", scenario=None, status=2),
    Case("check nothing.json",
         "nothing.json: error: there is no such file; check the path, or give '-' for standard input", scenario=None, status=2),
    Case(f"compare {'a' * 300} s.json", "cannot be examined (File name too long); check path and permissions", status=2),
    Case("check /proc/self/mem", "/proc/self/mem: error: reading failed (Input/output error); check the file", scenario=None,
         status=4),
    Case("compare s.json /proc/self/mem", "/proc/self/mem: error: reading failed (Input/output error); check the file", status=4),

    # tables
    table("", "m.csv: error: is empty; a header line and rows of numbers are needed"),
    table("# nothing\n\n", "m.csv:2:1: error: is empty; a header line and rows of numbers are needed"),
    table("t_s,tilt_deg,tilt_deg,tilt_se_deg\n0,20,20,1\n", 'm.csv:1:1: error: column "tilt_deg" occurs twice in the header; rename one, or leave it out'),
    table("t_s,tilt_deg,tilt_se_deg\n0,20\n", "m.csv:2:1: error: 2 cells, where the header names 3 columns; every column needs a cell in each "
          "row, if an empty one"),
    table("t_s,tilt_deg,tilt_se_deg\n0,20 deg,1\n", '"20 deg" is not a number; write it as 0.1 or 1e-5, without a unit'),
    table("0,20,1\n", "m.csv:1:1: error: the first line has numbers; it must name the columns, as t_s,azimuth_deg,azimuth_se_deg"),
    table("t_s,tilt_deg,tilt_se_deg\n0,2\0000,1\n", "m.csv:2:4: error: a NUL byte; remove it: a table is plain UTF-8 text"),
    table(b"t_s,tilt_deg,tilt_se_deg\n# 20\xb0\n0,20,1\n",
          "m.csv:2:5: error: byte 0xb0 is not valid UTF-8; save the file as UTF-8"),
    platform("0,0\n0.5,1e400\n1,0.2\n1.5,0.3\n",
             'angles.csv:3: angle_rad is "1e400"; must be a finite number that a double can hold, like -1.25e-3',
             "0,0\n0.5,-1.25e-3\n1,0.2\n1.5,0.3\n"),
    platform("0,0\n\n0.5,0.1\n1,0.2\n1.5,0.3\n",
             'angles.csv:3: is empty; must be a row "t_s,angle_rad", or leave it out', RAMP),
    platform("0,0\n0.5,0.1,2\n1,0.2\n1.5,0.3\n",
             'angles.csv:3: is "0.5,0.1,2"; must be two numbers with one comma between them', RAMP),
    platform("0,0\n1,1.01e9\n2,2.02e9\n3,3.03e9\n",
             ["angles.csv:5: up to here the spline reaches 1.01e+09 rad/s and ",
              " rad/s^2; at most 1e+09 are allowed: are the times in seconds and the angles in radians?"],
             "0,0\n1,0.99e9\n2,1.98e9\n3,2.97e9\n"),

    # rules between keys
    refused("/site/gravity_anomaly_m_s2: is counted from normal gravity, and gravity_m_s2 is given; leave one of the two out",
            {"/site/gravity_anomaly_m_s2": 1e-4}, {"/site/gravity_m_s2": None}),
    refused("/uncertainty/viscous_torque_N_m_s: the scenario has no such number: this is the standard error of "
            "effects/viscous_torque_N_m_s, where it is not 0; leave it out",
            {"/uncertainty": {"viscous_torque_N_m_s": 1e-9}}, {"/effects/viscous_torque_N_m_s": 1e-8}),
    refused("/body/solids/0/density_kg_m3: mass_kg and density_kg_m3 are both given; give exactly one",
            solid(shape="sphere", radius_m=0.02, mass_kg=0.1, density_kg_m3=2700, at_m=0.03),
            {"/body/solids/0/density_kg_m3": None}),
    refused("/body/solids/0/length_m: is 0; the length of a cone must be above 0 (m)",
            solid(shape="cone", radius_m=0.02, length_m=0, mass_kg=0.1, at_m=0.03), {"/body/solids/0/length_m": 1e-3}),
    refused("/body/inertia/matrix_kg_m2: is not symmetric: row 1, column 2 is 1e-05, row 2, column 1 is 1.0000000000001e-05; the "
            "two must be equal", {**BLOCK, "/body/inertia/matrix_kg_m2/1/0": 1.0000000000001e-5},
            {"/body/inertia/matrix_kg_m2/1/0": 1e-5}),
    refused("/body/inertia/matrix_kg_m2: principal_kg_m2 and matrix_kg_m2 are both given; give exactly one",
            {"/body/inertia/matrix_kg_m2": BLOCK["/body/inertia/matrix_kg_m2"]}, {"/body/inertia/principal_kg_m2": None}),
    refused("/body/inertia/principal_kg_m2: neither principal_kg_m2 nor matrix_kg_m2 is given; give exactly one",
            {"/body/inertia/principal_kg_m2": None},
            {"/body/inertia/matrix_kg_m2": BLOCK["/body/inertia/matrix_kg_m2"]}),
    refused("/contact/tip_velocity_m_s: the law \"rolling\" starts without slip, at the velocity that the rates give the tip; leave "
            "it out, or take a law of friction", {"/contact": {"tip_radius_m": 1e-3, "law": "rolling", "tip_velocity_m_s": [0, 0]}},
            {"/contact/tip_velocity_m_s": None}),
    refused("/contact/start: the law \"rolling\" starts without slip; must be \"rolling\", or leave it out",
            {"/contact": {"tip_radius_m": 1e-3, "law": "rolling", "start": "tip_at_rest"}}, {"/contact/start": "rolling"}),
    refused("/effects/coulomb_torque_N_m: is not available with /contact: it is friction of a fixed pivot, a torque without a "
            "force; a tip's friction is /contact/law, spinning_friction_m and rolling_resistance_m; leave one of the two out",
            {"/contact": {"tip_radius_m": 1e-3, "law": "frictionless"}, "/effects/coulomb_torque_N_m": 1e-9}, {"/contact": None}),
    refused('/criteria/0/at_s: does not belong to the kind "invariant"; allowed with it: quantity, tolerance',
            {"/criteria": [{**CRITERION, "at_s": 1}]}, {"/criteria/0/at_s": None}),
    refused('/criteria/0/quantity: is "drift_axis_rad"; for the kind "invariant" it must be ',
            {"/criteria": [{**CRITERION, "quantity": "drift_axis_rad"}]}, {"/criteria/0/quantity": "energy"}),
    refused("/effects/tide/tilt_factor: belongs to the tide of Moon and Sun, not to one of given amplitude; leave it out",
            {"/effects/tide": {"amplitude_m_s2": [0, 0, 1e-6], "frequency_hz": 2.3e-5, "tilt_factor": 0.69}},
            {"/effects/tide/tilt_factor": None}),
    refused("/effects/tide/phase_deg: belongs to a tide of given amplitude; give amplitude_m_s2, or leave it out",
            {"/effects/tide": {"phase_deg": 0}, "/motion/start_utc": "2026-01-01T00:00:00Z"}, {"/effects/tide/phase_deg": None}),
    refused('/effects: "auto" chooses by the drift error asked for; give /accuracy/drift_rad', {"/effects": "auto"},
            {"/accuracy/drift_rad": 1e-6}),
    refused("/platform/axis: is the zero vector, or nearly; must have a direction, best with length 1",
            {"/platform": {"motion": "constant", "rate_rad_s": 0.1, "axis": [0, 0, 1e-151]}}, {"/platform/axis/2": 1e-149}),
    refused("/release/quaternion_LB: tilt_deg and quaternion_LB are both given; give exactly one",
            {"/release": {"tilt_deg": 20, "spin_rad_s": 200, "quaternion_LB": {"w": 1, "x": 0, "y": 0, "z": 0}}},
            {"/release/tilt_deg": None}),
    refused('/numerics/relative_tolerance: "gauss" finds its step from it where no step_s is given; give one of the two',
            {"/numerics": {"method": "gauss", "relative_tolerance": 1e-12, "step_s": 0.001}},
            {"/numerics/relative_tolerance": None}),
    refused("/headline/quantity: there is no threshold to pass; give /report/threshold_rad",
            {"/headline": {"quantity": "drift.threshold_time_s", "value": 1, "tolerance": 1, "origin": "theory"}},
            {"/report": {"threshold_rad": 1e-4}}),
    refused("/headline/at_s: belongs to a column of trajectory.csv; a figure of summary.json has no time",
            {"/headline/quantity": "drift.axis_max_rad", "/headline/at_s": 60}, {"/headline/at_s": None}),
    Case("check s.json", "/headline/at_s: is not the time of a row, which is a multiple of output_step_s within the duration: the "
         "figure cannot be checked", set={"/headline/at_s": 30.05}, unless={"/headline/at_s": 30.1}),
    refused("/effects/polar_motion: is looked up by date; give /motion/start_utc, or the values themselves",
            {"/effects/polar_motion": True}, {"/motion/start_utc": "2026-01-01T00:00:00Z"}),
    refused('/motion/start_utc: is "2026-02-29T00:00:00Z"; must be an instant of UTC, YYYY-MM-DDThh:mm:ssZ',
            {"/motion/start_utc": "2026-02-29T00:00:00Z"}, {"/motion/start_utc": "2028-02-29T00:00:00Z"}),
    refused("/body/solids/0/inner_radius_m: 0.0201 is larger than radius_m, 0.02",
            solid(shape="ring", radius_m=0.02, inner_radius_m=0.0201, length_m=0.01, mass_kg=0.1, at_m=0.03),
            {"/body/solids/0/inner_radius_m": 0.02}),
    refused("/platform/file: names no file; must be the path of a CSV file", {"/platform": {"motion": "table", "file": ""}},
            {"/platform": None}),
    refused(f"/platform/file_sha256: is not that of angles.csv, {hashlib.sha256(TABLE.encode()).hexdigest()}; use the file that was "
            "meant, or leave this key out",
            {"/platform": {"motion": "table", "file": "angles.csv", "file_sha256": "0" * 64}, "/motion/duration_s": 1},
            {"/platform/file_sha256": hashlib.sha256(TABLE.encode()).hexdigest()}, files={"angles.csv": TABLE}),
    platform(RAMP.replace("0,0", "0.1,0"), "angles.csv:2: the table begins at 0.1 s; it must begin at 0 s, the release, or before",
             RAMP.replace("0,0", "-0.1,0")),
]
