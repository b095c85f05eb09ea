# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole motions that have closed forms: the heavy symmetric top and the free rigid body."""

from __future__ import annotations

from typing import Any, Dict, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._argument_arrays import Numbers, given, passed, quaternion, require, returned, top_parameters
from ._errors import refuse
from ._extended import fraction_of, text_of


class State(NamedTuple):
    """A motion in inertial axes, at every time that was asked for."""

    q_NB: np.ndarray  #: attitude, of unit norm and either sign; shape (..., 4)
    w_NB_B_rad_s: np.ndarray  #: rate in body axes (rad/s); shape (..., 3)
    attitude_error_rad: np.ndarray  #: bound on the angle between q_NB and the exact motion; shape (...)
    rate_error_rad_s: np.ndarray  #: bound on the error of w_NB_B_rad_s; shape (...)


class _Motion:
    """A motion from given parameters and a given start."""

    _make: Any  # the extension's class

    def __init__(self, precision: str, parameters: Dict[str, np.ndarray]) -> None:
        self._precision = precision
        self._parameters = parameters
        numbers = [passed(value).reshape(-1) for value in parameters.values()]
        self._form = self._make(precision, np.concatenate(numbers))
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
            ``q_NB`` of shape t.shape + (4,), ``w_NB_B_rad_s`` of shape t.shape + (3,), and the bounds of their errors,
            ``attitude_error_rad`` and ``rate_error_rad_s``, of shape t.shape. The bounds hold for the start exactly as
            given; where t is so large that turns can no longer be counted they are pi or NaN.
        """
        numbers = given("t", t, self._precision)
        return State(*map(returned, self._form.at(passed(numbers), numbers.shape)))

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

        parts = [f"{name}={text(value)}" for name, value in self._parameters.items()]
        if self._precision != "double":
            parts.append(f"precision={self._precision!r}")
        return f"{type(self).__name__}({', '.join(parts)})"


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

    _make = _core.LagrangeTop

    def __init__(self, *, I1: Numbers, I3: Numbers, mgl: Numbers, q0: Numbers, w0: Numbers,
                 precision: str = "double") -> None:
        body = dict(zip(("I1", "I3", "mgl"), top_parameters(precision, I1, I3, mgl)))
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
        value = returned(self._form.figures)[place]
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

    _make = _core.FreeBody

    def __init__(self, *, moments: Optional[Numbers] = None, inertia: Optional[Numbers] = None, q0: Numbers, w0: Numbers,
                 precision: str = "double") -> None:
        if (moments is None) == (inertia is None):
            raise refuse("give either moments or inertia")
        if moments is not None:
            body = {"moments": _of_shape("moments", given("moments", moments, precision, 3), (3,))}
            require("moments", body["moments"], body["moments"] > 0, "positive (kg m^2)")
        else:
            tensor = _of_shape("inertia", given("inertia", inertia, precision), (3, 3))
            require("inertia", tensor, abs(tensor - tensor.T).max() <= 1e-12 * abs(tensor).max(), "symmetric")
            require("inertia", tensor, _is_positive_definite(tensor), "positive definite (kg m^2)")
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
    return {"q0": _of_shape("q0", quaternion("q0", q0, precision), (4,)),
            "w0": _of_shape("w0", given("w0", w0, precision, 3), (3,))}
