# SPDX-License-Identifier: GPL-3.0-or-later
"""What `compare` says of a measurement, and `plan` of a planned one."""
import json
import math
import re

from case import Case

GYRO = "free-gyro"  # balanced, released level towards East at 45 degrees North: its azimuth grows as the Earth turns under it
OMEGA = 7.292115e-5  # rad/s
SHORT = {"/motion": {"duration_s": 2}, "/headline": None}  # of the toy top
TILTS = "t_s,tilt_deg,tilt_se_deg\n0,20,0.1\n1,20.1,0.1\n2,20,0.1\n"
AZIMUTHS = "t_s,azimuth_deg,azimuth_se_deg\n0,90,0.01\n10,90.02,0.01\n30,90.09,0.01\n60,90.177,0.01\n"
ONE_STEP = {"/numerics": {"method": "gauss", "step_s": 1}, "/motion/output_step_s": 1}  # too long a step for the toy top
NO_NUTATION = {"/earth": {"rotation_rate_rad_s": 0}, "/release/precession": "steady_slow"}
NO_PRECESSION = {"/release/precession": "steady_slow"}  # it needs equal moments I1 and I2


def azimuth(value, error=0.01, t_s=0):
    return f"t_s,azimuth_deg,azimuth_se_deg\n{t_s},{value},{error}\n"


def gyro_azimuth_deg(t_s):
    """The axis turns by -Omega t about the celestial axis, to which the released one is perpendicular."""
    turned = OMEGA * t_s
    return math.degrees(math.atan2(math.cos(turned), -math.sin(turned) * math.sqrt(0.5)))


def gyro_tilt_deg(t_s):
    """The same motion's tilt: the axis rises as a star in the East does."""
    return math.degrees(math.acos(math.sin(OMEGA * t_s) * math.sqrt(0.5)))


OFF_ZERO = "t_s,azimuth_deg,azimuth_se_deg,tilt_deg,tilt_se_deg\n" + "".join(
    f"{t},{gyro_azimuth_deg(t) + 0.5},0.001,{gyro_tilt_deg(t)},0.001\n" for t in range(0, 60, 3))  # the circle's zero is wrong
BEYOND = "t_s,azimuth_deg,azimuth_se_deg,tilt_deg,tilt_se_deg\n" + "".join(  # as if the pole were passed, at 93 degrees
    f"{t},{math.degrees(math.atan2(math.cos(OMEGA * t), -math.sin(OMEGA * t) * math.sin(math.radians(93))))},6e-4,"
    f"{math.degrees(math.acos(math.sin(OMEGA * t) * math.cos(math.radians(93))))},6e-4\n" for t in range(60, 660, 60))
OPPOSITE = "t_s,azimuth_deg,azimuth_se_deg\n" + "".join(f"{t},{90 + 180 * (t // 3 % 2)},0.01\n" for t in range(0, 60, 3))


def compared(options, says, data, scenario="toy-top", **more):
    """A scenario compared with a measurement."""
    if scenario == "toy-top":
        more["set"] = {**SHORT, **more.get("set", {})}
    return Case(f"compare s.json m.csv {options}", says, scenario=scenario, files={"m.csv": data, **more.pop("beside", {})}, **more)


def planned(options, says, scenario=GYRO, **more):
    """A measurement planned, of the azimuth where nothing else is said."""
    if scenario == "toy-top":
        more["set"] = {**SHORT, **more.get("set", {})}
    what = "" if "--measure" in options else "--measure azimuth_deg --sigma 0.01 --every 1 "
    return Case(f"plan s.json {what}{options}", says, scenario=scenario, **more)


def numbers(text, pattern):
    """The numbers in a sentence."""
    found = re.search(pattern.replace("#", r"([-+]?[0-9.]+(?:e[-+]?[0-9]+)?)"), text)
    return [float(number) for number in found.groups()] if found else []


def near(text, pattern, *expected, part=1e-3):
    found = numbers(text, pattern)
    return len(found) == len(expected) and all(abs(a - b) <= part * abs(b) for a, b in zip(found, expected))


def document(quantity="azimuth"):
    """What `compare --json` writes, with three residuals, one of them large."""
    residuals = [{"t_s": t, "quantity": quantity, "line": 2, "measured_rad": 0.1 + r, "predicted_rad": 0.1, "residual_rad": r,
                  "standard_error_rad": 0.01, "normalised": r / 0.01} for t, r in ((0, 0.01), (1, -0.01), (2, 0.0501))]
    chi_squared = {"value": 27.1, "degrees_of_freedom": 3, "per_degree_of_freedom": 9.0, "p_value": 5.6e-6, "of_priors": 0}
    return json.dumps({"$schema": "earthtop-measurement-1.json", "scenario": {"name": "top", "sha256": "0" * 64}, "file": "m.csv",
                       "rows": 3, "quantities": [{"name": quantity, "values": 3}], "agrees": False, "least_p_value": 0.001,
                       "prediction": {"status": "completed", "reached_s": 2, "verdict": "reliable"},
                       "chi_squared": {"as_given": chi_squared, "fitted": None},
                       "fit": {"outcome": "not_asked", "reason": "", "iterations": 0, "predictions": 1}, "estimates": [],
                       "correlation": [], "priors": [], "unused_priors": [], "correlation_time_s": None,
                       "largest_residual": residuals[2], "residuals_of": "as_given", "residuals": residuals, "curve": None,
                       "notes": []})


def releases(options, says, pairs="s.json m.csv s.json m.csv", data=TILTS, **more):
    """Several releases compared, by default twice the same."""
    more["set"] = {**SHORT, **more.get("set", {})}
    return Case(f"compare {pairs} {options}", says, files={"m.csv": data, **more.pop("beside", {})}, **more)


def listed(text, says, options="", **more):
    """A release list compared."""
    return releases(options, says, pairs="list.json", beside={"list.json": text}, **more)


PAIR = '{"releases": [{"scenario": "s.json", "measurement": "m.csv"}, {"scenario": "s.json", "measurement": "m.csv"}]}'
TABLE = {"/platform": {"motion": "table", "file": "angles.csv", "axis": [0, 0, 1]}}
ANGLES = "t_s,angle_rad\n0,0\n1,0.1\n2,0.2\n3,0.3\n"
RIM = {"/contact": {"tip_radius_m": 0.002, "law": "frictionless", "max_tilt_deg": 20.05}}  # it comes to 20.05 degrees at once
RIM_TOUCHES = " s the tilt exceeds the largest one allowed, and the rim touches the table: the run ends; "
CHAOS = "hard/h11-chaotic"
AXES = "t_s,axis_L_x,axis_L_y,axis_L_z,axis_se_deg,drift_azimuth_deg,drift_azimuth_se_deg,drift_tilt_deg,drift_tilt_se_deg\n" \
       "0,1,0,0,0.1,0,0.1,0,0.1\n60,1,0,0,0.1,0.2,0.1,0,0.1\n"

CASES = [
    # files of measured values
    compared("", "there is no column t_s, t_ms or t_min, the time since the release; if it has another name, say --columns NAME=t_s",
             "tilt_deg,tilt_se_deg\n20,1\n", status=2),
    compared("", "m.csv:2:1: error: there is no measured value; a row needs a time, a value and its standard error",
             "t_s,tilt_deg,tilt_se_deg\n0,,\n", status=2),
    compared("", "m.csv:200002:1: error: more than 200000 rows; average neighbouring ones",
             "t_s,tilt_deg,tilt_se_deg\n" + "0,20,1\n" * 200_001, status=2),
    Case("report m.json", "is not as this program writes it; write it anew (not a measured quantity: "
         "speed)", scenario=None, files={"m.json": document("speed")}, status=2),

    # tables as instruments write them
    compared("--columns a=tilt_deg", "--columns a: is tilt_deg then, as \"tilt_deg\" is; keep one", "t_s,tilt_deg,a\n0,20,1\n", status=2),
    compared("--sigma tilt_deg=1 --sigma tilt_rad=1", "--sigma tilt_rad=1: tilt_deg=1 is given, too; keep one", TILTS, status=2),
    compared("", "columns t_s and t_ms both give the time; keep one", "t_s,t_ms,tilt_deg,tilt_se_deg\n0,0,20,1\n", status=2),
    compared("--sigma tilt_deg=1", "--sigma tilt_deg=1: column tilt_se_deg gives standard errors; leave one of them out", TILTS, status=2),
    compared("", "extreme is given without a turning point, as azimuth_turning_deg", "t_s,tilt_deg,tilt_se_deg,extreme\n0,20,1,max\n",
             status=2),
    compared("", "passage_turns is given without passage_s", "t_s,tilt_deg,tilt_se_deg,passage_turns\n0,20,1,1\n", status=2),
    compared("--columns tilt_deg=tilt_deg:mathematical",
             'tilt_deg is not counted as "mathematical"; allowed are elevation, from_down, reversed', TILTS, status=2),
    compared("--columns t_s=t_s:reversed", "t_s has no other sense; leave out what follows the colon", TILTS, status=2),
    compared("--time-offset 5", ["m.csv:4:1: error: all rows are before the release, which --time-offset puts at 5 s"], TILTS, status=2),
    compared("--time-offset 0.5", "1 row is left out: before the release, 0.5 s by the clock of the file", TILTS, status=1),
    compared("", "the numbers of line 2 a decimal comma; write all with the same sign, and no sign between thousands",
             "t_s;tilt_deg;tilt_se_deg\n0;20,0;0,1\n1;20.1;0,1\n", status=2),
    compared("", 'columns not read: "temperature", "humidity"', "t_s,temperature,tilt_deg,tilt_se_deg,humidity\n0,20,20,1,50\n"),
    compared("", "t_s must be a number from 0, the release, to 1e+09 (s); if the clock shows another time at the release, say "
             "--time-offset T", "t_s,tilt_deg,tilt_se_deg\n-1,20,1\n", status=2),
    compared("", "must be a time above 0, and at most 1e+09 (s), after the release", "passage_s,passage_se_s\n-1,1\n", status=2),
    compared("--columns tilt_deg=tip_L_x_m,tilt_se_deg=tip_L_x_se_m",
             "tip_L_x was measured, and the top does not stand on a table; give it /contact, or leave the column out", TILTS, status=2),
    compared("--columns tilt_deg=tilt_turning_deg,tilt_se_deg=tilt_turning_se_deg",
             "tilt_turning was measured at 0 s, and there is no turning point near this time, or leave the row out", TILTS, status=2,
             set=NO_NUTATION),
    compared("", "precession_period was measured, and the azimuth of the axis does not go round within sixteen times that time, or leave "
             "the column out", "t_s,precession_period_s,precession_period_se_s\n0,1e-3,1\n", status=2),
    compared("--columns tilt_deg=swing_major_deg,tilt_se_deg=swing_major_se_deg",
             "swing_major was measured, and only a symmetric body on a pivot that swings below it, and does not go round in a circle, has "
             "such an ellipse, or leave the column out", TILTS, status=2),
    *[Case(f"compare s.json m.csv --svg p.svg --sigma {column}=0.001", spoken, scenario=scenario, page="p.svg", status=1,
           files={"m.csv": f"t_s,{column}\n0.5,1\n1,1\n"}, set={"/headline": None, "/criteria": None})
      for scenario, column, spoken in (
          ("toy-top", "spin_rad_s", "Spin"), ("toy-top", "w_LB_B_x_rad_s", "Rate about body axis 1, in the laboratory"),
          ("toy-top", "w_LB_B_y_rad_s", "Rate about body axis 2, in the laboratory"),
          ("toy-top", "w_LB_B_z_rad_s", "Rate about body axis 3, in the laboratory"),
          ("toy-top", "w_IB_B_x_rad_s", "Inertial rate about body axis 1"),
          ("toy-top", "w_IB_B_y_rad_s", "Inertial rate about body axis 2"),
          ("toy-top", "w_IB_B_z_rad_s", "Inertial rate about body axis 3"),
          ("toy-top", "tilt_turning_deg", "Turning point in tilt"), ("toy-top", "azimuth_turning_deg", "Turning point in azimuth"),
          ("toy-top", "precession_period_s", "Time of a turn of the axis"), ("toy-top", "passage_s", "Time of a passage"),
          ("toy-top-on-table", "tip_L_x_m", "Tip to East"), ("toy-top-on-table", "tip_L_y_m", "Tip to North"),
          ("foucault-pendulum", "swing_azimuth_deg", "Azimuth of the swing's plane"),
          ("foucault-pendulum", "swing_major_deg", "Major semi-axis of the swing"),
          ("foucault-pendulum", "swing_minor_deg", "Minor semi-axis of the swing"),
          ("gyrotheodolite", "outer_angle_turning_deg", "Turning point of the outer gimbal"),
          ("through-gimbal-lock", "inner_angle_turning_deg", "Turning point of the inner gimbal"))],

    # what can be estimated
    compared("--estimate tilt_deg --estimate spin_rad_s --estimate gravity_m_s2 --estimate latitude_deg --estimate inertia_ratio "
             "--estimate center_of_mass_m --estimate rotation_rate_rad_s --estimate /release/azimuth_deg --estimate /body/mass_kg",
             "--estimate /body/mass_kg: at most 8 numbers can be estimated at once", TILTS, status=2),
    compared("--estimate /release/spin_rpm --estimate spin_rad_s",
             "--estimate /release/spin_rpm: is the spin in another unit; estimate either it or spin_rad_s", TILTS, status=2,
             set={"/release/spin_rad_s": None, "/release/spin_rpm": 1910}),
    compared("--estimate /travel/speed_kn --estimate travel_speed_m_s", "is the speed at the start in another unit; estimate either",
             TILTS, status=2, set={"/travel": {"path": "rhumb", "course_deg": 0, "speed_kn": 20}}),
    compared("--estimate travel_course_deg", "the course at the start is ", TILTS, status=1,
             set={"/travel": {"path": "rhumb", "course_deg": 0, "speed_kn": 20}}),
    compared("--estimate /release/spin_rpm",
             "--estimate /release/spin_rpm: is not in the scenario; add it there, with the value from which to start", TILTS,
             status=2, unless={"/release/spin_rad_s": None, "/release/spin_rpm": 1910}),
    compared("--estimate pivot_offset_m",
             "--estimate pivot_offset_m: is no single number; estimate its parts, e.g. /platform/pivot_offset_m/0", TILTS,
             status=2, holds=lambda text: "did you mean" not in text),
    compared("--estimate platform_rate_rad_s", '/platform/motion: is missing; must be "constant", "ramp", "harmonic", "table"',
             TILTS, status=2, holds=lambda text: "--set" not in text),
    compared("--priors", "--priors: applies only to numbers that are estimated; name them with --estimate", TILTS, status=2),
    compared("", "/effects: the choice of effects is left to the program; to compare with a measurement, name them", TILTS, status=2,
             set={"/effects": "auto", "/accuracy/drift_rad": 1e-6}, unless={"/effects": {"coriolis": True}}),

    # the fitted scenario
    compared("--estimate tilt_deg --write-scenario other/f.json",
             "the scenario would be a different one there: does it name a file in its own directory?", TILTS, status=2, set=TABLE,
             beside={"angles.csv": ANGLES, "other/angles.csv": ANGLES.replace("0.3", "0.31")}),
    compared("--estimate spin_rad_s --write-scenario f.json", "Written f.json", TILTS, page="f.json",
             set={"/release/spin_rad_s": None, "/release/spin_rpm": 1910},
             holds=lambda text: '"spin_rad_s": 209.' in text and '"spin_rpm"' not in text),
    compared("--estimate omega_sin_latitude_rad_s --write-scenario f.json", "Written f.json", AZIMUTHS, scenario=GYRO, page="f.json",
             set={"/site/gravity_m_s2": None, "/site/gravity_anomaly_m_s2": 1e-4},
             holds=lambda text: '"gravity_m_s2": 9.80' in text and '"gravity_anomaly_m_s2"' not in text),

    # a fit that is far off: its ways, what would mend it, and a minimum that is none
    compared("--estimate tilt_deg", ["; 2 ways were tried, and the lowest of 2 minima taken",
                                     "Note the start was far off, and the residuals scatter by more than their errors: the minimum may be "
                                     "a false one, and its error bars then mean nothing; start nearer, or estimate what a hint names"],
             OFF_ZERO, scenario=GYRO, status=1, unless={"/instrument/azimuth_zero_deg": 0.5}),
    compared("--estimate tilt_deg", "would leave chi-squared", OFF_ZERO, scenario=GYRO, status=1,
             holds=lambda text: near(text, r"Hint /instrument/azimuth_zero_deg = # ±", 0.5)),
    compared("--estimate rotation_rate_rad_s",
             "Fit false_minimum: the least sum of squares that was found,", OPPOSITE, scenario=GYRO, status=1,
             holds=lambda text: "leaves angles off by more than a quarter turn: it is no answer, and says nothing of errors" in text),
    compared("--estimate tilt_deg --priors", "Prior /instrument/clock_rate did not enter: it is not estimated; add --estimate "
             "/instrument/clock_rate to use it", TILTS, status=1, set={"/uncertainty": {"tilt_deg": 1}, "/instrument/clock_rate_se": 0.1}),

    compared("--estimate latitude_deg", "latitude_deg is at the end of its range", BEYOND, scenario=GYRO, status=1,
             set={"/site/latitude_deg": 89, "/motion/duration_s": 600, "/headline": None}),

    # agreement; one value 3 and 3.3 standard errors off
    compared("", "As given chi-squared 9 of 1 degree of freedom, p-value 0.0027 Agreement yes", azimuth(90.03), scenario=GYRO,
             holds=lambda text: abs(math.erfc(3 / math.sqrt(2)) - 0.0027) < 5e-6),
    compared("", "As given chi-squared 18 of 2 degrees of freedom", azimuth(90.03) + "0,90.03,0.01\n", scenario=GYRO, status=1),
    compared("", "Agreement no: the p-value is below 0.001", azimuth(90.033), scenario=GYRO, status=1,
             unless={"/release/azimuth_deg": 90.001}),
    compared("--estimate spin_rad_s",
             ["Prediction ended at 0 s: not_converged", "prediction_failed: the scenario's own motion ended with not_converged",
              "Agreement no: the prediction does not reach the last row"], TILTS, status=3, set=ONE_STEP,
             unless={"/numerics/step_s": 0.001}),
    compared("", "Residuals, measured less predicted t_s quantity residual_rad st_error_rad st. errors 0 azimuth +5.2360e-04 "
                 "1.7453e-04 +3.000", azimuth(90.03), scenario=GYRO),
    compared("--estimate tilt_deg --priors", "Prior latitude_deg did not enter: it is not estimated; add --estimate latitude_deg to "
             "use it", TILTS, status=1, set={"/uncertainty": {"latitude_deg": 1, "tilt_deg": 1}},
             unless={"/uncertainty/latitude_deg": None}),
    compared("", "Note the scatter is smaller than the standard errors would make it: are they too large, or are the rows averages?",
             "t_s,azimuth_deg,azimuth_se_deg\n" + "".join(f"{t},{gyro_azimuth_deg(t)},0.01\n" for t in range(0, 60, 6)),
             scenario=GYRO, unless={"/release/azimuth_deg": 90.005}),
    compared("", "Note an azimuth is off by more than a quarter turn: is it counted clockwise from North?", azimuth(180.1),
             scenario=GYRO, status=1, unless={"/release/azimuth_deg": 90.2}),
    compared("--estimate /release/spin_angle_deg", "an azimuth is off by more than a quarter turn: is it counted clockwise from North, "
             "and does the fit start close enough?", azimuth(180.1), scenario=GYRO, status=1, unless={"/release/azimuth_deg": 90.2}),

    # rows without a prediction
    compared("", "m.csv:2:1: error: at 0 s the predicted axis is vertical and has no azimuth; leave the cell empty, or measure "
             "axis_L_x, _y, _z", azimuth(90), scenario=GYRO, status=2, set={"/release/tilt_deg": 0},
             unless={"/release/tilt_deg": 1}),
    compared("", ["m.csv:3:1: error: at 0.00", RIM_TOUCHES + "leave out later rows"], TILTS, status=2, set=RIM,
             unless={"/contact/max_tilt_deg": 90}),
    compared("", "As given chi-squared ", TILTS.split("1,20.1")[0], set=RIM),
    compared("", ["m.csv:3:1: error: after 6.2", " s the scenario's motion is chaotic, and its prediction means nothing: ",
                  "; leave out later rows"], "t_s,tilt_deg,tilt_se_deg\n6,20,1\n7,20,1\n", scenario=CHAOS, status=2),
    compared("", "Measured 1 rows: 1 of tilt", "t_s,tilt_deg,tilt_se_deg\n6,20,1\n", scenario=CHAOS, status=1),
    compared("", ["m.csv:3:1: error: after 1.9", " s the scenario's motion is unstable, and its prediction means nothing: ",
                  "; leave out the rows from then to 3.4"], "t_s,tilt_deg,tilt_se_deg\n0,0,1\n3,0,1\n6,0,1\n", scenario="tippe-top",
             status=2, set={"/release/tilt_deg": 5e-7}, unless={"/release/tilt_deg": 1}),
    compared("", "Measured 2 rows: 2 of tilt", "t_s,tilt_deg,tilt_se_deg\n1.9,0,1\n3.6,0,1\n", scenario="tippe-top", status=1,
             set={"/release/tilt_deg": 5e-7}),
    compared("--estimate /body/inertia/principal_kg_m2/0",
             "Fit prediction_failed: there is no prediction next to the values from which the fit starts", TILTS, status=1,
             set=NO_PRECESSION, unless={"/release/precession": "none"}),

    # what was taken as exact
    Case(["plan s.json --measure axis_deg --sigma 0.01 --every 0.5 --until 10 --write-data m.csv --quiet",
          "compare s.json m.csv --estimate spin_rad_s --set '/uncertainty={\"gravity_m_s2\": 0.01}'"],
         ["Taken as exact: errors that would move spin_rad_s by one sigma", "; it is stated to ± 0.01, "]),

    # what estimates are called
    *[compared(f"--estimate {name}", f"{spoken} is ", TILTS, status=status)
      for name, spoken, status in (("tilt_deg", "the tilt at release", 1), ("/release/tilt_deg", "the tilt at release", 1),
                                   ("inertia_ratio", "the ratio I3/I1 of the moments about the pivot, with I1 and I2 held,", 0),
                                   ("center_of_mass_m", "the distance of the centre of mass, with the moments about the pivot held,", 0))],
    compared("--estimate /release/azimuth_deg", "the azimuth at release is 89.9979 ± 0.0050 deg", AZIMUTHS, scenario=GYRO),
    compared("--estimate /release/spin_angle_deg", "the spin angle at release is ", 
             "t_s,tilt_deg,tilt_se_deg\n0,20,1\n0.05,21,1\n0.1,20.5,1\n1,20,1\n",
             set={"/body/inertia/principal_kg_m2": [1.2e-4, 1.1e-4, 4e-5]}),

    # to quote
    compared("--estimate rotation_rate_rad_s", [
        "To quote A weighted least-squares fit with earthtop 1.0.0 to 4 values (azimuth) up to 60 s after the release gave rotation_rate_rad_s = ",
        "; chi-squared was ", " for 3 degrees of freedom (p = ", "The errors are one standard deviation (k = 1) and follow from the stated errors "
        "of the values, which were taken as independent.", "All other inputs were taken as exact; rotation_rate_rad_s would move by its "
        "standard deviation if one of these were wrong: "], AZIMUTHS, scenario=GYRO, unless={"/release/azimuth_deg": 91}),
    compared("--estimate rotation_rate_rad_s --correlation-time 5", "which were taken as correlated over 5 s", AZIMUTHS, scenario=GYRO),
    compared("--estimate latitude_deg --priors", "Known beforehand, with the standard errors in brackets: latitude_deg (2 deg).", AZIMUTHS,
             scenario=GYRO, set={"/uncertainty": {"latitude_deg": 2}}),
    compared("--free-start", "--free-start: needs a top on a fixed pivot whose release is given by tilt_deg and azimuth_deg", TILTS, set=RIM,
             status=2, unless={"/contact": None}),

    # several releases
    releases("--estimate tilt_deg", ["2 releases, one fit Release 1 m.csv against ", "tilt_deg of release 2 19.0", "in release 2, the tilt at "
                                     "release is ", "; chi-squared "], status=1),
    releases("", "; the prediction ended at 0 s: not_converged", set=ONE_STEP, status=3),
    releases("--shared spin_rad_s", "the spin is ", holds=lambda text: "of release" not in text.split("Taken as exact")[0]),
    releases("", "5 files; several releases are named by a scenario and a CSV file each, in turns: earthtop compare A.json a.csv B.json b.csv",
             pairs="s.json m.csv s.json m.csv s.json", status=2),
    releases("--shared tilt_deg", "--shared: is for several releases; for one, name all numbers with --estimate", pairs="s.json m.csv", status=2),
    releases("--svg p.svg", "--write-scenario and --svg are for one release; for several, keep what --json prints, and make a page of it with "
             "earthtop report", status=2),
    Case("compare a.csv b.csv --shared tilt_deg", "--shared belongs to several releases, each a scenario and a CSV file", status=2,
         files={"a.csv": TILTS, "b.csv": TILTS}),
    Case("compare a.csv b.csv c.csv", "c.csv is one too many: only releases are more than two files",
         status=2, files={"a.csv": TILTS, "b.csv": TILTS, "c.csv": TILTS}),
    Case("compare a.csv", "NEW is required", status=2, files={"a.csv": TILTS}),
    Case("compare " + "s.json m.csv " * 65, "65 releases; from 1 to 64 can be compared at once", status=2, set=SHORT, files={"m.csv": TILTS}),
    listed(PAIR, "2 releases, one fit", options="--estimate tilt_deg", status=1),
    Case(["compare s.json m.csv s.json m.csv --estimate tilt_deg --json > r.json", "report r.json --out r.html"],
         ["2 releases, one fit", "2 releases compared with their scenarios by one fit: they do not agree.", "Residuals after the fit of release 2"],
         files={"m.csv": TILTS}, set=SHORT, page="r.html"),

    listed('{"releases": []}', "/releases: must have at least one release", status=2),
    listed('{"releases": [{"scenario": ""}]}', "/releases/0/scenario: must be the path of a file", status=2),
    listed('{"shared": 3, "releases": [{"scenario": "s.json"}]}', '/shared: must be an array of names, e.g. ["spin_rad_s"]', status=2),
    listed('{"releases": [{"scenario": "s.json"}]}', 'the release of s.json has no measurement; add "measurement"', status=2,
           holds=lambda text: "release list" not in text),
    listed('{"releases": [{"scenario": "s.json", "mass": 1}]}', "/releases/0/mass: unknown key; allowed here: scenario, measurement, columns, sigma, time_offset_s, set, estimate",
           status=2),
    Case("schema --releases --markdown", [
        "what was measured", "names of numbers that are estimated for each release, as --estimate takes them",
        "names of numbers that are estimated and have one value in all releases", "its scenario: a file, its path relative to this one",
        "what was measured: a CSV file, its path relative to this one; not needed for a plan",
        'what its columns are, as --columns takes it, e.g. ["phi=azimuth_deg"]', 'standard errors, as --sigma takes them, e.g. ["azimuth_deg=0.2"]',
        'changes to its scenario, e.g. ["/release/spin_rpm=-2400"]', "names of numbers that are estimated for this release alone"]),
    Case("schema --releases", ["version of this format", "Releases of a top and their measurements, which one fit evaluates."]),

    # the picture
    compared("--svg p.svg", ["m.csv and free-gyro", "Measured values with their standard errors, and the model as the scenario gives it",
                             "Azimuth of the axis", "Tilt of the axis", "Drift in azimuth", "Drift in tilt",
                             "Drift in tilt: measured minus model", "Time since release (s)"], AXES, scenario=GYRO, page="p.svg"),
    compared("--svg p.svg --estimate tilt_deg", "and the model with the fitted numbers", TILTS, status=1, page="p.svg"),
    Case("compare s.json m.csv --svg p.svg", "model, the mean of its swings", status=1, page="p.svg",
         files={"m.csv": azimuth(90, 1, 0) + "1000,90,1\n3000,90,1\n"}),
    compared("--svg p.svg", "model", azimuth(90) + "1,90,1\n", page="p.svg", status=1,
             holds=lambda text: "the mean of its swings" not in text),
    Case("report m.json --out m.html", ["How often each size occurs", "Number of values", "expected of the stated errors",
                                        "1 of 3 values lie beyond 5 standard errors and are counted in the bins at the ends"],
         scenario=None, files={"m.json": document()}, page="m.html"),

    # plans
    planned("--set '/uncertainty={\"latitude_deg\": 1}'",
            "the stated uncertainty of latitude_deg says how well omega_sin_latitude_rad_s is known; it is no datum"),
    planned("--measure tilt_deg --sigma 1 --every 1",
            "Note the stated uncertainty of pivot_offset_m is not used: pivot_offset_m: is no single number; estimate its parts, e.g. "
            "/platform/pivot_offset_m/0", scenario="toy-top",
            set={"/platform": {"motion": "constant", "rate_rad_s": 0.1, "pivot_offset_m": [0.3, 0, 0]},
                 "/uncertainty": {"pivot_offset_m": 1e-3}}, unless={"/uncertainty": None}),
    planned("--estimate tilt_deg --nuisance /release/azimuth_deg", "tilt_deg would be known to ± ", scenario="toy-top"),
    planned("", "A measurement of free-gyro Measured azimuth_deg ± 0.01, every 1 s to 60 s: 61 rows Predicted"),
    planned("--correlation-time 5", "every 1 s to 60 s: 61 rows; errors correlated over 5 s"),
    planned("", "Standard error of omega_sin_latitude_rad_s (rad/s): duration, rows, sigma to 7.5 s, 8 rows",
            # the azimuth grows by the vertical rate times the time
            holds=lambda text: near(text, r"to 60 s, 61 rows # 1 times",
                                    math.radians(0.01) / math.sqrt(60 * 61 * 121 / 6), part=1e-3)),
    planned("--optimise /motion/duration_s=10:50",
            ["Best within the limits, ", "/motion/duration_s 50, from 10 to 50, at the limit; the scenario's is 60",
             " times larger than now; 51 rows"],
            holds=lambda text: near(text, r": # sigma, # times larger than now", OMEGA * math.sqrt(0.5) / math.radians(0.01)
                                    * math.sqrt(50 * 51 * 101 / 6), math.sqrt(60 * 61 * 121 / (50 * 51 * 101)), part=5e-3)
            and "in vain" not in text),
    planned("--optimise /motion/duration_s=10:120", [" times smaller than now; 121 rows"],
            holds=lambda text: near(text, r" sigma, # times smaller than now", math.sqrt(120 * 121 * 241 / (60 * 61 * 121)),
                                    part=5e-3)),
    planned("--optimise /motion/duration_s=30:60", "as large as now; 61 rows"),
    planned("--measure tilt_deg --sigma 1 --every 0.5 --until 2 --optimise /release/spin_rad_s=20:300",
            [" of them in vain: no motion to rely on, or numbers not determined"], scenario="steady-precession-slow",
            unless={"/release/precession": "none"}),
    planned("--measure tilt_deg --sigma 1 --every 0.5 --until 2 --optimise /release/spin_rad_s=20:30",
            "Note no design within the limits has a motion that can be relied on and determines all numbers",
            scenario="steady-precession-slow", unless={"/release/precession": "none"}),
    planned("--nuisance gravity_m_s2", ["these data would not determine gravity_m_s2",
                                        "Remedy Measure another quantity, or leave gravity_m_s2 out."], status=1),
    planned("--estimate rotation_rate_rad_s --estimate latitude_deg",
            ["these data would not tell apart rotation_rate_rad_s, latitude_deg a change that would not be seen: "
             "rotation_rate_rad_s by -",
             "Remedy Say in the scenario's uncertainty block how well one of them is known, leave one out, or measure another "
             "quantity."], status=1, unless={"/uncertainty": {"latitude_deg": 0.1}},
            # the vertical rate stays: d Omega / Omega = -cot(latitude) d latitude
            holds=lambda text: -0.99 > (lambda rate, degrees: rate / OMEGA / math.radians(degrees))(
                *numbers(text, r"rotation_rate_rad_s by #, latitude_deg by #")) > -1.01),
    planned("--estimate /body/inertia/principal_kg_m2/0 --measure tilt_deg --sigma 1 --every 1",
            "Outcome prediction_failed: there is no prediction next to the scenario's numbers", scenario="toy-top", status=3,
            set=NO_PRECESSION, unless={"/release/precession": "none"}),
    planned("--measure tilt_deg --sigma 1 --every 1 --write-data d.csv",
            ["Outcome prediction_failed: the scenario's own motion ended with not_converged",
             "d.csv is not written: the scenario's own motion ended with not_converged"], scenario="toy-top", status=3, set=ONE_STEP,
            unless={"/numerics/step_s": 0.001}),
    planned("--measure tilt_deg --sigma 1 --every 1 --estimate gravity_m_s2",
            ["--until: after 6.2", " s the scenario's motion is chaotic, and its prediction means nothing: ",
             "; end the measurement by then"], scenario=CHAOS, status=2),
    planned("--measure tilt_deg --sigma 1 --every 1 --until 6 --estimate gravity_m_s2", "gravity_m_s2 would be known to ",
            scenario=CHAOS),
    planned("--measure tilt_deg --sigma 1 --every 1", ["--until: at 0.00", RIM_TOUCHES + "end the measurement by then"],
            scenario="toy-top", status=2, set=RIM, unless={"/contact/max_tilt_deg": 90}),
    planned("--measure tilt_deg --sigma 1 --every 1e-4 --until 2e-3 --estimate tilt_deg", "tilt_deg would be known to ± ",
            scenario="toy-top", set=RIM),

    planned("--measure tilt_deg --sigma 1 --every 0.5 --until 2", "To change first: take 2 times as many rows, one every 0.25 s: the "
            "standard error of omega_sin_latitude_rad_s would be ", scenario="steady-precession-slow"),
    planned("--estimate latitude_deg", "None of the changes considered makes its standard error smaller by as much as a twentieth.",
            set={"/uncertainty": {"latitude_deg": 1e-3}}, unless={"/uncertainty/latitude_deg": 1}),

    # the picture of a plan
    planned("--svg p.svg", ["What a measurement would show", "free-gyro: standard error of the Earth's rate times sin(latitude)",
                            "Changed by a factor of", "measured longer", "more rows", "smaller standard errors",
                            "the scenario's value"], page="p.svg"),
    planned("--svg p.svg", "smaller standard errors", page="p.svg", set={"/earth": {"rotation_rate_rad_s": 0}},
            holds=lambda text: "the scenario's value" not in text),

    # a plan of several releases
    planned("s.json --estimate tilt_deg --measure tilt_deg --sigma 1 --every 0.5", [": what each release tells", "1 alone, "], scenario="toy-top"),
    planned("s.json --optimise /release/tilt_deg=5:60", "--optimise and --write-data are for one release; plan each by itself for them", status=2),
    planned("--shared tilt_deg", "--shared: is for several releases; for one, name numbers with --estimate or --nuisance", status=2),
    planned("s.json " * 16, "17 releases; from 1 to 16 can be planned at once", status=2),
    Case("plan list.json --measure tilt_deg --sigma 1 --every 1 --shared tilt_deg",
         '"estimate" of single releases is not used by plan; name numbers for all releases', status=2,
         files={"list.json": '{"releases": [{"scenario": "s.json", "estimate": ["tilt_deg"]}]}'}),
    Case("plan list.json --measure tilt_deg --sigma 1 --every 1",
         "--until: missing: the scenarios last 2 s and 3 s; say until when is measured", status=2, set=SHORT,
         files={"list.json": '{"releases": [{"scenario": "s.json"}, {"scenario": "s.json", "set": ["/motion/duration_s=3"]}]}'}),

    # what is no plan
    planned("--measure azimut_deg --sigma 1 --every 1", ["--measure azimut_deg: unknown; allowed are azimuth, tilt, ",
            "passage with _s; e.g. azimuth_deg; did you mean azimuth_deg?"], status=2),
    planned("--measure tilt_deg --sigma 1 --every 1e-9 --until 1", "--every: 1e-09 s makes more than 200000 rows in 1 s; take a longer one", status=2),
    planned("--measure tilt_turning_deg --sigma 1 --every 0.01 --estimate tilt_deg",
            "--every: two rows would measure the same turning point, the one at ", scenario="toy-top", status=2,
            set={"/release/precession": "none"}),
    planned("--optimise /site/gravity_m_s2=1:2 --optimise /site/gravity_m_s2=1:3", "--optimise /site/gravity_m_s2: is given twice",
            status=2),
    planned("--optimise /platform/rate_rad_s=1:2",
            "--optimise /platform/rate_rad_s: is not in the scenario; add it there, with any value", status=2,
            unless={"/platform": {"motion": "constant", "rate_rad_s": 1}}),
    planned("--optimise /release/tilt_deg=1:200",
            "--optimise /release/tilt_deg: a limit is not possible: 200 is out of range; must be a number from 0 to 180 (deg)",
            status=2, holds=lambda text: "--set" not in text),
    planned("--measure azimuth_deg --sigma 0 --every 1", "--sigma: of azimuth_deg must be above 0 (deg)", status=2),
    planned("--measure azimuth_deg --sigma 0,1 --every 1",
            "--sigma 0,1: is not a number; give a standard error in the quantity's unit, e.g. 0.01", status=2),
    planned("--measure azimuth_deg --sigma 1 --measure azimuth_rad --sigma 1 --every 1",
            "--measure azimuth_rad: is measured already, as azimuth_deg; keep one", status=2),
    planned("--svg s.json", "s.json: error: is one of the inputs; write to another place", status=2),
    planned("--svg x --write-data ./x", "--svg and --write-data name the same file; give two", status=2),
    planned("", "/effects: the choice of effects is left to the program; to plan a measurement, name them", status=2,
            set={"/effects": "auto", "/accuracy/drift_rad": 1e-6}, unless={"/effects": {"coriolis": True}}),
]
