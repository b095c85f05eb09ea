# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a laboratory that travels: its figures, theory, why, notes, and the effects of its journey."""
import math
import re

from case import Case

SHIP = "ship-gyrocompass"
GYRO = "airliner-directional-gyro"
BEAM = "holonomy-round-a-parallel"
WORLD = "round-the-world"
TUNED = "schuler-tuned-compass"
OMEGA = 7.292115e-5
SAILS = {"/travel": {"path": "rhumb", "course_deg": 30, "speed_m_s": 10}, "/motion": {"duration_s": 1, "output_step_s": 0.1}, "/criteria": None,
         "/headline": None}
AT_REST = {"/travel/reference": "at_rest"}
WITHOUT = {"/headline": None}


def number(text, before):
    return float(re.search(re.escape(before) + r"\s*(-?[0-9.]+(?:e[-+]?[0-9]+)?)", text)[1])


def near(value, wanted, within=2e-3):
    return math.isclose(value, wanted, rel_tol=within)


def radii(latitude_deg):
    """Of curvature along the meridian and across it."""
    flattening, s = 1 / 298.257223563, math.sin(math.radians(latitude_deg))
    e2 = flattening * (2 - flattening)
    q = 1 - e2 * s * s
    return 6378137 * (1 - e2) / q**1.5, 6378137 / math.sqrt(q)


def ship_figures(text):
    """20 knots to the North for ten minutes from 60 degrees North, in the unit of the angle."""
    speed, (meridian, _) = 20 * 1852 / 3600, radii(60)
    false_north = math.degrees(math.atan(speed / meridian / (OMEGA * 0.5)))
    return (near(number(text, "journey"), 0.6 * speed) and near(number(text, "over the Earth at up to"), speed / meridian) and
            near(number(text, "a damped level compass points to"), false_north) and
            near(number(text, "leans aboard by up to"), math.degrees(2 * OMEGA * speed * math.sin(math.radians(60)) / 9.8191)) and
            near(number(text, "turns in azimuth by"), math.degrees(OMEGA * math.sin(math.radians(60))) * 3600))


def gyro_wanders(text):
    _, across = radii(50)
    of_journey = math.degrees(250 * math.tan(math.radians(50)) / (across + 1e4)) * 3600
    of_earth = math.degrees(OMEGA * math.sin(math.radians(50))) * 3600
    return near(number(text, "its way over the Earth makes"), of_journey) and near(number(text, "about Up: at the start by"),
                                                                                  of_journey + of_earth)


def beam_turned(text):
    return near(number(text, "in the laboratory by"), -180, 1e-6) and near(number(text, "in theory, by"), -180, 1e-6)


def tuned(text):
    meridian, _ = radii(45)
    north = OMEGA * math.cos(math.radians(45))
    return near(number(text, "kappa ="), 0.4 * 7.614e-4 * meridian * north / 0.1) and near(
        number(text, "undamped period"), 2 * math.pi / math.sqrt(north**2 + 0.4 * 7.614e-4 * 9.80665 * north / 0.1) / 60)


def sized_apart(text):
    """The drift of the Coriolis force on the laboratory is most of a heavy top's."""
    drift, eotvos = re.search(r"about ([-0-9.e]+) rad", text), re.search(r"eotvos modelled (\S+) (\S+) - (\S+)", text)
    return 0.8 < float(eotvos[3]) / float(drift[1]) < 1.1


def table(step_s, digits):
    """A vehicle that rises by a metre and a half in a minute."""
    rows = [f"{step_s * i},45,10,{100 + 1.5 * i * step_s / 60:.{digits}f}" for i in range(60 // step_s + 1)]
    return "t_s,latitude_deg,longitude_deg,height_m\n" + "\n".join(rows) + "\n"


TABLES = {"short.csv": table(1, 1), "long.csv": table(20, 4)}
BY_TABLE = {"/site": {"gravity_m_s2": 9.80665}, "/travel": {"path": "table"}, "/criteria": None, "/headline": None}
FAR = {**SAILS, "/travel": {"path": "rhumb", "course_deg": 0, "speed_m_s": 1000}, "/motion": {"duration_s": 500, "output_step_s": 10}}

RUN = "run s.json --out out --force --long"
PAGE = "out/summary.json"

CASES = [
    # -- figures
    Case("check s.json", ["journey", "East, North and Up turn over the Earth at up to", "leans aboard by up to",
                          "a damped level compass points to", "a level free axis turns in azimuth by"],
         scenario=SHIP, set=WITHOUT, holds=ship_figures, unless={"/travel": None}),
    Case("check s.json", "km, to latitude 60.0", scenario=SHIP, set=WITHOUT, unless={"/travel/course_deg": 180}),
    Case("check s.json", "deg/h of it by the journey", scenario=SHIP, set=WITHOUT, unless={"/travel": None}),
    Case("check s.json", "for a compass that no change of speed deflects", scenario=TUNED, set=WITHOUT, holds=tuned,
         unless={"/gimbals/inner": {"locked": True}}),
    # -- theory and why
    Case(RUN, "A damped compass settles along the level part of the rate at which the laboratory turns in space: that of the Earth, and that "
              "of its own way over the Earth", scenario=SHIP, set=WITHOUT, unless={"/gimbals/outer/viscous_torque_N_m_s": 0}),
    Case(RUN, "azimuth at which a damped level compass settles: -atan(v cos C/(M + h) / (Omega cos(latitude) + v sin C/(N + h)))",
         scenario=SHIP, set=WITHOUT, page=PAGE, unless={"/gimbals/outer/viscous_torque_N_m_s": 0}),
    Case(RUN, ["A level axis that is free stays in space while the laboratory turns about Up", "In azimuth it turns by"], scenario=GYRO,
         set={**WITHOUT, "/motion": {"duration_s": 5, "output_step_s": 1}}, holds=gyro_wanders, unless={"/release/inner_angle_deg": 60}),
    Case(RUN, ["Nothing turns the beam about its upright axis: it keeps its inertial rate about Up, while Up is carried along.",
               "how fast it was carried does not matter",
               "turn of a level beam that keeps its inertial rate about an upright axis which is carried along"], scenario=BEAM, set=WITHOUT, page=PAGE,
         holds=beam_turned, unless={"/gimbals/outer": {"viscous_torque_N_m_s": 1e-6}}),
    Case(RUN, "Nothing turns the body in space. On any journey its attitude drifts by the angle by which the Earth has turned", scenario=WORLD,
         set={**WITHOUT, "/motion": {"duration_s": 100, "output_step_s": 10}}, unless={"/release/rates_relative_to": "laboratory"}),
    # -- notes
    Case(RUN, "non-physical scenario: the Coriolis force on the laboratory is left out", set={**SAILS, "/travel/eotvos": "off"},
         unless={"/travel/eotvos": "both"}),
    Case(RUN, "the prediction is that of a laboratory which stays at the place of the release, on the Earth that turns: the drift is what the "
              "journey does", set={**SAILS, **AT_REST}, unless={"/travel/reference": "same_path"}),
    # -- effects
    Case("explain s.json", ["the laboratory's acceleration over the Earth; it acts in both predictions",
                            "East, North and Up turn with the place; it acts in both predictions"], set=SAILS, holds=sized_apart,
         unless={"/travel": None}),
    Case("explain s.json", ["tide left out ? ? ? ? left out; it belongs to one place, and is not carried along",
                            "carried along it is not zero; the motion is followed in axes without it"], set=SAILS, unless={"/travel": None}),
    Case("explain s.json", "by which the plumb line aboard leans; the rotating motion alone feels it", set=SAILS,
         unless={"/travel/eotvos": "both"}),
    Case("explain s.json", "by which the plumb line aboard leans; both motions feel it", set={**SAILS, "/travel/eotvos": "both"},
         unless={"/travel/eotvos": "rotating"}),
    Case("explain s.json", ["Drift by the journey after 1 s", "of the rate at which the laboratory turns in space",
                            "the rate at which the laboratory turns in space changes as it travels", "its share of the Coriolis torque",
                            "of second order in that rate; the first-order part of the Earth's is in apparent gravity",
                            "sized only against the same journey on an Earth that stands still",
                            "how well they must be known is found by runs: give /report/sensitivities true"],
         set={**SAILS, **AT_REST}, unless={"/travel/reference": "same_path"}),
    # -- a table of places, and a gravity that holds everywhere
    Case("check s.json", ["an error of one unit in the last digit of its places is an acceleration of about 0.6 m/s^2",
                          "one unit in the last digit of its places is an acceleration of 0.6 m/s^2"],
         set={**BY_TABLE, "/travel/file": "short.csv"}, files=TABLES, unless={"/travel/file": "long.csv"}),
    Case("check s.json", "holds along the whole journey, which leads 4.5 deg to the North or South", set=FAR,
         unless={"/travel/course_deg": 90}),
    # -- a vehicle
    Case("check s.json", "there is no journey whose course the platform could turn with", set={"/platform": {"motion": "course"}},
         unless={"/travel": SAILS["/travel"]}, status=1),
    # -- what is refused
    Case("check s.json", 'is not available on a journey; take "auto", or leave the journey out',
         set={**SAILS, "/numerics": {"method": "closed_form"}}, unless={"/travel": None}, status=1),
    Case("check s.json", "/travel: comes nearer than 0.1 deg to a pole at t =", set={**SAILS, "/site/latitude_deg": 89.89995, "/travel/course_deg": 0},
         unless={"/travel/course_deg": 180}, status=1),
]
