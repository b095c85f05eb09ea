# SPDX-License-Identifier: GPL-3.0-or-later
"""What `check` says of a scene, `explain` of its effects and inputs, and both of a top on a table."""
import json
import math
import re

from case import Case, changed

G = 9.80665
OMEGA = 7.292115e-5
TABLE = "toy-top-on-table"
EXACT = {"tip_radius_m": 0.002, "law": "coulomb", "friction_coefficient": 0.2}
TURNING = {"motion": "constant", "rate_rad_s": 1}
LEVEL = {"/effects/gimbal": True, "/release/tilt_deg": 90}
MATRIX = {"matrix_kg_m2": [[1.2e-4, 0, 1e-6], [0, 1.2e-4, 0], [1e-6, 0, 4e-5]]}
EDGE = 1e-3  # on either side of a limit


def numbers(text, pattern):
    """The numbers in the first place that looks like this, where # stands for a number."""
    number = r"([-+]?(?:[0-9.]+(?:e[-+]?[0-9]+)?|inf))"
    found = re.search(re.escape(pattern).replace(r"\#", number), text)
    return [float(one) for one in found.groups()] if found else [math.nan] * pattern.count("#")


def near(*pairs, within=6e-3):
    return all(math.isclose(a, b, rel_tol=within) for a, b in pairs)


def check(says, scenario="toy-top", **more):
    return Case("check s.json", says, scenario, **more)


def refused(says, scenario="toy-top", **more):
    return Case("check s.json", says, scenario, status=1, **more)


def explain(says, scenario="toy-top", **more):
    more["set"] = {"/motion/duration_s": 1, **more.get("set", {})}
    return Case("explain s.json", says, scenario, **more)


def figures(says, scenario="toy-top", **more):
    more["set"] = {"/motion/duration_s": 1, **more.get("set", {})}
    return Case("run s.json --out out --force --long", says, scenario, **more)


# The release.

START = [
    # Beside the horizontal the slow precession is m g l/(I3 w3) = 735.5 rad^2/s^2 over the spin.
    refused("no steady precession: its rate is too large for a double",
            set={"/release/tilt_deg": 90, "/release/precession": "steady_slow", "/release/spin_rad_s": 4e-306},
            unless={"/release/spin_rad_s": 1e-305}),
]

EFFECTS = [
    refused("/effects/gimbal: is not available on a platform; leave one of the two out", set={**LEVEL, "/platform": TURNING},
            unless={"/platform": None}),
    refused("/effects/coulomb_torque_N_m: is not available with a gimbal; give the gimbal a damping instead",
            set={**LEVEL, "/effects/coulomb_torque_N_m": 1e-6},
            unless={"/effects/coulomb_torque_N_m": None, "/effects/gimbal": {"damping_N_m_s": 1e-6}}),
    refused("kappa_N_m and periods_s are both given; give exactly one",
            set={"/effects/unequal_support": {"kappa_N_m": 0.1, "periods_s": [1, 2]}},
            unless={"/effects/unequal_support": {"kappa_N_m": 0.1}}),
    refused("/effects/unequal_support: is not available with /platform: its direction is at rest in the laboratory",
            set={"/effects/unequal_support": {"kappa_N_m": 0.1}, "/platform": TURNING}, unless={"/platform": None}),
    refused("/effects/given_torque: is not available with /contact: it acts on a body about a pivot, and a tip is free",
            TABLE, set={"/effects/given_torque": {"axes": "body", "torque_N_m": [0, 0, 1e-3]}}, unless={"/contact": None}),
    refused("/effects/unequal_support: is not available with /gimbals: a gimbal's springs are its torsion_N_m_rad",
            "through-gimbal-lock", set={"/effects/unequal_support": {"kappa_N_m": 0.1}}, unless={"/effects": None}),
    refused("/effects/given_torque: is not available with /gimbals: it acts on a body about a pivot; leave one of the two out",
            "through-gimbal-lock", set={"/effects/given_torque": {"axes": "body", "torque_N_m": [0, 0, 1e-3]}},
            unless={"/effects": None}),
    refused("are the times in seconds and the torques in N m",
            set={"/effects/given_torque": {"axes": "body", "course": "table", "file": "torques.csv"}, "/motion/duration_s": 1},
            files={"torques.csv": "t_s,x_N_m,y_N_m,z_N_m\n0,0,0,0\n1e-9,0,0,10\n0.5,0,0,0\n1,0,0,0\n"},
            unless={"/effects": None}),
    explain("given_torque modelled ? ? ? ? not sized, since a table gives it",
            set={"/effects/given_torque": {"axes": "body", "course": "table", "file": "torques.csv"}},
            files={"torques.csv": "t_s,x_N_m,y_N_m,z_N_m\n0,0,0,0\n0.3,0,0,1e-4\n0.6,0,0,0\n1,0,0,0\n"},
            unless={"/effects": None}),
    figures("the rates are those at release, without the given torque",
            set={"/effects/given_torque": {"axes": "body", "torque_N_m": [0, 0, 1e-3]}}, unless={"/effects": None}),
    figures("precession, nutation and critical spin: the support is not equally stiff, so that gravity is not the only torque",
            set={"/effects/unequal_support": {"kappa_N_m": 0.01}}, unless={"/effects": None}),
    figures("precession, nutation and critical spin: the gimbal holds the axis level", set=LEVEL, unless={"/effects": None}),
    refused("/effects/tide: of Moon and Sun is computed for at most 3.2e7 s, a year; take a shorter duration, or a given amplitude",
            set={"/effects/tide": True, "/motion/start_utc": "2026-01-01T00:00:00Z", "/motion/duration_s": 3.201e7,
                 "/motion/output_step_s": 1e5}, unless={"/motion/duration_s": 3.2e7}),
    refused("/effects/coulomb_torque_N_m: is not available on a platform; leave one of the two out",
            set={"/effects/coulomb_torque_N_m": 1e-6, "/platform": TURNING}, unless={"/platform": None}),
    refused("/effects/select: sizes the effects for a top on a fixed pivot, and is not available with /contact; name the effects "
            "instead", TABLE, set={"/effects": "auto", "/accuracy/drift_rad": 1e-5}, unless={"/contact": None}),
]

FIT = [
    refused('"splitting" is not available on a platform; take "auto", or leave the platform out',
            set={"/numerics": {"method": "splitting", "step_s": 1e-3}, "/platform": TURNING}, unless={"/platform": None}),
    refused('"taylor" has no series where dry friction, quadratic drag or a disc\'s drag brakes a rate to zero; it works for '
            'symmetric tops that keep most of their spin; take "auto"',
            set={"/numerics/method": "taylor", "/effects/quadratic_torque_N_m_s2": 1e-3},
            unless={"/effects/quadratic_torque_N_m_s2": 1e-12}),
    refused('"splitting" works only for symmetric tops with their centre of mass on the axis; take "auto"', "asymmetric-top",
            set={"/numerics": {"method": "splitting", "step_s": 1e-3}}, unless={"/numerics": {"method": "auto"}}),
    refused('"splitting" has no general model; leave /numerics/model at "auto"',
            set={"/numerics": {"method": "splitting", "step_s": 1e-3, "model": "general"}}, unless={"/numerics/model": "auto"}),
    refused('"long_horizon" works only for tops symmetric about body axis 3 (equal moments 1 and 2, no products of inertia, '
            'centre of mass on the axis); take "auto"', set={"/numerics/method": "long_horizon", "/body/inertia": MATRIX},
            unless={"/body/inertia": {"principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}}),
    refused('"long_horizon" has its own variables, in laboratory axes; leave observer and model out, or take "auto"',
            set={"/numerics": {"method": "long_horizon", "observer": "inertial"}}, unless={"/numerics/observer": None}),
    refused('with dry friction a motion comes to rest within a step, which only "rkf78" and "extrapolation" find; take one of '
            'them, or "auto"', set={"/numerics/method": "dop853", "/effects/coulomb_torque_N_m": 1e-6},
            unless={"/numerics/method": "extrapolation"}),
]

CHOICE = [
    explain("a symmetric top on a table, integrated without its spin: Taylor series take the fewest operations", TABLE,
            unless={"/body/inertia/principal_kg_m2": [3e-5, 3.1e-5, 4e-5]}),
    explain("(a body on a table: Taylor series take the fewest operations", TABLE,
            set={"/body/inertia/principal_kg_m2": [3e-5, 3.1e-5, 4e-5]},
            unless={"/body/inertia/principal_kg_m2": [3e-5, 3e-5, 4e-5]}),
    explain("run would use rkf78 (dry friction: short steps end where a motion comes to rest; in body axes)", "free-gyro",
            set={"/effects/coulomb_torque_N_m": 1e-3, "/release/spin_rad_s": 3},
            unless={"/effects/coulomb_torque_N_m": 0}),
    explain("run would use extrapolation (asked for; in body axes, where dry friction can hold a motion at rest)", "free-gyro",
            set={"/effects/coulomb_torque_N_m": 1e-3, "/release/spin_rad_s": 3, "/numerics/method": "extrapolation"},
            unless={"/effects/coulomb_torque_N_m": 0}),
    explain("run would use dop853 (drag may brake a rate to zero: no series passes that corner)", "free-gyro",
            set={"/effects/quadratic_torque_N_m_s2": 1e-3, "/release/spin_rad_s": 3},
            unless={"/effects/quadratic_torque_N_m_s2": 1e-12}),
    explain("run would use closed_form (the motion is known in closed form)", "free-gyro",
            unless={"/release/rates_relative_to": "laboratory"}),
    explain("run would use long_horizon (a fast symmetric top over many nutations: exact flows step over them)", "fast-gyro",
            set={"/motion/duration_s": 60}, unless={"/release/spin_rpm": 500}),
    explain("run would use fourier (a heavy symmetric top over many turns: its two motions are Fourier sums, which need no steps)",
            "fast-gyro", set={"/motion/duration_s": 600}, unless={"/motion/duration_s": 0.5}),
    explain("run would use taylor (a symmetric top, integrated without its spin: Taylor series take the fewest operations)",
            unless={"/body/inertia": MATRIX}),
    explain("run would use taylor (Taylor series of the equations in body axes take the fewest operations)", "asymmetric-top",
            unless={"/body/inertia/principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}),
]

# The cost.

COST = [
    # A slip dies out at k (1/m + r^2/I) = k 43.9/kg, up to five times within a step.
    refused("/contact/sliding_viscosity_N_s_m: this friction is too stiff: a slip dies out at about", TABLE,
            set={"/contact": {"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 1e8}},
            unless={"/contact/law": "rolling", "/contact/sliding_viscosity_N_s_m": None},
            holds=lambda text: near((numbers(text, "dies out at about # 1/s")[0], 4.4e9), within=0.05)
            and 'take a smaller coefficient, a shorter duration, or "rolling", its limit' in text),
    refused("at most an hour is allowed; take a larger regularisation or a shorter duration", TABLE,
            set={"/contact": {**EXACT, "regularisation_m_s": 6.4e-5}, "/motion": {"duration_s": 1e5, "output_step_s": 1e3}},
            unless={"/contact/regularisation_m_s": 1e-2},
            holds=lambda text: near((numbers(text, "a slip dies out at about # 1/s")[0], 1e5), within=0.01)),
    refused("take a larger patch or a shorter duration", TABLE, set={"/contact/patch_radius_m": 1e-9, "/motion/duration_s": 600},
            unless={"/contact/patch_radius_m": 1e-4}),
    refused("/contact/rolling_resistance_m: this friction is too stiff: a turn dies out at about", TABLE,
            set={"/contact/rolling_resistance_m": 1e-3, "/contact/regularisation_rad_s": 1e-8},
            unless={"/contact/regularisation_rad_s": 1},
            holds=lambda text: "take a larger regularisation_rad_s or a shorter duration" in text
            and near((numbers(text, "dies out at about # 1/s")[0], 1e-3 * 0.1 * G / (3e-5 * 1e-8)), within=0.05)),
    # c/I3 is the fastest rate.
    refused("it damps at about 2.5e+08 1/s (coefficient over moment of inertia), 1.5e+10 time constants within the duration, of "
            "which a step of an explicit method covers a few", set={"/effects/viscous_torque_N_m_s": 1e4},
            unless={"/motion/duration_s": 1e-3, "/motion/output_step_s": 1e-3}),
    refused("at most 2.0e+09 steps are allowed; take a shorter duration, a slower spin or a looser tolerance",
            set={"/numerics/method": "rkf78", "/motion/duration_s": 1e8, "/motion/output_step_s": 1e5},
            unless={"/motion/duration_s": 1e6},
            holds=lambda text: numbers(text, "this scenario needs about # steps")[0] > 2e9),
    refused("at most one day is allowed; take a shorter duration, a slower spin, a looser tolerance or less precision",
            set={"/numerics/precision": "float128", "/motion/duration_s": 5e5, "/motion/output_step_s": 1e3},
            unless={"/motion/duration_s": 5e4}, holds=lambda text: "in float128 this scenario needs about" in text),
]

# The figures of the top. Its spins are in rad/s, m g l = 0.02942 N m.

HANGING = {"/site/gravity_m_s2": 9, "/body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 1],
                                              "inertia": {"about": "center_of_mass", "principal_kg_m2": [8, 8, 1]}}}
LEAST = 2 * math.sqrt(1.2e-4 * 0.1 * G * 0.03 * math.cos(math.radians(20))) / 4e-5

FIGURES = [
    check("precession, nutation and critical spin: axis 3 is not a principal axis of the body about the pivot",
          set={"/body/inertia": MATRIX}, unless={"/body/inertia": {"principal_kg_m2": [1.2e-4, 1.1e-4, 4e-5]}}),
    check("the precessions are those on this table, with the tip's motion", "routh-sphere",
          unless={"/contact/table": {"tilt_deg": 0.1}}),
    check("nutation and critical spin: the formulas are those of a fixed pivot, and the tip moves on the table", "routh-sphere",
          unless={"/contact": None}),
    check("left out precession, nutation and critical spin: the formulas are those of a fixed pivot, and the tip moves on the "
          "table", TABLE, unless={"/contact": {"tip_radius_m": 0.002, "law": "rolling"}}),
    check("I3 is the middle moment: turning about axis 3 is unstable", "dzhanibekov",
          unless={"/body/inertia/principal_kg_m2": [4e-6, 6e-6, 7e-6]}),
    check("nutation: I1 and I2 about the pivot are not equal", "dzhanibekov",
          unless={"/body/inertia/principal_kg_m2": [1e-5, 1e-5, 7e-6]}),
    check("nutation: axis 3 is not a principal axis of the body about the pivot", "free-gyro",
          set={"/body/inertia": {"matrix_kg_m2": [[4e-4, 0, 1e-6], [0, 4e-4, 0], [1e-6, 0, 5e-4]]}},
          unless={"/body/inertia": {"principal_kg_m2": [4e-4, 4e-4, 5e-4]}}),
    check("nutation: the body is at rest", "free-gyro", set={"/release/spin_rad_s": 0}, unless={"/release/spin_rad_s": 1e-9}),
    check("steady precession: at this tilt it needs a spin of at least", set={"/release/spin_rad_s": LEAST - EDGE},
          unless={"/release/spin_rad_s": LEAST + EDGE},
          holds=lambda text: near((numbers(text, "at least # rad/s (# rpm)")[0], LEAST),
                                  (numbers(text, "at least # rad/s (# rpm)")[1], LEAST * 30 / math.pi), within=1e-5)),
    check("steady precession: a top at 90 degrees needs a spin", set={"/release": {"tilt_deg": 90, "spin_rad_s": 0}},
          unless={"/release/spin_rad_s": 1e-9}),
    check("the axis is vertical: the precessions are those of a small lean", set={"/release": {"tilt_deg": 0, "spin_rad_s": 200}},
          unless={"/release/tilt_deg": EDGE}),
    check("without spin the two precessions are those of a conical pendulum, either way round", "foucault-pendulum",
          unless={"/release/spin_rad_s": EDGE}),
    check("nutation: the upright top is not stable at this spin", set={"/release": {"tilt_deg": 0, "spin_rad_s": 93.946}},
          unless={"/release/spin_rad_s": 93.947}),
    # Twice m g l = I1 w^2/2: this push brings the pendulum up, and it never comes to rest there.
    check("nutation: this release tends to the upright position and has no period",
          set={**HANGING, "/release": {"quaternion_LB": {"w": 0, "x": 1, "y": 0, "z": 0}, "angular_velocity_body_rad_s": [2, 0, 0]}},
          unless={"/release/angular_velocity_body_rad_s": [2.0001, 0, 0]}),
    check("mean precession: the axis passes through the vertical, or too near it",
          set={"/release": {"tilt_deg": 0, "angular_velocity_body_rad_s": [EDGE, 0, 80]}},
          unless={"/release": {"tilt_deg": EDGE, "angular_velocity_body_rad_s": [0, 0, 80]}}),
    check("the top swings as a pendulum: its tilt has half the period of a full swing",
          set={**HANGING, "/release": {"tilt_deg": 180, "angular_velocity_body_rad_s": [1.999, 0, 0]}},
          unless={"/release/angular_velocity_body_rad_s": [2.001, 0, 0]}),
    check("precession, nutation and critical spin: I1 and I2 about the pivot are not equal", "asymmetric-top",
          unless={"/body/inertia/principal_kg_m2": [1.2e-4, 1.2e-4, 4e-5]}),
    check("the rates are those at release, without friction", set={"/effects/viscous_torque_N_m_s": 1e-9},
          unless={"/effects/viscous_torque_N_m_s": 0}),
]

# Values that are hardly meant.

DOUBTS = [
    check("/release/tilt_deg: 0.34906585 is 20 degrees in radians; the unit here is degrees", set={"/release/tilt_deg": 0.34906585},
          unless={"/release/tilt_deg": 0.349}),
    check("is the Earth's rate in degrees per hour; in rad/s it is 7.292115e-5", set={"/earth/rotation_rate_rad_s": 15.04},
          unless={"/earth/rotation_rate_rad_s": 15.5}),
    check("the centre of mass is 1.5 m from the pivot, 75 times the radius of gyration; are these millimetres?",
          set={"/body/center_of_mass_m": [0, 0, 1.5],
               "/body/inertia": {"about": "center_of_mass", "principal_kg_m2": [3e-5, 3e-5, 2e-5]}},
          unless={"/body/center_of_mass_m": [0, 0, 0.99]}),
    check("/body/solids/0/density_kg_m3: 2.7 kg/m^3 is the density of a foam; are these g/cm^3 (write 2700)?",
          set={"/body": {"solids": [{"shape": "disc", "radius_m": 0.03, "length_m": 0.01, "density_kg_m3": 2.7, "at_m": 0.03}]}},
          unless={"/body/solids/0/density_kg_m3": 2700}),
    check("its rim would move at about", set={"/release/spin_rad_s": 4e5}, unless={"/release/spin_rad_s": 5e4}),
    check("/contact/tip_radius_m: 2 m is larger than the body, whose radius of gyration is 0.022 m; are these millimetres (write "
          "0.002)?", TABLE, set={"/contact/tip_radius_m": 2}, unless={"/contact/tip_radius_m": 0.002}),
    check("/contact/patch_radius_m: 0.1 m is larger than the radius of the tip, 0.002 m, and a tip touches only with a small part "
          "of it, about 3e-5 m for steel on glass; are these millimetres (write 0.0001)?", TABLE,
          set={"/contact/patch_radius_m": 0.1}, unless={"/contact/patch_radius_m": 1e-4}),
    check("/contact/friction_coefficient: 20 is more than rubber on dry asphalt has; is it in percent (write 0.2)?", TABLE,
          set={"/contact/friction_coefficient": 20}, unless={"/contact/friction_coefficient": 1.9}),
    check("/contact/static_coefficient: 20 is more than rubber on dry asphalt has; is it in percent (write 0.2)?", "routh-sphere",
          set={"/contact/static_coefficient": 20}, unless={"/contact/static_coefficient": 1.9}),
    check("/contact/rolling_resistance_m: 0.01 m is a lever arm longer than the tip's radius; is it a dimensionless coefficient, or "
          "in millimetres?", TABLE, set={"/contact/rolling_resistance_m": 0.01, "/contact/regularisation_rad_s": 1},
          unless={"/contact/rolling_resistance_m": 0.0019}),
]

# A top on a table.

ROD = {
    "site": {"latitude_deg": 45, "gravity_m_s2": 9.81},
    "body": {"mass_kg": 1, "center_of_mass_m": [0, 0, 0.5],
             "inertia": {"about": "center_of_mass", "principal_kg_m2": [1 / 12, 1 / 12, 1e-4]}},
    "release": {"tilt_deg": 26.565, "azimuth_deg": 90, "angular_velocity_body_rad_s": [0, 1, 0]}, "motion": {"duration_s": 1},
    "contact": {"tip_radius_m": 0, "law": "coulomb", "tip_velocity_m_s": [-1, 0], "friction_coefficient": 0.5,
                "rolling_resistance_m": 1, "regularisation_rad_s": 1e-3},
}
ROLLING = {"/contact": {**EXACT, "start": "rolling"}}
BEGINS = {"/motion": {"duration_s": 1, "output_step_s": 0.1}}

ON_TABLE = [
    refused("/contact: the forces at the release are too large for a double; give a body and rates of everyday size", "rolling-ball",
            set={"/body/mass_kg": 5e-309}, unless={"/body/mass_kg": 6e-309}),
    # Rolling resistance, too, presses the tip of a rod into the table; the number of the remedy is a limit.
    refused("/contact/rolling_resistance_m: no unique force of the table exists at the release (Painleve's paradox: friction presses "
            "the tip into the table more than the table can push); rolling_resistance_m must be below 0.3725 in this release", ROD,
            set={"/contact/rolling_resistance_m": 0.373}, unless={"/contact/rolling_resistance_m": 0.3725}),
    refused("give less friction and less resistance, or another tilt or direction of slip", ROD,
            set={"/contact/friction_coefficient": 3}, unless={"/contact/friction_coefficient": 0.5}),
    refused("the tip is released without slip, and to roll it needs a friction of 0.2557 times the normal force: it slips at once, "
            "and how the slip begins is not computed; release it with a velocity, or take \"contensou\"", TABLE, set=ROLLING,
            unless={"/contact/friction_coefficient": 0.2558}),
    refused("m/s makes a slip die out at 6.37e+12 per second, which every step of an explicit method has to follow; at least "
            "6.4e-05 m/s, for 100000 per second, or 0 for the exact law, whose stops are events", TABLE,
            set={"/contact": {**EXACT, "regularisation_m_s": 1e-12}}, unless={"/contact/regularisation_m_s": 6.4e-5}),
    refused("the exact law, whose slip stops, is integrated for bodies that are symmetric about axis 3 only; give a regularisation "
            "above 0, or take \"contensou\"", TABLE,
            set={"/contact": EXACT, "/body/inertia/principal_kg_m2": [3e-5, 3.1e-5, 4e-5]},
            unless={"/contact/regularisation_m_s": 1e-4}),
    explain("torque: about the centre of mass, at release and at its largest; on the rotating Earth", TABLE),
    # Where a tip slides, dry friction is its coefficient times the normal force.
    explain("Friction at its largest is 0.2 times the normal force", TABLE,
            set={"/contact": {**EXACT, "tip_velocity_m_s": [1, 0]}, "/motion/duration_s": 0.1},
            unless={"/contact/friction_coefficient": 0.21}),
    explain("How well the inputs must be known: the error of each that moves the prediction at 1 s as far as the Earth does", TABLE,
            unless={"/contact/max_tilt_deg": 20.0001}),
    explain("How well the inputs must be known: not known", TABLE, set={"/contact/max_tilt_deg": 20.0001},
            unless={"/contact/max_tilt_deg": 25}),
    explain("(nobody knows a coefficient of friction to 1 %, and few tables are level to an arcsecond)", TABLE,
            unless={"/contact": {"tip_radius_m": 0.002, "law": "frictionless"}}),
    explain("arcsec (tip) (few tables are level to an arcsecond)", "routh-sphere",
            unless={"/contact": {"tip_radius_m": 0.02, "law": "viscous", "sliding_viscosity_N_s_m": 1}}),
    explain("s the tilt exceeds the largest one allowed, and the rim touches the table: the run ends", "routh-sphere",
            set={"/contact/max_tilt_deg": 60.000001, "/motion/duration_s": 2}, unless={"/motion/duration_s": 1.4},
            holds=lambda text: 1.41 < numbers(text, "At t = # s the tilt exceeds")[0] < 1.42),
    explain("The motion was followed only until then; to 60 s it would take longer", TABLE,
            set={"/contact/spinning_friction_m": 1e-6, "/contact/regularisation_rad_s": 1e-8, "/motion/duration_s": 60},
            unless={"/contact/regularisation_rad_s": 1}),
    # Sizes are found in double precision, whatever that of a run is.
    explain("Drift by the Earth's rotation after 60 s: axis", TABLE,
            set={"/numerics/precision": "float128", "/motion/duration_s": 60},
            holds=lambda text: "followed only" not in text),
    Case("run s.json --long", "friction does no work, and the Jacobi integral is constant to", "walking-top", set=BEGINS,
         unless={"/contact": {"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 1}},
         holds=lambda text: numbers(text, "is constant to # of its size, in both predictions")[0] < 1e-13),
    Case("run s.json --long", "by t = 1 s it changes, with inputs that nobody knows well, by axis", "walking-top", set=BEGINS,
         unless={"/contact": None}),
    Case("run s.json --long", "few tables are level to an arcsecond, so the prediction is uncertain; the drift, on the same table in both "
         "predictions, is well defined", "walking-top", set=BEGINS,
         unless={"/contact": {"tip_radius_m": 0.002, "law": "viscous", "sliding_viscosity_N_s_m": 1}}),
    Case("run s.json --long", "they would take about", TABLE,
         set={"/report/sensitivities": True, "/contact/spinning_friction_m": 1e-6, "/contact/regularisation_rad_s": 1e-9,
              "/motion/duration_s": 2}, unless={"/report/sensitivities": False},
         holds=lambda text: numbers(text, "they would take about # minutes; at most 20 minutes are spent")[0] > 20),
]

# The budget of effects.

FRICTION = {"/effects/coulomb_torque_N_m": 1e-3, "/release/spin_rad_s": 3, "/motion/duration_s": 3}
FELL = {"/release": {"tilt_deg": 180, "angular_velocity_body_rad_s": [3, 0, 0]}}
DATE = {"/motion/start_utc": "2026-06-01T00:00:00Z"}


def sizes(text):
    """Displacements and drifts of all effects in a budget as JSON."""
    return [size or 0 for one in json.loads(text)["effects"] for size in (one["displacement_rad"], one["drift_rad"])]


def is_larger(text):
    """The torque left out is larger than the one modelled, of which the warning says so."""
    modelled, left_out = numbers(text, "the scenario models centrifugal (# N m at its largest) and leaves out tide (# N m)")
    return left_out > modelled


BUDGET = [
    Case("explain s.json", "Drift by the Earth's rotation after 60 s: about",
         holds=lambda text: near((numbers(text, "60 s: about # rad")[0], changed("toy-top", {})["headline"]["value"]), within=5e-4)),
    explain("moves axis: in both predictions alike, so that it cancels in their difference to first order; what remains is under "
            "drift"),
    explain("(for latitude and rotation rate: an error that changes the drift by its whole size)",
            unless={"/earth/rotation_rate_rad_s": 0},
            holds=lambda text: near((numbers(text, "rotation_rate_rad_s 7.29211e-05 # rad/s, # of it")[1], 1))),
    explain("gravity_m_s2 9.80665 has no part in it", "free-gyro", unless={"/body/center_of_mass_m": [0, 0, 1e-6]}),
    explain("The motion was followed for 1.35 s; sizes after that are taken in proportion to time and drift.", "free-gyro",
            set=FRICTION, unless={"/motion/duration_s": 1.35}),
    Case("explain s.json --json", "sizes above 1 rad are of first order only: they say no more than that the effect changes the "
         "motion altogether", set={"/effects/viscous_torque_N_m_s": 4e-7, "/motion/duration_s": 10},
         unless={"/effects/viscous_torque_N_m_s": 1e-7}, holds=lambda text: max(sizes(text)) > 1),
    explain("which is larger", unless={"/effects/centrifugal": False}, holds=is_larger),
    explain("Drift by the Earth's rotation after 1 s: not known", set={**FELL, "/effects/coulomb_torque_N_m": 1e-3},
            unless={"/effects/coulomb_torque_N_m": 1e-2},
            holds=lambda text: "Inputs: the drift is not known" in text and "in proportion to time" not in text),
    explain("the motion could be followed for 0.08923 s only (step_underflow), so that the drifts are not known",
            set={**FELL, "/effects/coulomb_torque_N_m": 1e-3}, unless={"/effects/coulomb_torque_N_m": 3e-3}),
    # A pendulum is released at rest.
    explain("the motion could be followed for 0 s only (dry friction has no direction at rest), so that the drifts are not known",
            "foucault-pendulum", set={"/effects/coulomb_torque_N_m": 1e-6}, unless={"/effects/coulomb_torque_N_m": 0}),
    # Strong drag brakes the top before the first step that its rates would suggest.
    explain("Drift by the Earth's rotation after 10 s: about 1.788e-08 rad",
            set={"/effects/quadratic_torque_N_m_s2": 0.03, "/release/tilt_deg": 30, "/motion/duration_s": 10}),
    explain("Inputs: the Earth does not turn, so that there is no effect to see", set={"/earth/rotation_rate_rad_s": 0},
            unless={"/earth/rotation_rate_rad_s": 1e-9}),
    explain("drift: the effect's share of the difference between the two predictions; both columns at their largest, to first order"),
    explain("an effect of the Earth's rotation: on unless switched off", unless={"/effects/coriolis": False}),
    explain("of second order in the Earth's rate; the first-order part is in apparent gravity", unless={"/effects/centrifugal": False}),
    explain("the two predictions start with the same inertial rates, so that their rates in the laboratory differ by the Earth's",
            set={"/release/rates_relative_to": "inertial"}, unless={"/release/rates_relative_to": "laboratory"}),
    explain("left out; sized for the secular pole at 2026-01-01T00:00:00Z", unless=DATE),
    explain("left out; sized for the secular pole ", set=DATE,
            unless={"/effects/polar_motion": {"x_arcsec": 0.1, "y_arcsec": 0.3}}),
    explain("left out; sized for a rigid Earth at 2026-01-01T00:00:00Z", unless=DATE),
    explain("left out; sized for a rigid Earth ", set=DATE, unless={"/effects/tide": True}),
    explain("left out; sized for a day that is longer by 1 ms", unless={"/effects/excess_length_of_day_ms": 2}),
    explain("left out; sized for 10 arcsec to the North", unless={"/effects/deflection_of_vertical": {"north_arcsec": 5}}),
    # 50.3 arcsec a year are 7.7e-12 rad/s, about the pole of the ecliptic.
    explain("never modelled: the Earth's axis precesses once in 26,000 years, at 4e-8 of the Earth's rate",
            set={"/earth/rotation_rate_rad_s": 0}),
    explain("left out; sized for the tensor of the normal field", unless={"/effects/gravity_gradient": "normal"}),
    explain("viscous_torque left out ? ? ? ? left out; the scenario gives no coefficient",
            unless={"/effects/viscous_torque_N_m_s": 1e-9}),
    explain("transverse modelled 0.00e+00 0.00e+00 - 0.00e+00 zero: the Earth turns uniformly", unless={"/effects/transverse": False}),
    explain("transverse left out 0.00e+00 0.00e+00 - 0.00e+00 zero: the Earth turns uniformly", set={"/effects/transverse": False},
            unless={"/effects/transverse": True}),
    explain("platform_motion modelled ? ? ? ? not sized, since it carries both predictions", set={"/platform": TURNING},
            unless={"/platform": None}),
    explain("left out; the pivot is at rest in the laboratory", unless={"/platform": TURNING}),
    explain("not sized, since it is a constraint: it holds the axis level", set=LEVEL, unless={"/effects/gimbal": False}),
]


def coriolis_of_both(text):
    """At the release: h c of the rotor and the body's own turn, from the tensors; of the rotor alone at most C s Omega."""
    found = [float(x) for x in re.search(r"coriolis modelled ([0-9.e-]+) ([0-9.e-]+)", text).groups()]
    of_rotor = float(re.search(r"turn in the body alone it is ([0-9.e-]+) N m at most", text)[1])
    return found[0] <= found[1] and 0.9 * 4e-5 * 19.5 * OMEGA < of_rotor < 1.01 * 4e-5 * 20.4 * OMEGA


WITH_MASSES = [
    explain(["Equations: dL/dt = L x w + torque in body axes, w = I^-1 (L - h c - l); L: momentum of all parts; I and l: inertia and "
             "momentum in the body with the masses where they are; h c: momentum of a rotor",
             "an effect of the Earth's rotation; on what moves in the body alone it is",
             "Inputs: how well they must be known is not computed with masses that move in the body; run the scenario with each of "
             "them changed",
             "Warning: effects are sized only for a rigid body; to see what an effect does with moving masses, run the scenario with "
             "and without it"], "hard/g17-mass-in-a-cage", unless={"/moving_masses": None}),
]


WITH_ROTOR = [
    explain(["Equations: dL/dt = L x w + torque in body axes, w = I^-1 (L - h c); L: momentum of body and rotor; I: inertia of both "
             "without the rotor's about its axis c; h: momentum of the rotor about c, which is constant",
             "an effect of the Earth's rotation; on the rotor's turn in the body alone it is",
             "tide left out ? ? ? ? left out; sized only for a rigid body",
             "Inputs: how well they must be known is not computed with a rotor in the body; run the scenario with each of them "
             "changed",
             "Warning: effects are sized only for a rigid body; to see what an effect does with a rotor, run the scenario with and "
             "without it"], "tumbling-gyrostat", set={"/motion/duration_s": 20}, holds=coriolis_of_both, unless={"/rotor": None}),
    explain(["h: momentum of the rotor about c, which only the bearing's friction changes",
             "viscous_torque modelled ? ? ? ? as given; sized only for a rigid body",
             "rotor_bearing modelled 3.20e-04 3.20e-04 ? ? between rotor and body, along the rotor's axis: in a symmetric cage it "
             "does not move the axis"], "hard/g03-bearing-friction",  # 300 rad/s times 1e-6, and 2e-5 of dry friction
            unless={"/effects": {}, "/rotor/viscous_torque_N_m_s": 0, "/rotor/coulomb_torque_N_m": 0}),
    explain("w = I^-1 (L - C s c); L: momentum of body and rotor; I: inertia of both; s: rate that the motor gives the rotor about "
            "its axis c, with the moment C", "hard/g04-motor", unless={"/rotor/drive": "none"}),
    explain("Rotor: in a symmetric cage; computed is the rigid top that moves as its axis does, with the moments of both and the "
            "spin 342.857 rad/s, and the rows get the turn of cage and rotor", "caged-gyroscope",
            unless={"/body/inertia/principal_kg_m2/1": 1.4e-5}),
]

CASES = START + EFFECTS + FIT + CHOICE + COST + FIGURES + DOUBTS + ON_TABLE + BUDGET + WITH_ROTOR + WITH_MASSES
