# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a body in a Cardan suspension: what is refused, its figures, theory, why, and its measured angles."""
import json
import math
import re

from case import Case, changed

OMEGA = 7.292115e-5
COMPASS = "gyrocompass-in-gimbals"
FOUCAULT = "foucault-1852"
MAGNUS = "magnus-drift"
THEODOLITE = "gyrotheodolite"
RATE_GYRO = "rate-gyro-on-turntable"
MASSLESS = "hard/g07-massless-gimbals"
RUN = "run s.json --out out --force --long"
SUMMARY = "out/summary.json"
ROWS = "out/trajectory.csv"
SECOND = {"/headline": None, "/motion": {"duration_s": 1}}


def number(text, before):
    """The number behind a piece of a text."""
    return float(re.search(re.escape(before) + r" ?([-+]?[0-9.]+(?:e[-+]?[0-9]+)?)", text)[1])


def near(*pairs, within=6e-6):
    """Six digits are printed."""
    return all(math.isclose(a, b, rel_tol=within) for a, b in pairs)


# -- what is refused

def refused(place, says, scenario, changes, *mended):
    """A scenario that is refused at a place; after each of the further changes it is accepted."""
    files = {"bad.json": json.dumps(changed(scenario, changes))}
    files.update({f"good{at}.json": json.dumps(changed(scenario, {**changes, **more})) for at, more in enumerate(mended)})
    return Case("check " + " ".join(files), [f"error: {place}: {says}", *(f"{name}: ok" for name in list(files)[1:])], scenario=None,
                files=files, status=1, holds=lambda text: text.count("error: ") == 1)


def methods(*others):
    return [{"/numerics": {"method": method}} for method in ("auto", "taylor", "extrapolation", "rkf78", *others)]


GAUSS = {"/numerics": {"method": "gauss", "step_s": 1e-3}}
RING = {"mass_kg": 0.1, "inertia": {"principal_kg_m2": [1e-5, 1e-5, 1e-5]}}
ROTOR = {"mass_kg": 0.02, "axial_kg_m2": 1e-5, "transverse_kg_m2": 6e-6, "spin_rad_s": 300}
CARDAN = {"outer": RING}
OWN_BEARINGS = "it is friction of a pivot, and gimbals have bearings with friction of their own; leave one of the two out"
REFUSED = [
    *[refused(f"/effects/{key}", f"is not available with /gimbals: {OWN_BEARINGS}", MAGNUS, {f"/effects/{key}": 1e-6},
              {f"/effects/{key}": None, "/gimbals/outer/viscous_torque_N_m_s": 1e-6, "/gimbals/inner/viscous_torque_N_m_s": 1e-6})
      for key in ("viscous_torque_N_m_s", "quadratic_torque_N_m_s2", "coulomb_torque_N_m")],
    refused("/effects/gimbal", "is not available with /gimbals: it holds a rigid wheel without moments of its own; leave one of the two "
            "out", COMPASS, {"/effects/gimbal": True}, {"/effects/gimbal": False},
            {"/gimbals": None, "/rotor": None, "/release": {"tilt_deg": 90, "spin_rad_s": 1000},
             "/body/inertia/principal_kg_m2/0": 1e-4}),
    *[refused(f"/effects/{key}", "is not available with /gimbals: the torques of parts that move belong to all three; leave one of the "
              "two out", MAGNUS, {f"/effects/{key}": False}, {f"/effects/{key}": True})
      for key in ("coriolis", "centrifugal", "transverse")],
    refused("/numerics/observer", 'is "body", and with /gimbals the equations are those of all parts, which no one of them carries; '
            'must be "laboratory" or "inertial"', MAGNUS, {"/numerics": {"observer": "body"}},
            {"/numerics/observer": "laboratory"}, {"/numerics/observer": "inertial"}),
    # On a thin rod along the outer axis nothing has a moment about this.
    refused("/release/inner_angle_deg", "is a gimbal lock (gimbal_lock): here the parts that turn about the outer axis have no moment of "
            "inertia, and nothing resists them; give the outer gimbal a mass and moments, or another angle", MASSLESS,
            {"/release/inner_angle_deg": 0, "/criteria": None}, {"/gimbals": CARDAN}, {"/release/inner_angle_deg": 1}),
    refused("/numerics/method", '"gauss" is not built for a body in gimbals; take "auto", "taylor", "extrapolation" or "rkf78"', MAGNUS,
            GAUSS, *methods()),
    refused("/numerics/method", '"gauss" is not built for a body with a rotor; take "auto", "taylor", "extrapolation" or "rkf78"',
            "tumbling-gyrostat", GAUSS, *methods()),
    refused("/gimbals", "is not available with /contact: gimbals need a fixed support; leave one of the two out", "toy-top-on-table",
            {"/gimbals": CARDAN, "/release": {"outer_angle_deg": 0, "inner_angle_deg": 20}},
            {"/gimbals": None, "/release": {"tilt_deg": 20, "spin_rad_s": 200}}),
    *[refused(f"/release/{key}", "belongs to /gimbals, which is not given; give tilt_deg and a spin instead", "toy-top",
              {f"/release/{key}": 1}, {f"/release/{key}": None}) for key in ("outer_angle_deg", "inner_rate_rad_s")],
    *[refused(f"/gimbals/inner/{key}", "acts on no locked axis; leave it out, or set locked to false", COMPASS,
              {f"/gimbals/inner/{key}": 0.01}, {f"/gimbals/inner/{key}": None}, {"/gimbals/inner/locked": False})
      for key in ("viscous_torque_N_m_s", "torsion_N_m_rad")],
    refused("/gimbals/outer/regularisation_rad_s", "is missing; coulomb_torque_N_m needs the rate below which the torque is proportional "
            "to it: give one above 0, such as 0.01 rad/s", COMPASS, {"/gimbals/outer/coulomb_torque_N_m": 1e-6},
            {"/gimbals/outer/regularisation_rad_s": 0.01}, {"/gimbals/outer/coulomb_torque_N_m": 0}),
    refused("/rotor/regularisation_rad_s", "is missing; coulomb_torque_N_m needs the rate below which the torque is proportional to it: "
            "give one above 0, such as 1 rad/s", COMPASS, {"/rotor/coulomb_torque_N_m": 1e-6}, {"/rotor/regularisation_rad_s": 1},
            {"/rotor/coulomb_torque_N_m": 0}),
    refused("/gimbals/outer/torsion_rest_deg", "belongs to torsion_N_m_rad, which is not given; leave it out", COMPASS,
            {"/gimbals/outer/torsion_rest_deg": 5}, {"/gimbals/outer/torsion_rest_deg": None}, {"/gimbals/outer/torsion_N_m_rad": 1e-6}),
]

# -- figures, theory and why

def of(scenario, changes=None):
    """What the sentences are about, of an upright suspension with diagonal moments whose rotor has the body's axis 3: both angles (rad),
    the moments about both axes, A3 + B1 sin(b)^2 + B3 cos(b)^2 and B2, those along the outer axis at b = 0, A3 + B3, the rotor's
    momentum in space, and the Earth's rate to the North, upward and across the rotor's axis."""
    s = changed(scenario, changes or {})
    release, rotor, body = s["release"], s["rotor"], s["body"]["inertia"]["principal_kg_m2"]
    ring = s["gimbals"].get("outer", {}).get("inertia", {}).get("principal_kg_m2", [0, 0, 0])
    a, b = (math.radians(release[f"{which}_angle_deg"]) for which in ("outer", "inner"))
    across, latitude = rotor["transverse_kg_m2"], math.radians(s["site"]["latitude_deg"])
    north, up = OMEGA * math.cos(latitude), OMEGA * math.sin(latitude)
    along = north * math.sin(b) * math.cos(a) + up * math.cos(b)  # what the rotor's axis has of the Earth's rate
    return {"a": a, "b": b, "M": ring[2] + (body[0] + across) * math.sin(b)**2 + body[2] * math.cos(b)**2, "N": body[1] + across,
            "axial": ring[2] + body[2], "ring": ring, "body": [body[0] + across, body[1] + across, body[2]],
            "h": rotor["axial_kg_m2"] * (rotor["spin_rad_s"] + release.get("outer_rate_rad_s", 0) * math.cos(b) + along),
            "north": north, "up": up, "across": math.sqrt(OMEGA**2 - along**2)}


def root(f, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == (f(low) > 0) else (low, middle)
    return (low + high) / 2


def compass(changes, tape=0.0, rest=0.0):
    """Where the axis of a compass with a tape rests, and the period of a small swing."""
    g = of(COMPASS, changes)
    second = (g["ring"][0] + g["body"][2] - g["ring"][1] - g["body"][1]) * g["north"]**2
    at = root(lambda a: tape * (rest - a) - g["h"] * g["north"] * math.sin(a) - second * math.sin(a) * math.cos(a), -1.0, 1.2)
    stiffness = g["h"] * g["north"] * math.cos(at) + second * math.cos(2 * at) + tape
    return at, 2 * math.pi * math.sqrt(g["M"] / stiffness)


def rest_of_compass(text):
    at, period = compass(TAPE, **OF_TAPE)
    return near((number(text, "place of rest outer angle"), math.degrees(at)), (number(text, "swings about it take"), period))


def rest_of_theodolite(text):
    """Its weight and the rotor balance: the axis rises by a little, and the tape moves the middle from North."""
    s = changed(THEODOLITE, {})
    g, tape, rest = of(THEODOLITE), 4e-6, math.radians(5)
    mass, lever = 1.6, 0.12
    weight = mass * lever * s["site"]["gravity_m_s2"]
    N = 3e-3 + 3e-4 + mass * lever**2  # the moments are given about the centre of mass, which is along axis 1
    M = 4e-3 + 3e-4
    at = root(lambda a: tape * (rest - a) - g["h"] * g["north"] * math.sin(a), -1.0, 1.2)
    north = g["north"] * math.cos(at)
    rises = math.atan2(g["h"] * g["up"], weight + g["h"] * north)
    K11, K22 = g["h"] * north + tape, math.hypot(weight + g["h"] * north, g["h"] * g["up"])
    middle = M * K22 + N * K11 + g["h"]**2
    fast = (middle + math.sqrt(middle**2 - 4 * M * N * K11 * K22)) / (2 * M * N)
    slow = K11 * K22 / (M * N * fast)
    found = re.search(r"place of rest outer angle ([0-9.]+) deg, inner angle ([0-9.]+) deg; small undamped swings about it take "
                      r"([0-9.]+) s and ([0-9.]+) s", text)
    degrees, inner, slow_s, fast_s = (float(one) for one in found.groups())
    return abs(90 - math.degrees(rises) - inner) < 6e-5 and near(
        (degrees, math.degrees(at)), (slow_s, 2 * math.pi / math.sqrt(slow)), (fast_s, 2 * math.pi / math.sqrt(fast)), within=2e-5)


def moments_of(scenario, changes=None):
    def holds(text):
        g = of(scenario, changes)
        found = re.search(r"gimbals ([0-9.e-]+) kg m² about the outer axis, ([0-9.e-]+) kg m² about the inner one", text)
        return near((float(found[1]), g["M"]), (float(found[2]), g["N"]))
    return holds


def imitates(text):
    """A torque T turns the axis at T/h; the mean rate of the outer gimbal by a nutation X is h X^2 cos(b) (A3 + B3)/(2 M^2)."""
    g = of(MAGNUS)
    X = math.radians(number(text, ", a nutation of"))
    return near((number(text, "like the Earth a torque of"), g["h"] * OMEGA),
                (number(text, "that is off by"), g["h"] * OMEGA / (0.8 * 9.80925)),
                (g["h"] * X**2 * math.cos(g["b"]) * g["axial"] / (2 * g["M"]**2), OMEGA), within=5e-4)


def document(text):
    """The summary, which follows the text."""
    return json.JSONDecoder().raw_decode(text[text.index('{ "$schema"'):])[0]


def theory(text, name):
    return next(one for one in document(text)["theory"] if one["name"] == name)


def keeps(text):
    """The axis, d from the celestial one, keeps its direction in space."""
    g, one = of(FOUCAULT, AT_REST), theory(text, "free_gyro_axis_drift")
    drift = 2 * math.asin(g["across"] / OMEGA * math.sin(OMEGA * 5))
    nutation = 3 * OMEGA * (g["M"] + g["N"]) / (g["h"] * math.sin(g["b"])**2)
    return near((one["predicted"], drift), within=1e-9) and abs(one["computed"] - drift) < nutation < 1e-6


def swings(text):
    """A swing of 10 degrees takes an elliptic integral more than a small one: by the arithmetic-geometric mean."""
    one, (_, period) = theory(text, "compass_period"), compass({})
    a, b = 1.0, math.cos(math.radians(10) / 2)
    for _ in range(6):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return near((one["predicted"], period), within=1e-9) and near((one["computed"], period / a), within=1e-6)


UNITS = {"°": math.pi / 180, "″": math.pi / 648000}


def rows(text):
    """The rows of trajectory.csv, which follows the text."""
    table = text[text.index("t_s,"):].split(" ")
    names = table[0].split(",")
    return [dict(zip(names, (float(one or "nan") for one in line.split(",")))) for line in table[1:] if line.count(",") == len(names) - 1]


def middle(text):
    """Where tape and Earth balance, and the mean of the rows over three swings."""
    found = re.search(r"outer angle of ([0-9.]+)(°|″), ([0-9.]+)(°|″) in this run", text)
    said, computed = float(found[1]) * UNITS[found[2]], float(found[3]) * UNITS[found[4]]
    at, period = compass(TAPE, **OF_TAPE)
    angles = [row["outer_angle_rad"] for row in rows(text) if row["t_s"] < 3 * 1.001 * period]
    return near((said, at), within=1e-5) and near((computed, sum(angles) / len(angles)), within=5e-3) and near((computed, at), within=5e-3)


def turns(text):
    """Both angles are that of the last row."""
    found = re.search(r"turn the rest by (-?[0-9.]+)(°|″), (-?[0-9.]+)(°|″) in this run", text)
    last = rows(text)[-1]["drift_outer_angle_rad"]
    return near((float(found[1]) * UNITS[found[2]], last), (float(found[3]) * UNITS[found[4]], last), within=1e-4)


def off_balance(text):
    """Without the Earth the weight of a body, off by so much that the centre of all masses is off by what is said, turns the outer gimbal
    as fast as the Earth turns."""
    g, all_rows = of(FOUCAULT, OFF), rows(text)
    rate = (all_rows[-1]["ref_outer_angle_rad"] - all_rows[0]["ref_outer_angle_rad"]) / all_rows[-1]["t_s"]
    return near((number(text, "A torque of"), g["h"] * OMEGA), (number(text, "that is off by"), OFF_M),
                (abs(rate), OMEGA), within=1e-2)


def passes(column, least):
    """At the time that is said the angle, between two rows, has passed the threshold."""
    def holds(text):
        said = number(text, "passed at t =")
        before, after = ([row for row in rows(text) if (row["t_s"] < said) == is_before] for is_before in (True, False))
        return bool(before and after) and all(abs(row[column]) < least for row in before) and abs(after[0][column]) >= least
    return holds


def coriolis(text):
    """The gyroscopic torque on the rotor's momentum; the Earth's rate makes the gimbals turn too little to count."""
    g = of(FOUCAULT, AT_REST)
    return near((number(text, "the momentum that the laboratory sees alone it is"), g["h"] * g["across"]), within=1e-2)


def check(says, scenario, **more):
    return Case("check s.json", says, scenario, **more)


NO_FRICTION = {"/headline": None, "/rotor/viscous_torque_N_m_s": None}
AT_REST = {**NO_FRICTION, "/release": {"outer_angle_deg": -30, "inner_angle_deg": 60}, "/motion/duration_s": 10}
OF_TAPE = {"tape": 1e-5, "rest": math.radians(20)}
TAPE = {"/headline": None, "/gimbals/outer/torsion_N_m_rad": 1e-5, "/gimbals/outer/torsion_rest_deg": 20, "/release/outer_angle_deg": 0,
        "/motion/output_step_s": 0.1}
OFF_M = 0.858 * OMEGA / (0.8 * 9.80925)
OFF = {**NO_FRICTION, "/body/center_of_mass_m/2": OFF_M * 0.8 / 0.2, "/motion/duration_s": 2}
NO_WEIGHT = {**SECOND, "/site/gravity_m_s2": 0}
BEAM = {"/report": {"threshold_rad": 1e-4}, "/criteria": None}
NO_ROTOR = {"/headline": None, "/rotor": None, "/release/inner_angle_deg": 60, "/report": {"threshold_rad": 6e-10},
            "/motion/duration_s": 0.5, "/motion/output_step_s": 1e-3}
ON_PIVOT = {"/gimbals": None, "/release": {"tilt_deg": 60, "spin_rad_s": 0}}
FIGURES = [
    check("about the inner one, without the rotor's spin", MAGNUS, holds=moments_of(MAGNUS), unless=ON_PIVOT),
    check("about the inner one, without the rotor's spin", COMPASS, holds=moments_of(COMPASS)),
    check(["place of rest outer angle", " deg, inner angle 90 deg; small undamped swings about it take "], COMPASS, set=TAPE,
          holds=lambda text: rest_of_compass(text) and " s and " not in text),
    # A balanced gyroscope has none but the celestial axis.
    check(["place of rest outer angle 0.850456 deg, inner angle 89.9993 deg", "small undamped swings about it take 387.108 s and"],
          THEODOLITE, holds=rest_of_theodolite, unless={"/body/center_of_mass_m/0": 0, "/rotor/center_m": None, "/gimbals/outer": {}}),
    check(["like the Earth a torque of ", ", a centre of ", ", a nutation of "], MAGNUS, holds=imitates,
          unless={"/earth": {"rotation_rate_rad_s": 0}}),
    check("like the Earth a torque of 6.258e-05 N m, a nutation of ", MAGNUS, set=NO_WEIGHT, unless={"/site/gravity_m_s2": 9.8}),
    # At b = 90 degrees a nutation does not make the gimbals drift.
    check("like the Earth a torque of 6.257e-05 N m", FOUCAULT, holds=lambda text: "a nutation of" not in text),
    Case(RUN, "precession, nutation and critical spin of a rigid top: gimbals hold the body", MAGNUS, set=SECOND, unless=ON_PIVOT),
    Case(RUN, "and no more than that, as gimbals hold the body", MAGNUS, set=SECOND, unless=ON_PIVOT),
]

THEORY = [
    Case(RUN, "the rotor's axis stays in inertial space: 2 asin(sin(angle from the celestial axis) |sin(Omega t/2)|)", FOUCAULT,
         set=AT_REST, page=SUMMARY, holds=keeps, unless={"/release/outer_rate_rad_s": 0.1}),
    Case(RUN, "period of a small swing of the outer gimbal about its place of rest, with the inertia of both gimbals", COMPASS,
         set={"/headline": None}, page=SUMMARY, holds=swings, unless={"/gimbals/outer/viscous_torque_N_m_s": 1e-6}),
    Case(RUN, ["The swing's middle is at an outer angle of 9.87", "in this run, where the torques about the outer axis balance."],
         COMPASS, set=TAPE, page=ROWS, holds=middle, unless={"/motion/duration_s": 20}),
    Case(RUN, ["A torque of 6.3e-05 N m across the rotor's axis would turn it as fast as the Earth, and so would a centre of ",
               " that is off by 8e-06 m."], FOUCAULT, set=OFF, page=ROWS, holds=off_balance, unless={"/gimbals/inner/locked": True}),
    Case(RUN, "A torque of 6.3e-05 N m across the rotor's axis would turn it as fast as the Earth. ", MAGNUS, set=NO_WEIGHT,
         holds=lambda text: near((of(MAGNUS)["h"] * OMEGA, 6.3e-5), within=1e-2), unless={"/site/gravity_m_s2": 9.8}),
    Case(RUN, ["Masses that move from or to the outer axis feel the Coriolis force of the Earth's rate about Up, and turn the rest by ",
               " in this run."], "isotomeograph", page=ROWS, holds=turns, unless={"/gimbals/outer/torsion_N_m_rad": 1e-3}),
    Case(RUN, "0.0001 rad of the outer angle passed at t =", "hard/g15-isotomeograph", set=BEAM, page=ROWS,
         holds=passes("drift_outer_angle_rad", 1e-4), unless={"/rotor": ROTOR}),
    Case(RUN, "6e-10 rad of the inner angle passed at t =", RATE_GYRO, set=NO_ROTOR, page=ROWS,
         holds=passes("drift_inner_angle_rad", 6e-10), unless={"/rotor": ROTOR}),
]

EXPLAINED = [
    Case("explain s.json", ["an effect of the Earth's rotation; on the momentum that the laboratory sees alone it is",
                            "Warning: effects are sized only for a rigid body; to see what an effect does with gimbals, run the "
                            "scenario with and without it"], FOUCAULT, set={**AT_REST, "/motion/duration_s": 1}, holds=coriolis,
         unless=ON_PIVOT),
    Case("explain s.json", "run would use taylor (the equations of a suspension have Taylor series, which take the fewest operations)",
         FOUCAULT, set=SECOND, unless={"/numerics": {"method": "rkf78"}}),
]


# -- measured angles

def angles_deg(t_s):
    """Of a balanced axis, level to the East at the release, which turns by -Omega t about the celestial axis."""
    latitude, turned = math.radians(48.8462), OMEGA * t_s
    north, up = -math.sin(latitude) * math.sin(turned), math.cos(latitude) * math.sin(turned)
    return {"outer": -math.degrees(math.atan2(math.cos(turned), north)), "inner": math.degrees(math.acos(up))}


def measured(which, off_deg=0.0):
    """At 1e-4 degrees its nutation is not seen."""
    return {"m.csv": f"t_s,{which}_angle_deg,{which}_angle_se_deg\n" +
            "".join(f"{t_s},{angles_deg(t_s)[which] + off_deg!r},1e-4\n" for t_s in (0, 4, 10))}


MEASURED = [
    *[Case("compare s.json m.csv --svg p.svg", ["Agreement yes", label], FOUCAULT, set=NO_FRICTION, files=measured(which), page="p.svg")
      for which, label in (("outer", "Angle of the outer gimbal"), ("inner", "Angle of the inner gimbal"))],
    *[Case("compare s.json m.csv", "Agreement no", FOUCAULT, set=NO_FRICTION, files=measured(which, 5e-4), status=1)
      for which in ("outer", "inner")],
    *[Case("compare s.json m.csv", f"m.csv:2:1: error: {which}_angle was measured, and the scenario has no gimbals; give it /gimbals, or "
           "leave the column out", "toy-top", set=SECOND, files=measured(which), status=2,
           unless={"/gimbals": {}, "/release": {"outer_angle_deg": -90, "inner_angle_deg": 20}, "/motion/duration_s": 10})
      for which in ("outer", "inner")],
]

CASES = REFUSED + FIGURES + THEORY + EXPLAINED + MEASURED
