# SPDX-License-Identifier: GPL-3.0-or-later
"""A laboratory that travels: its columns, its summary, and its speed and course as inputs."""

import math

import numpy as np
import pytest

import earthtop as et

EARTH_RATE = 7.292115e-5
KNOT = 1852 / 3600


def settled(course_deg, speed_m_s, latitude_deg=60.0):
    """Where a damped level compass settles: the azimuth of the level part of the laboratory's inertial rate (rad)."""
    a, e2 = 6378137.0, 0.00669437999014
    q = 1 - e2 * math.sin(math.radians(latitude_deg)) ** 2
    meridian, prime = a * (1 - e2) / q**1.5, a / math.sqrt(q)
    course = math.radians(course_deg)
    return math.atan2(-speed_m_s * math.cos(course) / meridian,
                      EARTH_RATE * math.cos(math.radians(latitude_deg)) + speed_m_s * math.sin(course) / prime)


@pytest.fixture(scope="module")
def ship():
    return et.example("ship-gyrocompass").changed({"motion/duration_s": 200, "motion/output_step_s": 10})


def test_rows_and_summary(ship):
    r = et.run(ship)
    assert r.latitude_deg.shape == r.course_deg.shape == r.t_s.shape
    assert np.all(r.speed_m_s == 20 * KNOT) and np.all(r.course_deg == 0) and np.all(r.height_m == 0)
    travel = r.summary["travel"]
    # Rounding: of some tens of operations for the length, of the radii of the ellipsoid for the false North.
    assert travel["reference"] == "at_rest" and travel["length_m"] == pytest.approx(20 * KNOT * 200, rel=1e-14)
    assert travel["end_latitude_deg"] == r.latitude_deg[-1] > 60 and r.longitude_deg[-1] == travel["end_longitude_deg"]
    assert travel["false_north_start_rad"] == pytest.approx(settled(0, 20 * KNOT), rel=1e-12)
    assert "latitude_deg" in dir(r) and "latitude_deg" not in dir(et.run(et.example("toy-top"), duration_s=0.1))


def test_derivatives_by_speed_and_course(ship):
    # The drift is the angle from North.
    r = et.run(ship, {"uncertainty": {"travel_speed_m_s": 0.1, "travel_course_deg": 1}})
    inputs = {one["name"]: one["d_axis_rad"] for one in r.summary["sensitivities"]["inputs"]}
    v, end = 20 * KNOT, float(r.latitude_deg[-1])
    north = math.degrees(1e-3 * 200 / 6.384e6)  # a faster ship is farther North at the end
    by_speed = (abs(settled(0, v + 1e-3, end + north)) - abs(settled(0, v - 1e-3, end - north))) / 2e-3
    by_course = (abs(settled(0.01, v, end)) - abs(settled(-0.01, v, end))) / 0.02
    # The compass lags behind the ship by the time of its damping, some 30 s of 200 s.
    assert inputs["travel_speed_m_s"] == pytest.approx(by_speed, rel=2e-4)
    assert inputs["travel_course_deg"] == pytest.approx(by_course, rel=1e-3)


def test_a_study_of_courses(ship):
    courses = [0, 45, 90, 180]
    table = et.study(ship, {"travel/course_deg": courses}, collect={"north": "travel.false_north_start_rad"})
    # Rounding; at 90 deg the false North is 0 but for the cosine of a rounded right angle.
    assert list(table.north) == pytest.approx([settled(course, 20 * KNOT) for course in courses], rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("name, per_m_s", [("travel/speed_m_s", 1), ("travel/speed_kn", 1 / KNOT)])
def test_a_fit_finds_the_speed(ship, name, per_m_s):
    data = et.simulate_measurement(ship, {"azimuth_deg": 0.01}, every_s=5, seed=3)
    start = ship.changed({"travel/speed_kn": 18, "uncertainty": {"travel_speed_m_s": 0.01}})
    free, held = et.fit(start, data, [name]), et.fit(start, data, [name], priors=True)
    speed = free.estimates.iloc[0]
    assert abs(speed.estimate / per_m_s - 20 * KNOT) < 4 * speed.standard_error / per_m_s < 0.05
    # With the prior of 0.01 m/s at 18 knots both errors add up by their squares.
    own, both = speed.standard_error / per_m_s, held.estimates["standard_error"].iloc[0] / per_m_s
    assert both == pytest.approx(1 / math.hypot(1 / own, 1 / 0.01), rel=1e-3)
