# SPDX-License-Identifier: GPL-3.0-or-later
"""What the pages of `report` say and show, and what directories of results say of themselves."""
import json
import re

from case import Case, changed

RUN = ["run s.json --out r --quiet", "report r"]
PAGE = "r/report.html"


def page(says, scenario="toy-top", set=None, **more):
    """A sentence on the page of a run."""
    return Case(RUN, says, scenario, set or {}, page=PAGE, **more)


def number(text, pattern):
    return float(re.search(pattern.replace("#", r"([-+0-9.e]+)"), text).group(1))


# Results that were not computed: rows of a top that stands upright.
COLUMNS = ("t_s,q_LB_w,q_LB_x,q_LB_y,q_LB_z,w_LB_B_x_rad_s,w_LB_B_y_rad_s,w_LB_B_z_rad_s,axis_L_x,axis_L_y,axis_L_z,"
           "ref_axis_L_x,ref_axis_L_y,ref_axis_L_z,drift_axis_rad,drift_axis_bound_rad")


def results(rows, scenario=None, columns=COLUMNS, **drift):
    names = columns.split(",")
    lines = [",".join("1" if name in ("q_LB_w", "axis_L_z", "ref_axis_L_z") else str(0.5 * row) if name == "t_s" else "0"
                      for name in names) for row in range(rows)]
    summary = {"$schema": "earthtop-summary-1.json", "name": "upright", "drift": drift, "scenario": scenario,
               "outcome": {"status": "completed", "reached_s": 0.5 * (rows - 1), "rows": rows}}
    return {"r/summary.json": json.dumps(summary), "r/trajectory.csv": "\n".join([columns, *lines]) + "\n"}


def read(says, files, **more):
    return Case("report r", says, None, files=files, page=PAGE, **more)


LONG = changed("toy-top", {"/motion/duration_s": 1e7, "/motion/output_step_s": 1e3, "/numerics": {"method": "taylor"}})
LEVEL = {"tip_radius_m": 0.002, "law": "frictionless"}
TILTED = {**LEVEL, "table": {"tilt_deg": 2, "tilt_azimuth_deg": 30}}
STOPS = {"/effects": {"coulomb_torque_N_m": 1e-3}, "/motion/duration_s": 5, "/motion/output_step_s": 1, "/release/spin_rad_s": 20,
         "/criteria": None}
LIFTS_OFF = {"/motion/duration_s": 5, "/criteria": None}

DRIFT = [
    Case("run s.json --out r",
         ["Angle between the two spin axes", "its part in tilt", "Azimuth minus its secular line",
          "Rotating minus non-rotating Earth; same attitude and same rates relative to the laboratory"],
         set={"/motion/duration_s": 2}, page="r/drift.svg"),
    page("Azimuth, clockwise from above", "foucault-pendulum", {"/motion/duration_s": 4, "/criteria": None, "/headline": None}),
    page(["Rotating minus non-rotating Earth;", "On a logarithmic scale, at the output rows.", "Trend and error", "Bound on the error",
          "The bound on the error of the angle between the two spin axes", "Rotating against non-rotating Earth;"],
         set={"/motion/duration_s": 1}),
    page(["Trend: the azimuth drifts by ", "counted clockwise from above, over ", " turns of precession; ± is the 95 % bound."],
         set={"/motion/duration_s": 2}, unless={"/motion/duration_s": 1.5},
         holds=lambda text: abs(number(text, "above, over # turns") - 2 / 1.61654) < 0.01),
    page([", counted clockwise from above, for all time, as the rates of the motions' Fourier sums tell; "
          "± is a bound."], set={"/numerics/method": "fourier"}, unless={"/numerics/method": "taylor"}),
    page("Trend: not determined: the run covers 0.93 turns of precession", set={"/motion/duration_s": 1.5},
         unless={"/motion/duration_s": 2}),
    page(", counted clockwise from above: the mean of the run and no more, as friction acts.",
         set={"/motion/duration_s": 2, "/effects": {"viscous_torque_N_m_s": 1e-6}}, unless={"/effects": None}),
    page("First-order theory: 5.2", set={"/motion/duration_s": 1}),
    page("After 1 s the axis stands 2.04635",
         set={"/motion/duration_s": 1}, holds=lambda text: "from where the non-rotating prediction puts it. Both predictions" in text),
    # The finding: in words, as a length, beside the Sun's disc, and how sure that is.
    page(["In a second the Earth turns this top's axis 2.046 arcseconds off course", "This number can be trusted: ± ",
          "Its centre of mass, 30 mm from the pivot, stands 297.6 nm from where it would be if the Earth did not turn; the angle is about "
          "1/940 of the width of the Sun's disc."], set={"/motion/duration_s": 1}),
    page("In a minute the Earth turns this gyroscope's axis 902.5 arcseconds off course A metre from the pivot, its axis stands 4.375 mm "
         "from where it would be if the Earth did not turn; the angle is about half the width of the Sun's disc.", "free-gyro"),
    page(["In 0.5 s nothing turns this top's axis off course", "Both predictions end in the same place."], "hard/h03-no-earth-rate",
         {"/criteria": None}, unless={"/earth/rotation_rate_rad_s": 1e-4}),
    page(["In a minute the Earth turns this pendulum's plane of swing by 0.1884 degrees", "At the end its axis is "], "foucault-pendulum",
         {"/motion/duration_s": 60, "/criteria": None, "/headline": None}),
    page(["the Earth turns this gyroscope 247.9 arcseconds about its axis", "Its axis stays in its place: 1.202 mm at a metre from the axis."],
         "hard/g15-isotomeograph", {"/criteria": None}),
    page(["degrees off course; what comes later is not known", "The number is known to ± "], "hard/h11-chaotic",
         {"/motion/duration_s": 8, "/criteria": None}, unless={"/motion/duration_s": 6}),
    page("How far the Earth turns this top's axis is not known", "hard/k11-lift-off", {**LIFTS_OFF, "/motion/output_step_s": 5},
         unless={"/motion/output_step_s": 0.001}),
    # The angle at 1 s and its error, in arcseconds and in radians.
    page(["The error is at most a fraction of ", ". In radians the angle is "], set={"/motion/duration_s": 1},
         holds=lambda text: abs(number(text, "In radians the angle is # × 10") * 1e-6 * 206264.80624709636
                                / number(text, "After 1 s the axis stands #″") - 1) < 1e-12),
    page("The drift does not reach the threshold of 0.0001 rad.", set={"/motion/duration_s": 1, "/report": {"threshold_rad": 1e-4}},
         unless={"/motion/duration_s": 8}),
    page("The drift passes the threshold of 10⁻⁵ rad at 0.1771", set={"/motion/duration_s": 1, "/report": {"threshold_rad": 1e-5}},
         unless={"/report/threshold_rad": 1e-4}),
    page("The tilt asked for is reached at 0.00288969", set={"/motion/duration_s": 1, "/report": {"until_tilt_deg": 20.02}},
         unless={"/report": None}),
    page("Within its error the tilt asked for may be reached or not.", "cusped-top",
         {"/report": {"until_tilt_deg": 61.9595}, "/criteria": None, "/headline": None, "/motion": {"duration_s": 2},
          "/numerics": {"method": "dopri5", "relative_tolerance": 1e-6}}, unless={"/numerics": None}),
    page("The spin asked for is not reached.", set={"/motion/duration_s": 1, "/report": {"until_spin_rad_s": 100}}, unless={"/report": None}),
    page("At the end the spin is 19", set={"/motion/duration_s": 1, "/effects": {"viscous_torque_N_m_s": 1e-6}}, unless={"/effects": None}),
    # The Earth's rate times sin(48.85 deg), less the part of the moment about the axis.
    page(["The plane of the swing turns by 5.4", ", clockwise seen from above; without the Earth it would by "], "foucault-pendulum",
         {"/criteria": None, "/headline": None}, unless={"/body/center_of_mass_m/2": 0.5}),
    # Dry friction: I3 w / T = 0.0002 kg m^2 * 20 rad/s / 1e-3 N m = 4 s.
    page(["The rotating prediction comes to rest at 3.99999999", "The non-rotating prediction comes to rest at 4.0"],
         "hard/spin-down", STOPS, unless={"/motion/duration_s": 3}),
    page("At 4 s, the drift cannot be trusted: one motion is at rest and the other one moves on.", "hard/spin-down", STOPS,
         unless={"/motion/duration_s": 3}),
    page("From 6.248 s on, the drift cannot be trusted: the Earth's own disturbance has grown to 0.1 rad.", "hard/h11-chaotic",
         {"/motion/duration_s": 8, "/criteria": None}, unless={"/motion/duration_s": 6}),
    page("The run stopped: not_finite, at ", set={"/numerics": {"method": "abm8", "step_s": 0.1}, "/motion/duration_s": 10},
         unless={"/numerics": None}),
    # A threshold that the drift reaches at the end is passed or not, within its error; just below it is passed.
    page(["Within its error the drift may pass the threshold of ", " or not; as computed it passes it at 0.05 s."], set={
        "/motion/duration_s": 0.05, "/report": {"threshold_rad": 3.3657877149707e-06}}, unless={"/report/threshold_rad": 3.36578e-06}),
    page(["Within its error the drift may pass the threshold of ", " or not; as computed it does not."], set={
        "/motion/duration_s": 0.05, "/report": {"threshold_rad": 3.3657877149708e-06}}, unless={"/report/threshold_rad": 3.36579e-06}),
    read("From 3.5 s on, the drift cannot be trusted.",
         results(20, verdict="chaotic", verdict_reason="it is made up", verdict_from_s=3.5,
                 reliable={"at_s": 3, "axis_rad": 1e-5, "axis_bound_rad": 1e-9})),
    page("No row of this run can be trusted.", "hard/k11-lift-off", {**LIFTS_OFF, "/motion/output_step_s": 5},
         unless={"/motion/output_step_s": 0.001}),
]

FIRST = [
    page(["The plane of the swing has turned by ", "Path of the bob, seen from above", "The plane of the swing turns",
          "Turn of the plane of swing, clockwise from above (degrees)", "with the Earth's rotation", "Pale: all swings; dark: the last one.",
          "The same scale in both directions. Rings: start. Dots: end. Pale", "The azimuth of the bob where it is farthest from the vertical.",
          "prediction, East (m)prediction, North (m)"], "foucault-pendulum",
         {"/motion/duration_s": 60, "/criteria": None, "/headline": None}, unless={"/body/center_of_mass_m/2": 0.5}),
    page(["The swing about North", "The axis swings about North", "North is at 0.", "The angle between the two axes. Drawn"],
         "hard/t08-gyrocompass", {"/criteria": None}, unless={"/effects/gimbal": False}),
    page(["The top turns over", "With the Earth's rotation: 0 is upright, 180 upside down."], "tippe-top",
         {"/motion/duration_s": 1.1, "/criteria": None, "/headline": None}, unless={"/motion/duration_s": 0.5}),
]

# 600 s at 100 m/s to the North from 45 degrees: 60 km, at 111.16 km a degree.
ABOARD = {"/site": {"latitude_deg": 45, "longitude_deg": 8}, "/headline": None, "/criteria": None,
          "/motion": {"duration_s": 2, "output_step_s": 1}, "/travel": {"path": "rhumb", "course_deg": 0, "speed_m_s": 3000}}
TRACK = "t_s,latitude_deg,longitude_deg,height_m\n0,45,8,0\n1,45.02,8.02,10\n2,45.05,8.03,20\n3,45.07,8.03,20\n"


def aboard(**travel):
    return {**ABOARD, "/travel": {**ABOARD["/travel"], **travel}}


JOURNEY = [
    page(["The way of the laboratory 6 km from 45.0000° N, 8.0000° E to 45.0540° N, 8.0000° E, on a constant course",
          "Courses are angles of this map, and its bar is true from West to East, at latitude 45.0° N."], set=ABOARD,
         unless={"/travel": None}, holds=lambda text: abs((45.0540 - 45) * 111.16 - 6) < 0.01),
    page(", on the straightest line", set=aboard(path="geodesic"), unless={"/travel/path": "rhumb"}),
    page(", with turns", set=aboard(legs=[{"duration_s": 1, "turn_deg": 9}]), unless={"/travel/legs/0/turn_deg": 0}),
    page(["° E, as its table says, from 0 m to 20 m of height", " N. Drawn through the output rows."], set={**ABOARD, "/travel": {"path": "table", "file": "way.csv"}},
         files={"way.csv": TRACK}),
    page(", from 0 m to 20 m of height", set=aboard(legs=[{"duration_s": 2, "climb_m": 20}]), unless={"/travel/legs/0/climb_m": 0}),
    # The reference stays: what it is called, and what makes the drift.
    page(["In 2 s the journey turns this top's axis ", " from where it would be if the laboratory had stayed",
          " from where the prediction for the laboratory that stays at the place of release puts it",
          "Travelling minus resting laboratory; same attitude", "Travelling against resting laboratory; same attitude", "without the journey"],
         set=aboard(reference="at_rest"), unless={"/travel/reference": "same_path"}),
]

SEEN = [
    page("Drawn: the motion at 39 times, twelve or more in each of the axis's fastest swings.", set={"/motion/duration_s": 0.3}),
    page("Drawn: the output rows, since there is no row after the release.", "hard/k11-lift-off",
         {**LIFTS_OFF, "/motion/output_step_s": 5}, unless={"/motion/output_step_s": 0.001}),
    read("to look between them would take about ", results(20, LONG),
         holds=lambda text: number(text, "would take about # s") > 3),
    read(["500 of 1301, of each of 250 spans the first and last row, and those where a drift of axis, azimuth, tilt or tip, or the "
          "slip, is least or largest. What the motion does between them is not seen."], results(1301, LONG)),
    read("Drawn: the output rows, since this version does not follow such a scene.", results(20, {"sheep": 1})),
    read("its trajectory.csv has no ref_axis_L_x; run the scenario again",
         results(20, LONG, "t_s,axis_L_x,drift_axis_rad,drift_axis_bound_rad"), status=2),
    page(["The axis has too many swings and turns to show them all: drawn are the last 49.5 s."], "steady-precession-slow",
         {"/motion/duration_s": 450, "/motion/output_step_s": 150}, unless={"/motion/duration_s": 15, "/motion/output_step_s": 5}),
    # 900 s are 187,500 nutations and 6.7 turns of precession; of 2,000 swings each is seen.
    page(["windows, each a little longer than one of the axis's fastest swings and seen at 15 times.",
          "The axis has too many swings to show each: drawn is its mean over one, at "], "hard/h21-thirty-days",
         {"/motion/duration_s": 900, "/motion/output_step_s": 300, "/criteria": None}, unless={"/motion/duration_s": 9},
         holds=lambda text: number(text, "mean over one, at # times") == number(text, "the motion in # windows")),
]

STILL = [
    page(["The top after 2 s", "The angle between the two axes is drawn"], set={"/motion/duration_s": 2}),
    page("The angle between the two axes is drawn as it is", set={"/motion/duration_s": 2, "/earth/rotation_rate_rad_s": 0.5}),
]

TABLE = [
    page(["Distance of the two contact points", "Drift of the contact point", "to the East", "to the North",
          "The bound on the error of the distance of the two contact points", "Its tip stands ", "Contact with the table", "Rotating against non-rotating Earth",
          "The distance of the two contact points and its parts.", "Slip and normal force", "On the table",
          "Slip of the contact point over the table, and the force of the table on it.", "prediction x (m)prediction y (m)",
          "drift x (m)drift y (m)", "Path of the contact point", "Seen from above. The prediction to scale, its drift drawn 2000 times",
          "with Earth rotation, drift ×2000", "The table from above, the same scale in both directions.",
          "Rings: start. Dots: end."], "toy-top-on-table",
         {"/contact": LEVEL, "/motion/duration_s": 0.5}),
    page(["The table's normal force stays between 0.7259 N and 1.232 N.", "South-East of where it started.",
          "The prediction to scale, its drift drawn 2000 times as large; the drift is 573 nm at most."], "toy-top-on-table",
         {"/contact": LEVEL, "/motion/duration_s": 0.5}, unless={"/release/azimuth_deg": 0, "/release/spin_rad_s": 180}),
    page([" from where it started. The Earth's rotation moves its end by ", " along the table's axes).",
          "the table's axis 1", "the table's axis 2", "along axis 1", "along axis 2"],
         "toy-top-on-table", {"/contact": TILTED, "/motion/duration_s": 0.5}, unless={"/contact": LEVEL}),
    page("Its slip falls from 0.137 m/s to 0.00", "toy-top-on-table", {"/motion/duration_s": 0.5},
         unless={"/motion/duration_s": 0.05}),
    page("It rolls throughout.", "rolling-ball", {"/motion/duration_s": 1},
         unless={"/contact": {"tip_radius_m": 0.02, "law": "viscous", "sliding_viscosity_N_s_m": 0.05}}),
    page("The table's normal force is 0.9807 N throughout.", "rolling-ball", {"/motion/duration_s": 1},
         unless={"/body/center_of_mass_m": [0, 0, 0.001], "/release/tilt_deg": 20}),
    # A run that ends before its first row says nothing of what the motion does.
    Case(RUN, "Drawn: the output rows", "hard/k11-lift-off", {**LIFTS_OFF, "/motion/output_step_s": 5}, page=PAGE,
         holds=lambda text: "normal force is" not in text and "At the end the distance" not in text),
    page("Nobody knows a coefficient of friction to 1 %: the drift, with the same friction in both predictions, is well defined",
         "toy-top-on-table", {"/motion/duration_s": 0.5}, unless={"/contact": LEVEL}),
    page(["Few tables are level to an arcsecond: the drift, on the same table in both predictions, is well defined",
          "How far the prediction itself moves by 0.5 s, with inputs that nobody knows well:", "axis moves by", "tip moves by"],
         "toy-top-on-table", {"/contact": LEVEL, "/motion/duration_s": 0.5}, unless={"/contact": None}),
    page(["Jacobi integral, by the work of friction", "Jellett's integral, by the Earth and friction's moment", "integral of its rate",
          "The contact changes these quantities at a known rate; from the release to the last row:"], "toy-top-on-table",
         {"/motion/duration_s": 0.5}, unless={"/contact": None}),
    page("The Earth's rotation makes it 1.31328006", "hard/k12-sliding-ball", {"/criteria": None},
         holds=lambda text: text.count(" × 10⁻⁶ s later.") == 2),
]

REST = [
    page("of small amplitude; this release does not nutate",
         set={"/motion/duration_s": 1, "/release": {"tilt_deg": 0, "spin_rad_s": 200}},
         unless={"/release": {"tilt_deg": 20, "spin_rad_s": 200}}),
    page(["Largest torques", "Solid: modelled. Hatched: left out.", "largest torque (N m)", "changes the drift by (rad)"],
         set={"/motion/duration_s": 1}),
    read("Not computed here for a run of this length; earthtop explain computes them.", results(20, LONG)),
    read("Not computed: this version does not follow such a scene.", results(20, {"sheep": 1})),
    page("No conserved quantity is followed in this run.", set={"/motion/duration_s": 1, "/effects": {"viscous_torque_N_m_s": 1e-6}},
         unless={"/effects": None}),
    page(["relative to its largest term", "jacobi_integral"], set={"/motion/duration_s": 1},
         unless={"/effects": {"viscous_torque_N_m_s": 1e-6}}),
    page(["mean step (s)", "Path of the axis", "The top in motion", "Make it again",
          "earthtop report again", "With every default filled in."], set={"/motion/duration_s": 1}),
    page("WGS 84 normal gravity at latitude and height [GeographicLib]", set={"/motion/duration_s": 1, "/site": {"latitude_deg": 45}},
         unless={"/site": {"latitude_deg": 45, "gravity_m_s2": 9.80665}}),
    Case("run s.json --out r --json", "one unit of the input, as its name says",
         set={"/motion/duration_s": 0.5, "/report": {"sensitivities": True}}, unless={"/report": None}),
    Case("run s.json --out r --json", "there is no derivative with respect to inertia_ratio", "hard/k12-sliding-ball",
         {"/report": {"sensitivities": True}, "/uncertainty": {"inertia_ratio": 0.1}}, unless={"/uncertainty": {"tilt_deg": 0.1}}),
]

MEASURE = ["plan s.json --measure azimuth_deg --sigma 0.01 --every 1 --until 10 --write-data m.csv --quiet"]
MEASURED = [*MEASURE, "compare s.json m.csv {} --json > c.json", "report c.json"]


def measured(says, options="", scenario="toy-top", set=None, **more):
    """A sentence on the page of a simulated measurement, compared with a scenario."""
    commands = [line.replace("{}", options) for line in MEASURED]
    return Case(commands, says, scenario, set or {}, page="c.html", **more)


def planned(says, options="", set=None, **more):
    plan = "plan s.json --measure azimuth_deg --sigma 0.01 --every 1 --until 10 --json "
    return Case([f"{plan}{options} > p.json", "report p.json"], says, "toy-top", set or {}, page="p.html", **more)


UNDETERMINED = Case(["plan s.json --measure azimuth_deg --sigma 0.01 --every 1 --until 10 --json --nuisance gravity_m_s2 > p.json", "report p.json"],
                    "This measurement would not determine all that it is to determine.", "free-gyro", page="p.html")
FIT = "--estimate spin_rad_s --estimate tilt_deg"
KNOWN = {"/uncertainty": {"tilt_deg": 1e-4, "latitude_deg": 1}}
DOCUMENTS = [
    UNDETERMINED,
    measured([": they agree.", "chi-squared as given", " with 11 degrees of freedom, p-value ", "Data and model",
              "The measured values, the model, and their difference in standard errors. Azimuths are counted beyond whole turns",
              "The p-value is the probability of a chi-squared at least as large if the scenario and the stated standard errors",
              "Residuals in standard errors, and the counts expected of independent, normally distributed errors of the stated"],
             holds=lambda text: "Residuals after the fit" not in text),
    measured([": they do not agree.", "does not agree", "correlated over 2 s, as stated; chi-squared counts the part of each residual",
              "What is new in each residual after those before it, and the counts expected"],
             "--correlation-time 2 --set /release/spin_rad_s=201"),
    measured(["standard error from the scatter, if larger", "Residuals after the fit", "chi-squared after the fit"], FIT),
    measured("latitude was not used: it is not estimated; add --estimate latitude_deg to use it", FIT + " --priors", set=KNOWN,
             unless={"/uncertainty": {"spin_rad_s": 1}}),
    measured(["the estimate differs by, in these errors", "Known beforehand"], FIT + " --priors", set=KNOWN,
             unless={"/uncertainty": {"mass_kg": 1e-3}}),
    measured(["Each error by itself would shift spin by one standard error.", "stated standard error",
              "error that shifts by one standard error"], FIT, set=KNOWN),
    planned(["value / standard error", "standard error if the others were known", "What a change would do",
             "The Cramér-Rao bound of the standard error when one thing in the plan is changed",
             "Each error by itself would shift Earth's rate times sin(latitude) by one standard error."]),
    planned(["errors are correlated over2 s"], "--correlation-time 2"),
    planned(["Best within the limits", "The standard error there is", "at a limit"], "--optimise /release/tilt_deg=5:60"),
    planned("tilt (°)454547yes20", "--optimise /release/tilt_deg=45:47"),
    planned("tilt (°)31.31523060no20", "--optimise /release/tilt_deg=30:60"),
    planned("standard error if it were known exactly", "--nuisance spin_rad_s"),
    Case("report p.json", "is not as this program writes it; write it anew (a plan has an estimate)",
         None, status=2, files={"p.json": json.dumps({"$schema": "earthtop-plan-1.json", "scenario": {"name": "a"}, "estimates": []})}),
    Case("report p.json", "is no document of compare, plan or bench --json; give one, or a directory of results or of a study", None,
         status=2, files={"p.json": "{}"}),
    Case("report r.csv", "is neither the results of a run nor a study; give one of them, or a document of compare, plan or bench", None,
         status=2, files={"r.csv": "t_s\n"}),
]

PAIR = ["run s.json --out a --quiet", "run s.json --out b --quiet --set {}", "compare a b --allow-change / --json > c.json", "report c.json"]


def compared(says, change, **more):
    return Case([line.replace("{}", change) for line in PAIR], says, "toy-top",
                {"/motion/duration_s": 1, "/motion/output_step_s": 0.25}, page="c.html", **more)


def pairs(count):
    """A comparison of as many results, none of which has changed."""
    same = {"name": "top", "verdict": "same", "new": "a/top", "reference": "b/top", "conclusion": "Nothing has changed."}
    return {"c.json": json.dumps({"$schema": "earthtop-comparison-1.json", "verdict": "same", "new": "a", "reference": "b",
                                  "profile": "regression", "conclusion": ["Nothing has changed."], "pairs": [same] * count})}


COMPARED = [
    compared(["Size of the difference in the angle between the two spin axes, and its tolerance, at rows that both have.",
              "angle between the two spin axes beyond its tolerance", "first beyond it"], "/site/latitude_deg=46"),
    compared(["Differences over time", "Size of the difference in the spin phase", "spin phase, rotating minus prediction within its tolerance"],
             "/numerics/relative_tolerance=1e-6", holds=lambda text: "beyond its tolerance" not in text),
    Case("report c.json", "Results shown: 20 of 21; the others are in the document.", None, files=pairs(21), page="c.html"),
    Case("report c.json", "Comparison of a with b", None, files=pairs(20), page="c.html",
         holds=lambda text: "the others are in the document" not in text),
]

STUDY = {"$schema": "earthtop-study-1.json", "name": "rates", "title": "A study", "base": "scenarios/toy-top.json",
         "set": {"/motion/duration_s": 0.1, "/motion/output_step_s": 0.1},
         "axes": [{"name": "rate", "pointer": "/earth/rotation_rate_rad_s", "log_range": {"from": 1e-5, "to": 1e-3, "points": 3}}],
         "design": {"kind": "grid"}, "collect": ["drift.axis_final_rad"],
         "fits": [{"kind": "power_law", "axis": "rate", "quantity": "drift.axis_final_rad"}],
         "figures": [{"figure": "/fits/0/b", "value": 1, "tolerance": 1e-3, "origin": "The drift is proportional to the rate."}]}
PLAIN = {key: value for key, value in STUDY.items() if key not in ("fits", "figures")}
DRAWN = {**PLAIN, "figures": [{"figure": "/points/2000/drift.axis_final_rad", "value": 1, "tolerance": 1e-3, "origin": "No."}],
         "set": {"/motion/duration_s": 0.01, "/motion/output_step_s": 0.01},
         "axes": [{"name": "rate", "pointer": "/earth/rotation_rate_rad_s", "range": {"from": 1e-5, "to": 1e-3}},
                  {"name": "tilt", "pointer": "/release/tilt_deg", "range": {"from": 10, "to": 30}}]}
TILTED_AXES = [DRAWN["axes"][0], {"name": "tilt", "pointer": "/release/tilt_deg", "range": {"from": 0, "to": 240}}]


def study(says, document, commands=("study t.json --out t",), **more):
    return Case([*commands], says, None, files={"t.json": json.dumps(document)}, **more)


LAWS = {"linear": "a + b rate", "sin_latitude": "a + b sin(rate°)", "cos_latitude": "a + b cos(rate°)", "logarithmic": "a + b ln|rate|"}
STUDIES = [
    *[study(f"drift.axis_final_rad = {law}, 3 points",
            {**PLAIN, "fits": [{"kind": kind, "axis": "rate", "quantity": "drift.axis_final_rad"}]}) for kind, law in LAWS.items()],
    study(["Fits (standard errors from the scatter)", "|drift.axis_final_rad| = a |rate|^b, 3 points", "(rms, of the logarithm)", "Figures known from elsewhere",
           "met: /fits/0/b = 1.000000", "stated 1 +- 0.001, The drift is proportional to the rate."], STUDY,
          holds=lambda text: abs(number(text, "b = # ") - 1) < 1e-6),
    study(["Figures known from elsewhere", "Each point", "earthtop report again", "over the rate", "lawabscatter", "drift of the axis at the end = a × (rate to the power b)", " of the logarithm",
           "All 3 points are computed."], STUDY, ("study t.json --out t --quiet", "report t"), page="t/report.html",
          # b is 1.00000033 and its error 1.5e-7: as many digits as are known.
          holds=lambda text: re.search(r"1\.000000\d\d ± 1\.\d × 10⁻⁷", text)),
    study(["Where the points lie", "All 1001 points are computed."], {**DRAWN, "design": {"kind": "random", "points": 1001}},
          ("study t.json --out t --quiet", "report t"), page="t/report.html"),
    study("The points", {**DRAWN, "design": {"kind": "random", "points": 1000}}, ("study t.json --out t --quiet", "report t"),
          page="t/report.html", holds=lambda text: "Where the points lie" not in text),
    # Nearly all of the drift's variance is that of the rate, to which it is proportional.
    study(["Sobol indices of drift.axis_final_rad, from 32 base points", "first order", "rate decides drift.axis_final_rad (", "NOT MET: /points/2000/drift.axis_final_rad is missing; stated 1"],
          {**DRAWN, "design": {"kind": "sobol", "points": 32, "indices": True}},
          holds=lambda text: abs(number(text, r"total order rate # ") - 1) < 0.3),
    # A quarter of the tilts cannot exist.
    study(["Sobol indices of drift.axis_final_rad, from ", " of 128 base points", "Warning: ",
           "are left out, as they have points that failed or have no value. The indices are therefore those of another distribution than "
           "the design's: about ", "over what is left of the box, rate decides"],
          {**DRAWN, "axes": TILTED_AXES, "design": {"kind": "sobol", "points": 128, "indices": True}}, status=1,
          holds=lambda text: abs(number(text, "about # % of the box of the axes cannot exist") - 25) < 3),
    study("No Sobol indices of drift.axis_final_rad: only ",
          {**DRAWN, "axes": TILTED_AXES, "design": {"kind": "sobol", "points": 33, "indices": True}}, status=1,
          holds=lambda text: number(text, "only # of 33 base points have all their values, and Sobol indices need at least 32; about") < 32),
    *[study("31 base points are too few for Sobol indices: at least 32 are needed",
            {**DRAWN, "design": {"kind": "sobol", "points": 31, "indices": True}}, (f"study t.json --out t {option}",))
      for option in ("", "--dry-run", "--dry-run --json", "--json")],
    study(["Derivative-based indices of drift.axis_final_rad", "mean of squared derivative", "total order at most",
           "derivatives are those of the last drift that can be trusted; collect drift.verdict, and points where that is not the end are "
           "left out"],
          {**DRAWN, "set": {"/motion/duration_s": 0.1, "/report": {"sensitivities": True}}, "design": {"kind": "random", "points": 20},
           "collect": ["drift.axis_final_rad", {"name": "by_rate", "path": "sensitivities.inputs.4.d_axis_rad"}]},
          holds=lambda text: 1 <= number(text, r"total order at most rate 20 \S+ \+- \S+ # \+-") < 2),
    study(["Worst points by drift.axis_final_rad, largest absolute value first", "point rate drift.axis_final_rad status 2 0.001 "], PLAIN,
          ("study t.json --out t --quiet", "study show t --worst drift.axis_final_rad")),
    study("Points that meet the conditions: 2", PLAIN, ("study t.json --out t --quiet", "study show t --where rate>=1e-4")),
    study("--where rate>=x: >= compares numbers, and \"x\" is none", PLAIN,
          ("study t.json --out t --quiet", "study show t --where rate>=x"), status=2),
    study(["on one core", " with 3 threads. The times are those of ", " of the design, computed as the study does, which took "], PLAIN,
          ("study t.json --dry-run --jobs 3",)),
    study(" for the 2 points of this shard. The times are", PLAIN, ("study t.json --dry-run --shard 1/2",)),
    study('stops is a list, to be followed by a number of at least 0, not by "first"', {**STUDY, "collect": ["stops.first.t_s"]},
          status=2),
    study("Points 3 of 3, 0 failed", {**PLAIN, "collect": ["stops.0.t_s"]}),
]

BENCH = "bench s.json --duration 0.05 --methods taylor --reference-limit 1 --repetitions 1 {}"
BENCHES = [
    Case(BENCH.replace("{}", "--workload axis"),
         ["one motion, the axis alone where the method allows it", "seconds of one core, timed once", " rad in the axis, ",
          "good to "]),
    Case(BENCH.replace("{}", ""), "both motions and the drift between them"),
    Case(BENCH.replace("1 {}", "2 --brief"), "seconds of one core, median of up to 2 repetitions, [least, most]"),
    Case([BENCH.replace("{}", "--json > b.json"), "report b.json --svg"],
         ["Speed against error", "Error against processor time. Marks further down or to the left are better; no mark beats those on",
          "One scenario; ", "toy-top: error against cost"], page="b.html"),
]

WRITTEN = [
    Case("run s.json --out r", "trajectory.csv in it is a directory; choose another --out", status=2,
         files={"r/trajectory.csv/x": ""}),
    Case("run s.json --out ''", "the directory's name is empty; give a name", status=2),
    Case(["run s.json --out r --quiet", "report r --out r/torques.csv", "run s.json --out r"],
         "its torques.csv does not belong to this scenario's results; choose another --out, or --force to remove it", status=2,
         set={"/motion/duration_s": 0.5}),
    Case(["run s.json --out r --quiet", "report r --out r/torques.csv", "run s.json --out r --force --long"], "Files trajectory.csv",
         set={"/motion/duration_s": 0.5}),
    Case("report r", "is damaged: it is not what was written, or a run is writing there; run the scenario again", None, status=2,
         files={**results(3, LONG), "r/summary.json": '{\n  "name": "a",\n  "checksum": "0123456789abcdef"\n}\n'}),
]

CASES = [*DRIFT, *STILL, *FIRST, *JOURNEY, *SEEN, *TABLE, *REST, *DOCUMENTS, *COMPARED, *STUDIES, *BENCHES, *WRITTEN]
