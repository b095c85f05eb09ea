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
RUN = "run s.json --out out --force"
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


def vertical(scenario):
    return changed(scenario, {})["site"]["latitude_deg"]


def moments(scenario, changes=None):
    """About the outer axis and the inner one, of an upright suspension with diagonal moments: A3 + B1 sin(b)^2 + B3 cos(b)^2, B2."""
    s = changed(scenario, changes or {})
    b = math.radians(s["release"]["inner_angle_deg"])
    ring = s["gimbals"].get("outer", {}).get("inertia", {}).get("principal_kg_m2", [0, 0, 0])
    body, across = s["body"]["inertia"]["principal_kg_m2"], s["rotor"]["transverse_kg_m2"]
    return ring[2] + (body[0] + across) * math.sin(b)**2 + body[2] * math.cos(b)**2, body[1] + across


def momentum(scenario, changes=None):
    """Of the rotor, in space: the gimbal's rate has a part along its axis."""
    s = changed(scenario, changes or {})
    release, latitude = s["release"], math.radians(s["site"]["latitude_deg"])
    b = math.radians(release["inner_angle_deg"])
    return s["rotor"]["axial_kg_m2"] * (s["rotor"]["spin_rad_s"] + release.get("outer_rate_rad_s", 0) * math.cos(b))


CASES = REFUSED
