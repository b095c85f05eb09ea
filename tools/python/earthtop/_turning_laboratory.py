# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions as seen from the laboratory that rotates with the Earth; gyroscopes, sleeping tops and pendulums there."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Tuple

import numpy as np

from . import _core
from ._argument_arrays import Numbers, evaluated, given, quaternion, require, top_parameters
from ._errors import refuse
from ._motions import State

EARTH_RATE_RAD_S: float = _core.earth_rate_rad_s  #: nominal rate of the Earth, WGS 84 [NIMA TR8350.2]


class LaboratoryState(NamedTuple):
    """A motion as seen from the laboratory, which rotates with the Earth."""

    q_LB: np.ndarray  #: attitude, of unit norm and either sign; shape (..., 4)
    w_LB_B_rad_s: np.ndarray  #: rate relative to the laboratory, in body axes (rad/s); shape (..., 3)
    attitude_error_rad: np.ndarray  #: bound on the error of q_LB; shape (...)
    rate_error_rad_s: np.ndarray  #: bound on the error of w_LB_B_rad_s; shape (...)


class FirstOrder(NamedTuple):
    """A first-order value with a bound on what it leaves out."""

    value: np.ndarray
    left_out: np.ndarray  #: bound on the sum of the neglected terms of higher order


def earth_rate_L(latitude_deg: Numbers, rotation_rate: Numbers = EARTH_RATE_RAD_S, *, precision: str = "double") -> Any:
    """The Earth's rate in laboratory axes: rotation_rate (0, cos(latitude), sin(latitude)).

    Parameters
    ----------
    latitude_deg : array_like
        geodetic latitude (deg), -90 to 90
    rotation_rate : array_like, optional
        (rad/s); default: WGS 84
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    array, shape (..., 3)
        W_IL_L: East, North, Up (rad/s); exact at the poles and the equator
    """
    latitude = given("latitude_deg", latitude_deg, precision)
    require("latitude_deg", latitude, abs(latitude) <= 90, "from -90 to 90 (deg)")
    return evaluated("earth_rate_L", precision, [(latitude, 1), (given("rotation_rate", rotation_rate, precision), 1)])[0]


def seen_from_laboratory(state: State, t: Numbers, *, W_IL_L: Numbers, precision: str = "double") -> LaboratoryState:
    """A motion as seen from the laboratory: q_LB = exp(-[W]x t) q_NB, w_LB_B = w_NB_B - R_NB^T W.

    The result is the motion on the rotating Earth that starts with the same attitude and the same *inertial* rate, at either
    pole for any body, and at any latitude for a body without torque. Elsewhere the torque of gravity turns with the Earth, and
    the result is not a solution.

    Parameters
    ----------
    state : State
        the motion in inertial axes
    t : array_like
        the times of ``state`` (s)
    W_IL_L : array_like, shape (..., 3)
        the Earth's rate in laboratory axes (rad/s), as ``earth_rate_L`` gives it
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    LaboratoryState
        of the arguments' common shape
    """
    try:
        q_NB, w_NB_B, attitude_error, rate_error = state
    except (TypeError, ValueError):
        raise refuse("state must be what `at` or a closed form of this module returns") from None
    return LaboratoryState(*evaluated("seen_from_laboratory", precision, [
        (quaternion("state.q_NB", q_NB, precision), 4), (given("state.w_NB_B_rad_s", w_NB_B, precision, 3), 3),
        (given("state.attitude_error_rad", attitude_error, precision), 1),
        (given("state.rate_error_rad_s", rate_error, precision), 1), (given("W_IL_L", W_IL_L, precision, 3), 3),
        (given("t", t, precision), 1)]))


def balanced_gyroscope_axis_L(t: Numbers, *, axis_L: Numbers, W_IL_L: Numbers, precision: str = "double") -> Any:
    """The axis of a balanced gyroscope, which keeps its direction in inertial space: exp(-[W]x t) axis_L.

    [L. Foucault, C. R. Acad. Sci. Paris 35 (1852) 421]

    Parameters
    ----------
    t : array_like
        times (s)
    axis_L : array_like, shape (..., 3)
        the axis at t = 0, in laboratory axes (East, North, Up)
    W_IL_L : array_like, shape (..., 3)
        the Earth's rate in laboratory axes (rad/s)
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    array, shape (..., 3)
        the axis in laboratory axes, as long as ``axis_L``
    """
    return evaluated("balanced_gyroscope_axis_L", precision, [
        (given("axis_L", axis_L, precision, 3), 3), (given("W_IL_L", W_IL_L, precision, 3), 3),
        (given("t", t, precision), 1)])[0]


def balanced_gyroscope_drift(t: Numbers, *, axis_sine: Numbers, earth_rate: Numbers = EARTH_RATE_RAD_S,
                             precision: str = "double") -> Any:
    """The angle between the axis of a balanced gyroscope at time t and at the start (rad).

    Parameters
    ----------
    t : array_like
        times (s)
    axis_sine : array_like
        sine of the angle between the axis and the celestial axis, 0 to 1
    earth_rate : array_like, optional
        (rad/s); default: WGS 84
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    array
        (rad), 0 to pi, of the arguments' common shape
    """
    sine = given("axis_sine", axis_sine, precision)
    require("axis_sine", sine, (0 <= sine) & (sine <= 1), "from 0 to 1")
    return evaluated("balanced_gyroscope_drift", precision, [
        (sine, 1), (given("earth_rate", earth_rate, precision), 1), (given("t", t, precision), 1)])[0]


def sleeping_top_lean_south(*, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers, W_IL_L: Numbers,
                            precision: str = "double") -> FirstOrder:
    """How far to the South of Up a sleeping top comes to rest on the Earth: I3 w3 W_north / mgl (rad).

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x signed distance of the centre of mass from the pivot (N m), not 0
    w3 : array_like
        spin (rad/s)
    W_IL_L : array_like, shape (..., 3)
        the Earth's rate in laboratory axes (rad/s)
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    FirstOrder
        (rad), of the arguments' common shape; the terms left out are of second order in the Earth's rate
    """
    return FirstOrder(*evaluated("sleeping_top_lean_south", precision, _leaning(precision, I1, I3, mgl, w3, W_IL_L)))


def resting_axis_L(*, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers, W_IL_L: Numbers, precision: str = "double") -> Any:
    """The axis that is exactly at rest in the laboratory: parallel to mgl z - (I3 w3 - I1 W.n) W, the solution near +z.

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x signed distance of the centre of mass from the pivot (N m), not 0
    w3 : array_like
        component of the inertial rate along the axis (rad/s)
    W_IL_L : array_like, shape (..., 3)
        the Earth's rate in laboratory axes (rad/s); the torque must exceed twice I1 W^2
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    array, shape (..., 3)
        unit vector in laboratory axes (East, North, Up)
    """
    arguments = _leaning(precision, I1, I3, mgl, w3, W_IL_L)
    (inertia, _), _, (torque, _), _, (W, _) = arguments
    strength = inertia * (W * W).sum(axis=-1)
    require("mgl", torque, 2 * strength <= abs(torque), "at least 2 I1 W^2 in size (N m)")
    return evaluated("resting_axis_L", precision, arguments)[0]


def _leaning(precision: str, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers,
             W_IL_L: Numbers) -> List[Tuple[np.ndarray, int]]:
    top = top_parameters(precision, I1, I3, mgl)
    require("mgl", top[2], top[2] != 0, "other than 0 (N m)")
    return [*((one, 1) for one in (*top, given("w3", w3, precision))), (given("W_IL_L", W_IL_L, precision, 3), 3)]


def foucault_rate(*, I1: Numbers, I3: Numbers, mgl: Numbers, amplitude: Numbers, W_IL_L: Numbers,
                  precision: str = "double") -> FirstOrder:
    """The rate at which the plane of swing of a pendulum turns that is released at rest in the laboratory.

    It is -W_up (1 - I3 / (2 I1)), which is Foucault's rate only for a point bob; it is exact for the linear pendulum on a
    rotating floor.

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the pendulum (kg m^2); I3 may be 0
    mgl : array_like
        mass x apparent gravity x signed distance of the centre of mass from the pivot (N m), negative: it hangs
    amplitude : array_like
        (rad), above 0 and at most 0.5
    W_IL_L : array_like, shape (..., 3)
        the Earth's rate in laboratory axes (rad/s)
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    FirstOrder
        (rad/s, counterclockwise about Up), of the arguments' common shape
    """
    top, swing = top_parameters(precision, I1, I3, mgl, point_bob=True), given("amplitude", amplitude, precision)
    require("mgl", top[2], top[2] < 0, "negative (N m): a pendulum hangs")
    require("amplitude", swing, (0 < swing) & (swing <= 0.5), "above 0 and at most 0.5 (rad)")
    return FirstOrder(*evaluated("foucault_rate", precision, [
        *((one, 1) for one in (*top, swing)), (given("W_IL_L", W_IL_L, precision, 3), 3)]))
