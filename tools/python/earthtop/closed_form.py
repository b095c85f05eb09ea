# SPDX-License-Identifier: GPL-3.0-or-later
"""Motions that have closed forms, for arrays of times and parameters.

>>> import numpy as np
>>> from earthtop.closed_form import LagrangeTop
>>> top = LagrangeTop(I1=1.2e-4, I3=4e-5, mgl=0.0294, q0=[1, 0.2, 0, 0], w0=[0, 0, 200])
>>> motion = top.at(np.linspace(0, 1, 1001))
>>> motion.q_NB.shape, motion.w_NB_B.shape, motion.attitude_error_rad.shape
((1001, 4), (1001, 3), (1001,))
>>> top.regime
'cusped'

``LagrangeTop`` and ``FreeBody`` give the whole motion of a heavy symmetric top and of a free rigid body. The functions are
special cases, and what follows for gyroscopes, sleeping tops and pendulums on the rotating Earth.

N are inertial axes that coincide with the laboratory's (East, North, Up) at t = 0, B are the body's; gravity acts along -Up.
Of a symmetric top, body axis 3 is the axis of symmetry and carries the centre of mass. Its parameters are ``I1`` and ``I3``,
the moments about the pivot across and along that axis (kg m^2), and ``mgl``, mass times apparent gravity times the signed
distance of the centre of mass from the pivot (N m). Quaternions are (w, x, y, z); those that are given may have any norm but
zero.

Arguments are numbers, lists or arrays. Of functions they are broadcast against one another, as NumPy does; a vector or a
quaternion is the last axis. Results have the shape of the elements, and one more axis if they are vectors.

``precision`` is ``"double"``, ``"long_double"`` or ``"float128"``. In the last two, arguments may also be decimal text, or
numbers of mpmath, decimal or fractions; each is rounded once, from its exact value to the nearest number of that precision
(so that ``0.1`` is the double 0.1, and ``"0.1"`` is not). Results are then arrays of ``mpmath.mpf`` with all their bits.

Whatever is not finite or out of range is refused by a ScenarioError.
"""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._errors import refuse
from ._extended import BITS, fraction_of, is_real, packed, rounded, text_of, unpacked

__all__ = [
    "EARTH_RATE_RAD_S",
    "FirstOrder",
    "FreeBody",
    "LaboratoryState",
    "LagrangeTop",
    "PrecessionRates",
    "State",
    "balanced_gyroscope_axis_L",
    "balanced_gyroscope_drift",
    "critical_spin",
    "earth_rate_L",
    "foucault_rate",
    "homoclinic_top",
    "resting_axis_L",
    "seen_from_laboratory",
    "separatrix_free_body",
    "sleeping_top_lean_south",
    "steady_precession",
    "steady_precession_rates",
    "upright_growth_rate",
]

EARTH_RATE_RAD_S: float = _core.earth_rate_rad_s  #: nominal rate of the Earth, WGS 84 [NIMA TR8350.2]

Numbers = Any  #: a number, a list of numbers or an array


class State(NamedTuple):
    """A motion in inertial axes, at every time that was asked for."""

    q_NB: np.ndarray  #: attitude, of unit norm and either sign; shape (..., 4)
    w_NB_B: np.ndarray  #: rate in body axes (rad/s); shape (..., 3)
    attitude_error_rad: np.ndarray  #: bound on the angle between q_NB and the exact motion; shape (...)
    rate_error_rad_s: np.ndarray  #: bound on the error of w_NB_B; shape (...)


class LaboratoryState(NamedTuple):
    """A motion as seen from the laboratory, which rotates with the Earth."""

    q_LB: np.ndarray  #: attitude, of unit norm and either sign; shape (..., 4)
    w_LB_B: np.ndarray  #: rate relative to the laboratory, in body axes (rad/s); shape (..., 3)
    attitude_error_rad: np.ndarray  #: bound on the error of q_LB; shape (...)
    rate_error_rad_s: np.ndarray  #: bound on the error of w_LB_B; shape (...)


class PrecessionRates(NamedTuple):
    """The two rates at which a symmetric top precesses at a constant tilt (rad/s, counterclockwise about Up)."""

    slow: np.ndarray  #: NaN where the spin is too slow for the tilt
    fast: np.ndarray  #: likewise; infinite at a tilt of exactly 90 deg


class FirstOrder(NamedTuple):
    """A first-order value with a bound on what it leaves out."""

    value: np.ndarray
    left_out: np.ndarray  #: bound on the sum of the neglected terms of higher order


# Arguments ------------------------------------------------------------------------------------------------------------


def _given(name: str, value: Numbers, precision: str, components: int = 1) -> np.ndarray:
    """An argument as an array of floats, or of numbers of mpmath; a vector is its last axis."""
    if precision not in list(BITS):
        raise refuse(f"precision must be one of {', '.join(map(repr, BITS))}, not {precision!r}")
    numbers = _doubles(name, value) if precision == "double" else _extended(name, value, precision)
    if components > 1 and numbers.shape[-1:] != (components,):
        raise refuse(f"{name} must have {components} components along its last axis; its shape is {numbers.shape}")
    return numbers


def _doubles(name: str, value: Numbers) -> np.ndarray:
    try:
        array = np.asarray(value)
    except ValueError:  # lists of different lengths
        raise refuse(f"{name} must be a number, a list of numbers or an array of one shape") from None
    if array.dtype.kind not in "iufOU":
        raise refuse(f"{name} must be a number, a list of numbers or an array, not of type {array.dtype}")
    if array.dtype.kind in "OU" or array.dtype.itemsize > 8:
        for number in array.flat:
            _require_real(name, number)
        raise refuse(f"{name} must be made of floats or integers that fit into a double; for text and for numbers with more "
                     "digits there are precision='long_double' and precision='float128'")
    numbers = np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)
    if not np.isfinite(numbers).all():
        raise refuse(f"{name} must be finite; it contains {numbers[~np.isfinite(numbers)].flat[0]}")
    return numbers


def _extended(name: str, value: Numbers, precision: str) -> np.ndarray:
    try:
        array = np.asarray(value, dtype=object)
    except ValueError:
        raise refuse(f"{name} must be a number, a list of numbers or an array of one shape") from None
    numbers = np.empty(array.shape, dtype=object)
    for index, number in np.ndenumerate(array):
        _require_real(name, number)
        try:
            numbers[index] = rounded(number, precision)
        except ValueError:
            raise refuse(f"{name} must be finite, and 0 or between 3.4e-4932 and 1.1e4932 in size; it contains "
                         f"{str(number)!r}") from None
    return numbers


def _require_real(name: str, number: Any) -> None:
    if not is_real(number):
        raise refuse(f"{name} must be a real number, or a list or an array of one shape of them; it contains {number!r}")


def _require(name: str, numbers: np.ndarray, holds: Any, what: str) -> None:
    """Refuses an argument unless the condition holds for every element."""
    good = np.asarray(holds, dtype=bool)
    if not good.all():
        culprit = np.asarray(numbers)[~good].flat[0] if good.shape == np.shape(numbers) else numbers
        raise refuse(f"{name} must be {what}, not {_short(culprit)}")


def _short(number: Any) -> str:
    if isinstance(number, np.ndarray):
        return "[" + ", ".join(map(_short, number)) + "]" if number.ndim else _short(number[()])
    return str(number) if hasattr(number, "_mpf_") else f"{float(number):.6g}"


def _top(precision: str, I1: Numbers, I3: Numbers, mgl: Numbers, point_bob: bool = False) -> List[np.ndarray]:
    given = [_given(name, value, precision) for name, value in (("I1", I1), ("I3", I3), ("mgl", mgl))]
    _require("I1", given[0], given[0] > 0, "positive (kg m^2)")
    if point_bob:
        _require("I3", given[1], given[1] >= 0, "0 or positive (kg m^2)")
    else:
        _require("I3", given[1], given[1] > 0, "positive (kg m^2)")
    return given


def _quaternion(name: str, value: Numbers, precision: str) -> np.ndarray:
    q = _given(name, value, precision, 4)
    _require(name, q, (q != 0).any(axis=-1), "a quaternion (w, x, y, z) of any norm but zero")
    return q


# Evaluation -----------------------------------------------------------------------------------------------------------


def _passed(numbers: np.ndarray) -> np.ndarray:
    """Numbers as the extension takes them."""
    return packed(numbers) if numbers.dtype == object else numbers


def _returned(array: np.ndarray) -> Any:
    """Numbers from the extension as the user gets them: scalars for a single element, as NumPy's functions do."""
    numbers = array if array.dtype == np.float64 else unpacked(array)
    return numbers if numbers.ndim else numbers[()]


def _evaluated(function: str, precision: str, arguments: Sequence[Tuple[np.ndarray, int]]) -> Tuple[Any, ...]:
    """A function of the extension for every element of its arguments, each with its number of components."""
    shapes = [numbers.shape if width == 1 else numbers.shape[:-1] for numbers, width in arguments]
    try:
        shape = np.broadcast_shapes(*shapes)
    except ValueError:
        raise refuse(f"the arguments' shapes cannot be broadcast together: {', '.join(map(str, shapes))}") from None
    arrays = []
    for numbers, width in arguments:
        array = _passed(numbers)
        if array.size != width:
            array = np.ascontiguousarray(np.broadcast_to(array, shape if width == 1 else shape + (width,)))
        arrays.append(array)
    return tuple(map(_returned, _core.special_case(function, precision, arrays, shape)))


class _Motion:
    """A motion from given parameters and a given start."""

    _form: Any  # the extension's object

    def __init__(self, precision: str, parameters: Dict[str, np.ndarray]) -> None:
        self._precision = precision
        self._parameters = parameters
        numbers = [_passed(value).reshape(-1) for value in parameters.values()]
        self._form = getattr(_core, type(self).__name__)(precision, np.concatenate(numbers))
        for value in parameters.values():
            value.setflags(write=False)
        if not all(number == number for number in np.hstack([np.ravel(part) for part in self.at(0)])):
            raise refuse("the parameters are too different in size for the motion to be computed")

    def at(self, t: Numbers) -> State:
        """The motion at any times before or after the start.

        Parameters
        ----------
        t : number, list or array
            times (s), of any shape

        Returns
        -------
        State
            ``q_NB`` of shape t.shape + (4,), ``w_NB_B`` (rad/s) of shape t.shape + (3,), and the bounds of their errors,
            ``attitude_error_rad`` and ``rate_error_rad_s``, of shape t.shape. The bounds hold for the start exactly as
            given; where t is so large that turns can no longer be counted they are pi or NaN.
        """
        numbers = _given("t", t, self._precision)
        return State(*map(_returned, self._form.at(_passed(numbers), numbers.shape)))

    @property
    def precision(self) -> str:
        return self._precision

    def __getstate__(self) -> Dict[str, Any]:
        return {"precision": self._precision, **self._parameters}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__init__(**state)  # type: ignore[misc]

    def __repr__(self) -> str:
        def text(numbers: np.ndarray) -> str:
            if numbers.dtype == object:
                return repr(np.vectorize(lambda x: text_of(x, self._precision), otypes=[object])(numbers).tolist())
            return repr(numbers.tolist())

        given = [f"{name}={text(value)}" for name, value in self._parameters.items()]
        if self._precision != "double":
            given.append(f"precision={self._precision!r}")
        return f"{type(self).__name__}({', '.join(given)})"


class LagrangeTop(_Motion):
    """The heavy symmetric top on a fixed pivot, without the Earth's rotation (Lagrange's case), by theta functions.

    Parameters
    ----------
    I1, I3 : number
        moments about the pivot across and along the axis of symmetry, body axis 3 (kg m^2)
    mgl : number
        mass x apparent gravity x signed distance of the centre of mass from the pivot (N m); negative: a hanging top
    q0 : array of shape (4,)
        attitude q_NB at t = 0, of any norm but zero
    w0 : array of shape (3,)
        rate w_NB_B at t = 0, in body axes (rad/s)
    precision : {"double", "long_double", "float128"}

    Notes
    -----
    The formulas contain no Euler angles and are regular everywhere, also at the vertical. [F. Klein and A. Sommerfeld,
    Theory of the Top, vol. II; E. T. Whittaker, Analytical Dynamics, chapter VI]
    """

    def __init__(self, *, I1: Numbers, I3: Numbers, mgl: Numbers, q0: Numbers, w0: Numbers,
                 precision: str = "double") -> None:
        body = dict(zip(("I1", "I3", "mgl"), _top(precision, I1, I3, mgl)))
        super().__init__(precision, {**_single(body), **_start(q0, w0, precision)})

    @property
    def regime(self) -> str:
        """The kind of motion of the axis, for reports; no number depends on it.

        ``"at_rest"``, ``"free"`` (no torque), ``"sleeping"`` (upright), ``"homoclinic"`` (tends to the upright position),
        ``"steady"`` (constant tilt), ``"wavy"``, ``"cusped"`` or ``"looping"`` (nutates, by the path of the axis),
        ``"plane_swinging"`` or ``"plane_turning"`` (a pendulum).
        """
        return str(self._form.regime)

    @property
    def nutation_period_s(self) -> Any:
        """The period of the tilt (s); infinite if there is none."""
        return self._figure(0)

    @property
    def parameter(self) -> Any:
        """Squared modulus k^2 of the elliptic functions."""
        return self._figure(1)

    @property
    def complementary_parameter(self) -> Any:
        """1 - k^2, to full relative accuracy."""
        return self._figure(2)

    def _figure(self, place: int) -> Any:
        value = _returned(self._form.figures)[place]
        return float(value) if self._precision == "double" else value


class FreeBody(_Motion):
    """A rigid body without torque about its pivot (Euler's case), including its attitude, by theta functions.

    Parameters
    ----------
    moments : array of shape (3,), optional
        moments about the pivot along the body axes, which must be principal axes (kg m^2)
    inertia : array of shape (3, 3), optional
        inertia tensor about the pivot in any body axes (kg m^2), instead of ``moments``; it must be symmetric to 1e-12 of its
        largest element, and what is above the diagonal is not used
    q0 : array of shape (4,)
        attitude q_NB at t = 0, of any norm but zero
    w0 : array of shape (3,)
        rate w_NB_B at t = 0, in body axes (rad/s)
    precision : {"double", "long_double", "float128"}

    Notes
    -----
    Moments need not obey the triangle inequality. [L. D. Landau and E. M. Lifshitz, Mechanics, section 37; R. van Zon and
    J. Schofield, J. Comput. Phys. 225 (2007) 145]
    """

    def __init__(self, *, moments: Optional[Numbers] = None, inertia: Optional[Numbers] = None, q0: Numbers, w0: Numbers,
                 precision: str = "double") -> None:
        if (moments is None) == (inertia is None):
            raise refuse("give either moments or inertia")
        if moments is not None:
            body = {"moments": _of_shape("moments", _given("moments", moments, precision, 3), (3,))}
            _require("moments", body["moments"], body["moments"] > 0, "positive (kg m^2)")
        else:
            tensor = _of_shape("inertia", _given("inertia", inertia, precision), (3, 3))
            _require("inertia", tensor, abs(tensor - tensor.T).max() <= 1e-12 * abs(tensor).max(), "symmetric")
            _require("inertia", tensor, _is_positive_definite(tensor), "positive definite (kg m^2)")
            body = {"inertia": tensor}
        super().__init__(precision, {**body, **_start(q0, w0, precision)})

    @property
    def regime(self) -> str:
        """The kind of motion.

        ``"at_rest"``, ``"spherical"`` (equal moments), ``"principal_axis"`` (uniform rotation about one), ``"symmetric"`` (two
        equal moments), ``"around_smallest"`` or ``"around_largest"`` (the axis which the rate circles), ``"separatrix"``.
        """
        return str(self._form.regime)


def _of_shape(name: str, numbers: np.ndarray, shape: Tuple[int, ...]) -> np.ndarray:
    """A parameter of a motion, as an array of its own."""
    if numbers.shape != shape:
        wanted = f"an array of shape {shape}" if shape else "one number"
        raise refuse(f"{name} must be {wanted}; its shape is {numbers.shape}")
    return numbers.copy()


def _is_positive_definite(tensor: np.ndarray) -> bool:
    """By the signs of the leading minors, which are computed exactly, from the lower triangle."""
    (a, _, _), (d, b, _), (e, f, c) = ([fraction_of(number) for number in row] for row in tensor)
    return bool(a > 0 and a * b > d * d and a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e) > 0)


def _single(parameters: Dict[str, np.ndarray]) -> Dict[str, np.ndarray]:
    return {name: _of_shape(name, value, ()) for name, value in parameters.items()}


def _start(q0: Numbers, w0: Numbers, precision: str) -> Dict[str, np.ndarray]:
    return {"q0": _of_shape("q0", _quaternion("q0", q0, precision), (4,)),
            "w0": _of_shape("w0", _given("w0", w0, precision, 3), (3,))}


# Steady precession ----------------------------------------------------------------------------------------------------


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

    Returns
    -------
    PrecessionRates
        ``slow`` and ``fast`` (rad/s, counterclockwise about Up), of the arguments' common shape; NaN where the spin is too
        slow for the tilt; ``fast`` is infinite at a tilt of exactly 90 deg
    """
    top = _top(precision, I1, I3, mgl)
    spin, cosine = _given("w3", w3, precision), _given("cos_tilt", cos_tilt, precision)
    _require("cos_tilt", cosine, abs(cosine) <= 1, "from -1 to 1")
    return PrecessionRates(*_evaluated("steady_precession_rates", precision, [(one, 1) for one in (*top, spin, cosine)]))


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

    Returns
    -------
    State
        of the arguments' common shape
    """
    return State(*_evaluated("steady_precession", precision, [
        (_quaternion("q0", q0, precision), 4), (_given("precession_rate", precession_rate, precision), 1),
        (_given("w3", w3, precision), 1), (_given("t", t, precision), 1)]))


# Separatrices ---------------------------------------------------------------------------------------------------------


def critical_spin(*, I1: Numbers, I3: Numbers, mgl: Numbers, precision: str = "double") -> Any:
    """The spin above which the upright top is stable: 2 sqrt(I1 mgl) / I3 (rad/s).

    [T. W. B. Kibble and F. H. Berkshire, Classical Mechanics, eq. 12.26]

    Parameters
    ----------
    I1, I3 : array_like
        moments about the pivot across and along the axis (kg m^2)
    mgl : array_like
        mass x apparent gravity x distance of the centre of mass from the pivot (N m), not negative

    Returns
    -------
    array
        (rad/s), of the arguments' common shape
    """
    top = _top(precision, I1, I3, mgl)
    _require("mgl", top[2], top[2] >= 0, "0 or positive (N m): a hanging top has no critical spin")
    return _evaluated("critical_spin", precision, [(one, 1) for one in top])[0]


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

    Returns
    -------
    array
        (1/s), of the arguments' common shape; 0 from the critical spin on
    """
    top = _top(precision, I1, I3, mgl)
    _require("mgl", top[2], top[2] > 0, "positive (N m)")
    return _evaluated("upright_growth_rate", precision, [(one, 1) for one in (*top, _given("w3", w3, precision))])[0]


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

    Returns
    -------
    State
        of the arguments' common shape
    """
    top, spin = _top(precision, I1, I3, mgl), _given("w3", w3, precision)
    _require("mgl", top[2], top[2] > 0, "positive (N m)")
    state = State(*_evaluated("homoclinic_top", precision,
                              [(one, 1) for one in (*top, spin, _given("t", t, precision))]))
    _require("w3", spin, state.q_NB == state.q_NB, "no faster than the critical spin (rad/s)")
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

    Returns
    -------
    State
        of the arguments' common shape
    """
    I, rate = _given("moments", moments, precision, 3), _given("w2", w2, precision)
    _require("moments", I, (0 < I[..., 0]) & (I[..., 0] < I[..., 1]) & (I[..., 1] < I[..., 2]),
             "positive and in ascending order (kg m^2)")
    _require("w2", rate, rate > 0, "positive (rad/s)")
    return State(*_evaluated("separatrix_free_body", precision, [(I, 3), (rate, 1), (_given("t", t, precision), 1)]))


# On the turning Earth -------------------------------------------------------------------------------------------------


def earth_rate_L(latitude_deg: Numbers, rotation_rate: Numbers = EARTH_RATE_RAD_S, *, precision: str = "double") -> Any:
    """The Earth's rate in laboratory axes: rotation_rate (0, cos(latitude), sin(latitude)).

    Parameters
    ----------
    latitude_deg : array_like
        geodetic latitude (deg), -90 to 90
    rotation_rate : array_like, optional
        (rad/s); default: WGS 84

    Returns
    -------
    array, shape (..., 3)
        W_IL_L: East, North, Up (rad/s); exact at the poles and the equator
    """
    latitude = _given("latitude_deg", latitude_deg, precision)
    _require("latitude_deg", latitude, abs(latitude) <= 90, "from -90 to 90 (deg)")
    return _evaluated("earth_rate_L", precision, [(latitude, 1), (_given("rotation_rate", rotation_rate, precision), 1)])[0]


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

    Returns
    -------
    LaboratoryState
        of the arguments' common shape
    """
    try:
        q_NB, w_NB_B, attitude_error, rate_error = state
    except (TypeError, ValueError):
        raise refuse("state must be what `at` or a closed form of this module returns") from None
    return LaboratoryState(*_evaluated("seen_from_laboratory", precision, [
        (_quaternion("state.q_NB", q_NB, precision), 4), (_given("state.w_NB_B", w_NB_B, precision, 3), 3),
        (_given("state.attitude_error_rad", attitude_error, precision), 1),
        (_given("state.rate_error_rad_s", rate_error, precision), 1), (_given("W_IL_L", W_IL_L, precision, 3), 3),
        (_given("t", t, precision), 1)]))


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

    Returns
    -------
    array, shape (..., 3)
        the axis in laboratory axes, as long as ``axis_L``
    """
    return _evaluated("balanced_gyroscope_axis_L", precision, [
        (_given("axis_L", axis_L, precision, 3), 3), (_given("W_IL_L", W_IL_L, precision, 3), 3),
        (_given("t", t, precision), 1)])[0]


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

    Returns
    -------
    array
        (rad), 0 to pi, of the arguments' common shape
    """
    sine = _given("axis_sine", axis_sine, precision)
    _require("axis_sine", sine, (0 <= sine) & (sine <= 1), "from 0 to 1")
    return _evaluated("balanced_gyroscope_drift", precision, [
        (sine, 1), (_given("earth_rate", earth_rate, precision), 1), (_given("t", t, precision), 1)])[0]


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

    Returns
    -------
    FirstOrder
        (rad), of the arguments' common shape; the terms left out are of second order in the Earth's rate
    """
    return FirstOrder(*_evaluated("sleeping_top_lean_south", precision, _leaning(precision, I1, I3, mgl, w3, W_IL_L)))


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

    Returns
    -------
    array, shape (..., 3)
        unit vector in laboratory axes (East, North, Up)
    """
    arguments = _leaning(precision, I1, I3, mgl, w3, W_IL_L)
    (inertia, _), _, (torque, _), _, (W, _) = arguments
    strength = inertia * (W * W).sum(axis=-1)
    _require("mgl", torque, 2 * strength <= abs(torque), "at least 2 I1 W^2 in size (N m)")
    return _evaluated("resting_axis_L", precision, arguments)[0]


def _leaning(precision: str, I1: Numbers, I3: Numbers, mgl: Numbers, w3: Numbers,
             W_IL_L: Numbers) -> List[Tuple[np.ndarray, int]]:
    top = _top(precision, I1, I3, mgl)
    _require("mgl", top[2], top[2] != 0, "other than 0 (N m)")
    return [*((one, 1) for one in (*top, _given("w3", w3, precision))), (_given("W_IL_L", W_IL_L, precision, 3), 3)]


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

    Returns
    -------
    FirstOrder
        (rad/s, counterclockwise about Up), of the arguments' common shape
    """
    top, swing = _top(precision, I1, I3, mgl, point_bob=True), _given("amplitude", amplitude, precision)
    _require("mgl", top[2], top[2] < 0, "negative (N m): a pendulum hangs")
    _require("amplitude", swing, (0 < swing) & (swing <= 0.5), "above 0 and at most 0.5 (rad)")
    return FirstOrder(*_evaluated("foucault_rate", precision, [
        *((one, 1) for one in (*top, swing)), (_given("W_IL_L", W_IL_L, precision, 3), 3)]))
