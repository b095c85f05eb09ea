# SPDX-License-Identifier: GPL-3.0-or-later
"""Why tops with friction, on a table, with unequal moments and without a torque drift: sentences, each with what it rests on."""
import math
import re

from case import Case

from cases.run import ARCSECOND, OMEGA, ROWS, RUN, near, number, rows, size

RUBBED = {"/effects": {"viscous_torque_N_m_s": 2e-7}, "/motion/duration_s": 20}
UP = OMEGA * math.sin(math.radians(45))


def rubbed(text):
    """The spin falls by exp(-k t/I3); the azimuth drifts as the laboratory turns, and a little more."""
    last = float(rows(text)[-1]["ref_w_LB_B_z_rad_s"])
    said = re.search(r"200 rad/s to ([0-9.]+) rad/s in theory, and to ([0-9.]+) rad/s in this run", text)
    drift = re.search(r"drifted clockwise by ([0-9.]+)″ ± ([0-9.]+)″ in theory and by ([0-9.]+)″ in this run", text)
    return (near(float(said[1]), 200 * math.exp(-2e-7 * 20 / 4e-5), 1e-3) and near(float(said[2]), last, 1e-4) and
            abs(float(drift[1]) - float(drift[3])) <= float(drift[2]) and near(float(drift[3]) * ARCSECOND, UP * 20, 0.1))


def held(text):
    """The rates of a pendulum with the moment of its bob, along the stiffness and across it; and what the Earth would turn."""
    moment, weight = 5 * 9 + 0.01, 5 * 9.80926 * 3
    along, across = math.sqrt((weight + 0.06) / moment), math.sqrt(weight / moment)
    turning = OMEGA * math.sin(math.radians(48.8462)) * (1 - 0.01 / (2 * moment))
    return (near(number(text, "the swing along it has the rate", " rad/s"), along, 1e-6) and
            near(number(text, "that across it", " rad/s. The two"), across, 1e-6) and
            near(number(text, "get out of step by one turn in", " s"), 2 * math.pi / (along - across), 1e-3) and
            near(number(text, "turn the plane of the swing by", " rad/s"), turning, 1e-3))


def balanced(text):
    """The axis turns about the celestial axis by Omega t sin(angle), as the last row does."""
    said = re.search(r"drift of the axis is ([0-9.]+)″ ± ([0-9.]+)″ in theory and ([0-9.]+)″", text)
    along = math.cos(math.radians(20)) * math.sin(math.radians(45))
    return (near(number(text, "celestial axis, from which it is"), math.degrees(math.acos(along)), 1e-4) and
            near(float(said[1]) * ARCSECOND, math.sqrt(1 - along**2) * OMEGA * 10, 0.01) and
            near(float(said[3]) * ARCSECOND, float(rows(text)[-1]["drift_axis_rad"]), 1e-4))


def frictionless(text):
    """m g l/(I3 w3) with the moment about the centre of mass in its correction, for 5 s."""
    S, mgl = 4e-5 * 200, 0.1 * 9.80665 * 0.03
    rate = mgl / S * (1 + 3e-5 * mgl * math.cos(math.radians(20)) / S**2)
    return (near(number(text, "with them the axis precesses by"), rate * 5, 0.01) and
            near(number(text, " rad in theory, and by", " rad in this run"), rate * 5, 0.01))


def weighs(text):
    """The drift of the last row."""
    return near(size(text, "as far as the Earth moves it, by"), float(rows(text)[-1]["drift_axis_rad"]), 1e-4)


def stands_up(text):
    """In the rows the axis passes the level then."""
    said_s = number(text, "The axis passes the level after", " s, and the Earth")
    level_s = next(float(row["t_s"]) for row in rows(text) if float(row["ref_axis_L_z"]) < 0)
    return abs(said_s - level_s) < 0.01 and near(
        size(text, "makes a drift of its tilt of"), size(text, " in theory and of"), 0.1)


def turns_over(text):
    """The spin of the rows changes its sense then; the growth is that of Euler's equations."""
    growth = 20 * math.sqrt(3e-6 * 3e-6 / (4e-6 * 1e-5))
    at_s = number(text, " s in theory and at", " s in this run")
    seen_s = next(float(row["t_s"]) for row in rows(text) if float(row["w_LB_B_z_rad_s"]) < 0)
    return (near(number(text, "by a factor of e in"), 1 / growth, 1e-3) and abs(at_s - seen_s) < 0.006 and
            near(number(text, "would bring this forward by only"), math.log(10) / growth, 0.01))


def turns_over_later(text):
    """The twin of the rows turns over first."""
    first = {name: next(float(row["t_s"]) for row in rows(text) if float(row[name]) < 0)
             for name in ("w_LB_B_z_rad_s", "ref_w_LB_B_z_rad_s")}
    said = re.search(r"turn over (later|earlier) by ([0-9.e-]+) s in theory and by ([0-9.e-]+) s in this run", text)
    return (abs(number(text, "off the axis, too, and turns over at", " s: the") - first["ref_w_LB_B_z_rad_s"]) < 0.006 and
            near(float(said[2]), float(said[3]), 0.05))


def unequal(text):
    """The harmonic mean of 1.2e-4 and 1.05e-4, and the rate of the azimuth in the rows."""
    moment = number(text, "counts, that of", " kg m²")
    return near(moment, 2 / (1 / 1.2e-4 + 1 / 1.05e-4), 1e-3) and near(
        number(text, "with it the precession is"), number(text, " rad/s in theory, and it is"), 0.01)


def released(text):
    """The attitude of the last row, and a share of the energy of the Earth's rate over the spin."""
    said = re.search(r"its energy (more|less) by ([0-9.e-]+) of itself", text)
    return float(said[2]) < 4 * OMEGA / 10 and near(
        size(text, "closed form of a free body, and by"), float(rows(text)[-1]["drift_attitude_rad"]), 1e-5)


def axis_turns(text):
    """The drift of the axis in the last row."""
    return near(size(text, "of that, and by"), float(rows(text)[-1]["drift_axis_rad"]), 1e-5)


def spins(text):
    """The spin at the release, in theory and in the run at the end."""
    found = re.search(r"the spin from (\S+) rad/s to (\S+) rad/s in theory, and to (\S+) rad/s in this run", text)
    return [float(number) for number in found.groups()]


def spun_up(text):
    first, predicted, computed = spins(text)
    return near(predicted, first + 0.0005 * 60 / 4e-5, 0.01) and near(computed, predicted, 0.01)


def slowed_by_air(text):
    first, predicted, computed = spins(text)
    return near(predicted, first * math.exp(-4e-7 * 10 / 4e-5), 1e-4) and near(computed, predicted, 1e-3)


FREE = {"/release": {"tilt_deg": 60, "azimuth_deg": 30, "angular_velocity_body_rad_s": [10, 3, 4]}, "/motion/output_step_s": 0.1}

CASES = [
    Case(RUN, ["Friction slows the spin from 200 rad/s to", "; the precession, 3.889 rad/s at first, therefore quickens to",
               "It acts in both predictions alike, and by itself makes no drift",
               "at whatever pace the axis precesses: seen from the laboratory its azimuth is therefore turned clockwise by",
               "and what the Earth adds to the release, and apart from the nutation, the azimuth has drifted clockwise by"],
         set=RUBBED, page=ROWS, holds=rubbed, unless={"/release/spin_rad_s": 100}),
    Case(RUN, ["No torque acts across the axis, which therefore keeps its direction among the stars while the spin falls",
               "The drift of the axis is"], scenario="hard/spin-down", page=ROWS, holds=balanced,
         unless={"/release/spin_rad_s": 0.1}),
    Case(RUN, ["The given torque along the axis, 0.0005 N m, takes the spin from 200 rad/s to", "therefore slows to"],
         set={"/effects": {"given_torque": {"axes": "body", "torque_N_m": [0, 0, 0.0005]}}, "/criteria": None, "/headline": None}, holds=spun_up,
         unless={"/effects/given_torque/torque_N_m": [0.0005, 0, 0]}),
    Case(RUN, "while the spin rises", scenario="hard/spin-down",
         set={"/effects": {"given_torque": {"axes": "body", "torque_N_m": [0, 0, 1e-4]}}, "/criteria": None, "/headline": None},
         unless={"/effects/given_torque/torque_N_m": [0, 0, -1e-4]}),
    Case(RUN, ["The air slows the spin from 200 rad/s to", "and what the table's force makes of it"], scenario="top-in-air-on-table",
         set={"/headline": None, "/motion/duration_s": 10}, holds=slowed_by_air, unless={"/effects/viscous_torque_N_m_s": None}),
    Case(RUN, "No friction holds the tip, which circles below a centre of mass that nothing pushes sideways",
         scenario="hard/k01-frictionless", holds=frictionless, unless={"/contact/table_tilt_deg": 0.1}),
    Case(RUN, ["Both predictions have the same friction. To first order, 0.3 % more of it",
               "While the axis goes round by 2.67 turns, the laboratory turns about its vertical",
               "is how the cone leans and what the table's force makes of it"], scenario="toy-top-on-table", page=ROWS, holds=weighs,
         unless={"/earth/rotation_rate_rad_s": 0}),
    Case(RUN, "Both predictions have the same table. To first order, one that leans by", scenario="routh-sphere", page=ROWS, holds=weighs,
         unless={"/earth/rotation_rate_rad_s": 0}),
    Case(RUN, "and the Earth's rate makes it pass 1.69e-06 s earlier", scenario="tippe-top", page=ROWS, holds=stands_up,
         unless={"/motion/duration_s": 0.8}),
    Case(RUN, ["The body spins about the axis of its middle moment, and no such spin is stable",
               "3.41e-05 rad/s of it across the axis: 1.7e-06 of the spin",
               "When that has grown to the spin itself, the body turns over: at",
               "The non-rotating prediction does not turn over in this run, and so the drift comes to 179.9",
               "An Earth that turned ten times as fast would bring this forward by only"], scenario="dzhanibekov", page=ROWS,
         holds=turns_over, unless={"/release/rates_relative_to": "inertial"}),
    Case(RUN, "The non-rotating prediction was released off the axis, too, and turns over at", scenario="dzhanibekov",
         set={"/release": {"tilt_deg": 60, "azimuth_deg": 30, "angular_velocity_body_rad_s": [0.01, 0.004, 20]}}, page=ROWS,
         holds=turns_over_later, unless={"/release": {"tilt_deg": 60, "azimuth_deg": 30, "spin_rad_s": 20}}),
    Case(RUN, ["The moments across the axis, 0.00012 and 0.000105 kg m², are not equal", "the mean of their inverses counts"],
         scenario="asymmetric-top", holds=unequal, unless={"/release/spin_rad_s": 2}),
    Case(RUN, ["No torque acts on the body. Released with its rates in the laboratory",
               "the attitude has drifted by", "by the closed form of a free body, and by"], scenario="dzhanibekov", set=FREE, page=ROWS,
         holds=released, unless={"/body/center_of_mass_m": [0, 0, 1e-3]}),
    Case(RUN, "away from the celestial axis, is moved by", scenario="hard/h05-free-body", page=ROWS, holds=axis_turns,
         unless={"/release/rates_relative_to": "laboratory"}),
    Case(RUN, "Gravity acts along the axis about which the laboratory turns, and both predictions", scenario="north-pole",
         unless={"/site/latitude_deg": 89}),
    Case(RUN, ["The support is stiffer along the azimuth of 30°: the swing along it has the rate",
               "in which the swing opens to an ellipse and closes again",
               "so that its turn does not add up from swing to swing"], scenario="anisotropic-pendulum",
         set={"/motion/duration_s": 100}, holds=held, unless={"/effects/unequal_support/kappa_N_m": 1e-3}),
    Case(RUN, "The outer gimbal swings about its place of rest with a period of", scenario="gyrocompass-in-gimbals",
         holds=lambda text: near(number(text, "its place of rest with a period of", " s,"),
                                 number(text.split("its place of rest with a period of")[1], " s,", " s in this run"), 0.01),
         unless={"/earth/rotation_rate_rad_s": 0}),
]
