# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions and rates given by elementary functions, and the mean rates of the heavy symmetric top."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _core
from ._argument_arrays import Numbers, broadcast, evaluated, given, quaternion, require, returned, top_parameters
from ._motions import State

class PrecessionRates(NamedTuple):
    """The two rates at which a symmetric top precesses at a constant tilt (rad/s, counterclockwise about Up)."""

    slow: np.ndarray  #: NaN where the spin is too slow for the tilt
    fast: np.ndarray  #: likewise; infinite at a tilt of exactly 90 deg


class MeanRates(NamedTuple):
    """The mean rates of a heavy symmetric top; NaN where the period of its tilt is infinite."""

    precession_rad_s: np.ndarray  #: mean rate of the axis's azimuth, counterclockwise about Up
    nutation_rad_s: np.ndarray  #: 2 pi over the period of the tilt


def mean_rates(*, I1: Numbers, I3: Numbers, mgl: Numbers, q0: Numbers, w0: Numbers) -> MeanRates:
    """The mean rates at which a heavy symmetric top precesses and nutates, however large its nutation is; in double precision.

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x signed distance of the centre of mass from the pivot (N m), not 0
    q0 : array_like, shape (..., 4)
        attitude q_NB at any time, of any norm but zero
    w0 : array_like, shape (..., 3)
        rate w_NB_B at that time, in body axes (rad/s)

    Returns
    -------
    MeanRates
        (rad/s), of the arguments' common shape

    Notes
    -----
    They are integrals over a period, to a relative accuracy of some 1e-13. An axis that goes through the vertical has no mean
    rate of its azimuth, which jumps there; the result is then NaN, or the mean without the jumps. [L. D. Landau and E. M.
    Lifshitz, Mechanics, section 35]
    """
    top = top_parameters("double", I1, I3, mgl)
    require("mgl", top[2], top[2] != 0, "other than 0 (N m)")
    arguments = [*((one, 1) for one in top), (quaternion("q0", q0, "double"), 4), (given("w0", w0, "double", 3), 3)]
    return MeanRates(*map(returned, _core.mean_rates(*broadcast(arguments))))


def steady_precession_rates(*, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers, cos_tilt: Numbers,
                            precision: str = "double") -> PrecessionRates:
    """The two rates at which a symmetric top precesses at a constant tilt.

    They are the roots of I1 cos(tilt) x^2 - I3 w3 x + mgl = 0, both computed without cancellation. [L. D. Landau and E. M.
    Lifshitz, Mechanics, section 35]

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x signed distance of the centre of mass from the pivot (N m)
    w3 : array_like
        component of the rate along the axis (rad/s)
    cos_tilt : array_like
        cosine of the angle between the axis and Up, -1 to 1
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    PrecessionRates
        ``slow`` and ``fast`` (rad/s, counterclockwise about Up), of the arguments' common shape; NaN where the spin is too
        slow for the tilt; ``fast`` is infinite at a tilt of exactly 90 deg
    """
    top = top_parameters(precision, I1, I3, mgl)
    spin, cosine = given("w3", w3, precision), given("cos_tilt", cos_tilt, precision)
    require("cos_tilt", cosine, abs(cosine) <= 1, "from -1 to 1")
    return PrecessionRates(*evaluated("steady_precession_rates", precision, [(one, 1) for one in (*top, spin, cosine)]))


def steady_precession(t: Numbers, *, q0: Numbers, precession_rate: Numbers, w3: Numbers, precision: str = "double") -> State:
    """Steady precession about Up from any attitude, at any tilt.

    It is the motion of a symmetric top if ``precession_rate`` is one of its rates at this tilt, and of a free symmetric body
    if its angular momentum points along Up.

    Parameters
    ----------
    t : array_like
        times (s)
    q0 : array_like, shape (..., 4)
        attitude q_NB at t = 0, of any norm but zero
    precession_rate : array_like
        rate of the precession (rad/s, counterclockwise about Up)
    w3 : array_like
        component of the whole rate along the axis (rad/s)
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    State
        of the arguments' common shape
    """
    return State(*evaluated("steady_precession", precision, [
        (quaternion("q0", q0, precision), 4), (given("precession_rate", precession_rate, precision), 1),
        (given("w3", w3, precision), 1), (given("t", t, precision), 1)]))


def critical_spin(*, I1: Numbers, I3: Numbers, mgl: Numbers, precision: str = "double") -> Any:
    """The spin above which the upright top is stable: 2 sqrt(I1 mgl) / I3 (rad/s).

    [T. W. B. Kibble and F. H. Berkshire, Classical Mechanics, eq. 12.26]

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x distance of the centre of mass from the pivot (N m), not negative
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    array
        (rad/s), of the arguments' common shape
    """
    top = top_parameters(precision, I1, I3, mgl)
    require("mgl", top[2], top[2] >= 0, "0 or positive (N m): a hanging top has no critical spin")
    return evaluated("critical_spin", precision, [(one, 1) for one in top])[0]


def upright_growth_rate(*, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers, precision: str = "double") -> Any:
    """The rate at which a small tilt of the upright top grows: sqrt(mgl/I1) sqrt(1 - f^2), f = w3 / critical spin (1/s).

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x distance of the centre of mass from the pivot (N m), positive
    w3 : array_like
        spin (rad/s)
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    array
        (1/s), of the arguments' common shape; 0 from the critical spin on
    """
    top = top_parameters(precision, I1, I3, mgl)
    require("mgl", top[2], top[2] > 0, "positive (N m)")
    return evaluated("upright_growth_rate", precision, [(one, 1) for one in (*top, given("w3", w3, precision))])[0]


def homoclinic_top(t: Numbers, *, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers, precision: str = "double") -> State:
    """The motion that leaves the upright position in the infinite past and returns to it in the infinite future.

    cos(tilt) = 1 - 2 k^2 sech^2(g t), with f = w3 / critical spin, k = sqrt(1 - f^2), g = k sqrt(mgl / I1). The lowest point
    is passed at t = 0; for w3 > 0 the axis then points South. For w3 = 0 it is the separatrix of the plane pendulum. [E. T.
    Whittaker, Analytical Dynamics, section 71, for the cubic with a double root]

    Parameters
    ----------
    t : array_like
        times (s)
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x distance of the centre of mass from the pivot (N m), positive
    w3 : array_like
        spin (rad/s), no faster than the critical spin, at which the top stays upright
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    State
        of the arguments' common shape
    """
    top, spin = top_parameters(precision, I1, I3, mgl), given("w3", w3, precision)
    require("mgl", top[2], top[2] > 0, "positive (N m)")
    state = State(*evaluated("homoclinic_top", precision,
                              [(one, 1) for one in (*top, spin, given("t", t, precision))]))
    require("w3", spin, state.q_NB == state.q_NB, "no faster than the critical spin (rad/s)")
    return state


def separatrix_free_body(t: Numbers, *, moments: Numbers, w2: Numbers, precision: str = "double") -> State:
    """The motion of a free body that turns over once: its rate goes from -w2 to w2 along the axis of the middle moment.

    The angular momentum is along Up (axis z of N). [L. D. Landau and E. M. Lifshitz, Mechanics, section 37]

    Parameters
    ----------
    t : array_like
        times (s); at t = 0 the rate has no component along axis 2
    moments : array_like, shape (..., 3)
        moments in ascending order along the body axes 1, 2, 3 (kg m^2)
    w2 : array_like
        rate in the infinite future (rad/s), positive
    precision : {"double", "long_double", "float128"}

    Returns
    -------
    State
        of the arguments' common shape
    """
    I, rate = given("moments", moments, precision, 3), given("w2", w2, precision)
    require("moments", I, (0 < I[..., 0]) & (I[..., 0] < I[..., 1]) & (I[..., 1] < I[..., 2]),
             "positive and in ascending order (kg m^2)")
    require("w2", rate, rate > 0, "positive (rad/s)")
    return State(*evaluated("separatrix_free_body", precision, [(I, 3), (rate, 1), (given("t", t, precision), 1)]))
