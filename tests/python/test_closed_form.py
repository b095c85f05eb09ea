# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms: against the equations of motion, runs and elementary facts."""

import math
import operator
from fractions import Fraction

import numpy as np
import pytest

import earthtop as et
from earthtop import _extended
from earthtop.closed_form import (EARTH_RATE_RAD_S, FreeBody, LagrangeTop, balanced_gyroscope_axis_L,
                                  balanced_gyroscope_drift, critical_spin, earth_rate_L, foucault_rate, homoclinic_top,
                                  mean_rates, resting_axis_L, seen_from_laboratory, separatrix_free_body,
                                  sleeping_top_lean_south, steady_precession, steady_precession_rates, upright_growth_rate)

EPS = np.finfo(float).eps
# All parameters and times are sums of few powers of two, so that they are exact in every precision.
TOP = {"I1": 0.5, "I3": 0.75, "mgl": 2.0, "q0": [1, 0.25, 0.125, 0.5], "w0": [0.5, -0.25, 3.0]}
HANGING = {"I1": 1.0, "I3": 0.25, "mgl": -4.0, "q0": [0.5, 1, 0, 0.25], "w0": [1.0, 0.5, -2.0]}
BODY = {"moments": [1.0, 2.0, 3.5], "q0": [1, -0.5, 0.25, 0], "w0": [0.25, 1.5, -0.5]}


def matrix(q):
    """Rotation matrices of quaternions, of shape (..., 3, 3)."""
    w, x, y, z = np.moveaxis(np.asarray(q, dtype=float), -1, 0) / np.linalg.norm(q, axis=-1)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def angle(p, q):
    """Angles between attitudes (rad), also where they are tiny."""
    p, q = p / np.linalg.norm(p, axis=-1, keepdims=True), q / np.linalg.norm(q, axis=-1, keepdims=True)
    same = np.where(np.sum(p * q, axis=-1, keepdims=True) < 0, -q, q)
    return 4 * np.arcsin(np.minimum(np.linalg.norm(p - same, axis=-1) / 2, 1))


# Against the equations of motion ---------------------------------------------------------------------------------------

SHIFT = 170  #: fixed-point numbers are integers times 2^-SHIFT


def fixed(number):
    return int(Fraction(number) * 2**SHIFT)


def integrated(moments, mgl, q0, w0, t, steps, order=45):
    """Attitude and rate at t, as fractions, by Taylor steps of Euler's equations and of dq/dt = q w / 2, in fixed point."""
    A, B, C = map(Fraction, moments)
    inertia = [fixed((B - C) / A), fixed((C - A) / B), fixed((A - B) / C)]
    torque = [fixed(2 * Fraction(mgl) / A), fixed(-2 * Fraction(mgl) / B)]
    size = fixed(math.sqrt(sum(Fraction(x) ** 2 for x in q0)))
    for _ in range(3):  # Newton's iteration for the square root
        size = (size + fixed(sum(Fraction(x) ** 2 for x in q0)) * 2**SHIFT // size) // 2
    state = [fixed(x) * 2**SHIFT // size for x in q0] + [fixed(x) for x in w0]
    h = fixed(Fraction(t) / steps)

    for _ in range(steps):
        q, w = [[x] for x in state[:4]], [[x] for x in state[4:]]

        def product(a, b):
            return sum(map(operator.mul, a, reversed(b))) >> SHIFT

        for k in range(order):
            e0, e1, e2, e3 = q
            rates = [-product(e1, w[0]) - product(e2, w[1]) - product(e3, w[2]),
                     product(e0, w[0]) + product(e2, w[2]) - product(e3, w[1]),
                     product(e0, w[1]) + product(e3, w[0]) - product(e1, w[2]),
                     product(e0, w[2]) + product(e1, w[1]) - product(e2, w[0])]
            up = [product(e1, e3) - product(e0, e2), product(e2, e3) + product(e0, e1)]  # halves of Up's components in B
            spins = [inertia[0] * product(w[1], w[2]) + torque[0] * up[1], inertia[1] * product(w[2], w[0]) + torque[1] * up[0],
                     inertia[2] * product(w[0], w[1])]
            for series, rate in zip(q, rates):
                series.append(rate // (2 * (k + 1)))
            for series, rate in zip(w, spins):
                series.append((rate >> SHIFT) // (k + 1))

        def summed(series):
            total = 0
            for coefficient in reversed(series):
                total = (total * h >> SHIFT) + coefficient
            return total

        state = [summed(series) for series in q + w]
    return [Fraction(x, 2**SHIFT) for x in state]


def fractions(numbers):
    return [_extended.fraction_of(x if hasattr(x, "_mpf_") else float(x)) for x in numbers]


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))


@pytest.mark.parametrize("motion, moments, mgl, given", [
    (LagrangeTop, (0.5, 0.5, 0.75), 2.0, TOP), (LagrangeTop, (1.0, 1.0, 0.25), -4.0, HANGING),
    (FreeBody, (1.0, 2.0, 3.5), 0.0, BODY)])
@pytest.mark.parametrize("t", [1.375, -0.75])
def test_solves_the_equations_of_motion_in_every_precision(motion, moments, mgl, given, t):
    pytest.importorskip("mpmath")
    truth = integrated(moments, mgl, given["q0"], given["w0"], t, steps=32)
    for precision, expected in (("double", 1e-13), ("long_double", 1e-16), ("float128", 1e-28)):
        state = motion(**given, precision=precision).at(t)
        q, w = fractions(state.q_NB), fractions(state.w_NB_B_rad_s)
        sign = 1 if q[0] * truth[0] > 0 else -1
        # The angle between attitudes is twice the distance of the quaternions.
        assert 2 * distance([sign * x for x in q], truth[:4]) <= state.attitude_error_rad <= expected, precision
        assert distance(w, truth[4:]) <= state.rate_error_rad_s <= 30 * expected, precision
        if precision != "double":  # a result of fewer digits would be multiples of a larger power of two
            bits = max(x.denominator.bit_length() for x in q)
            assert bits > {"long_double": 60, "float128": 105}[precision]


def test_double_is_within_its_stated_error_of_float128():
    pytest.importorskip("mpmath")
    t = np.arange(-40, 41) * 2.6875
    for motion, given in ((LagrangeTop, TOP), (LagrangeTop, HANGING), (FreeBody, BODY)):
        fine, coarse = motion(**given, precision="float128").at(t), motion(**given).at(t)
        sign = np.where(np.sum(fine.q_NB * coarse.q_NB, axis=-1) > 0, 1, -1)[:, None]
        error = 2 * np.sqrt(np.sum((sign * fine.q_NB - coarse.q_NB).astype(float) ** 2, axis=-1))
        assert (error <= coarse.attitude_error_rad).all() and coarse.attitude_error_rad.max() < 1e-11
        assert error.max() > 0
        error = np.sqrt(np.sum((fine.w_NB_B_rad_s - coarse.w_NB_B_rad_s).astype(float) ** 2, axis=-1))
        assert (error <= coarse.rate_error_rad_s).all()
        assert abs(np.linalg.norm(coarse.q_NB, axis=-1) - 1).max() < 4 * EPS


def test_tensor_turned_out_of_its_principal_axes():
    q = np.array([0.5, 0.5, -0.5, 0.5])  # exchanges the axes: R_BP is a permutation
    R = matrix(q)
    turned = FreeBody(inertia=R @ np.diag(BODY["moments"]) @ R.T, q0=[1, 0, 0, 0], w0=R @ BODY["w0"])
    straight = FreeBody(moments=BODY["moments"], q0=q, w0=BODY["w0"])
    t = np.linspace(0, 10, 21)
    assert np.allclose(turned.at(t).w_NB_B_rad_s, straight.at(t).w_NB_B_rad_s @ R.T, rtol=0, atol=1e-13)
    assert np.allclose(matrix(turned.at(t).q_NB) @ R, matrix(straight.at(t).q_NB), rtol=0, atol=1e-13)


def test_products_of_inertia_count():
    body = FreeBody(inertia=[[2.0, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1.0]], q0=[1, 0, 0, 0], w0=[1, 2, 3])
    I = np.array([[2.0, 0.5, 0], [0.5, 1.5, 0.25], [0, 0.25, 1.0]])
    state = body.at(np.linspace(0, 20, 41))
    L_N = np.einsum("tij,jk,tk->ti", matrix(state.q_NB), I, state.w_NB_B_rad_s)
    assert abs(L_N - L_N[0]).max() < 1e-12 and abs(L_N[0] - I @ [1, 2, 3]).max() < 1e-12
    assert np.ptp(state.w_NB_B_rad_s, axis=0).min() > 0.1


# Against runs ---------------------------------------------------------------------------------------------------------


def test_toy_top_without_the_earth():
    r = et.run(et.example("toy-top"), {"numerics/method": "taylor"}, duration_s=5)  # integrated, not the closed form
    top = LagrangeTop(I1=1.2e-4, I3=4e-5, mgl=0.1 * 9.80665 * 0.03, q0=r.ref_q_LB[0], w0=r.ref_w_LB_B_rad_s[0])
    state = top.at(r.t_s)
    assert len(r.t_s) == 51 and angle(r.ref_q_LB[-1], r.q_LB[-1]) > 1e-6
    assert angle(state.q_NB, r.ref_q_LB).max() < 1e-10
    assert abs(state.w_NB_B_rad_s - r.ref_w_LB_B_rad_s).max() < 1e-9


def test_free_body_on_the_rotating_earth():
    top = et.example("free-gyro").changed({"release": {"tilt_deg": 70, "rates_relative_to": "inertial",
                                                       "angular_velocity_body_rad_s": [5, 20, 30]},
                                           "body/inertia/principal_kg_m2": [3e-4, 4e-4, 5e-4], "numerics/method": "taylor",
                                           "earth/rotation_rate_rad_s": 0.25}, latitude_deg=30, duration_s=5)
    r = et.run(top)
    W = earth_rate_L(30, 0.25)
    body = FreeBody(moments=[3e-4, 4e-4, 5e-4], q0=r.q_LB[0], w0=[5, 20, 30])
    seen = seen_from_laboratory(body.at(r.t_s), r.t_s, W_IL_L=W)
    assert angle(seen.q_LB, r.q_LB).max() < 1e-10 < 1 < angle(body.at(r.t_s).q_NB, r.q_LB).max()
    assert abs(seen.w_LB_B_rad_s - r.w_LB_B_rad_s).max() < 1e-9
    assert (seen.attitude_error_rad > body.at(r.t_s).attitude_error_rad).all()


# Special cases against elementary facts -------------------------------------------------------------------------------

PLAIN = {"I1": 0.5, "I3": 0.8, "mgl": 2.0}


def test_steady_precession():
    w3, cosine = 7.0, math.cos(0.6)
    rates = steady_precession_rates(**PLAIN, w3=w3, cos_tilt=cosine)
    for x in rates:
        assert abs(0.5 * cosine * x * x - 0.8 * w3 * x + 2.0) < 1e-13
    assert 0 < rates.slow < rates.fast
    q0, t = [math.cos(0.3), math.sin(0.3), 0, 0], np.linspace(-2, 5, 15)
    for x in rates:
        steady = steady_precession(t, q0=q0, precession_rate=x, w3=w3)
        top = LagrangeTop(**PLAIN, q0=q0, w0=[0, x * math.sin(0.6), w3])
        assert top.regime == "steady"
        assert angle(steady.q_NB, top.at(t).q_NB).max() < 1e-12
        assert np.allclose(steady.rate_error_rad_s, x * steady.attitude_error_rad, rtol=1e-14, atol=0)
        assert abs(steady.w_NB_B_rad_s - top.at(t).w_NB_B_rad_s).max() < 1e-12
        axis = matrix(steady.q_NB)[..., 2]
        assert np.allclose(axis[..., 2], cosine) and np.allclose(axis[:, 0] + 1j * axis[:, 1],
                                                                 -1j * math.sin(0.6) * np.exp(1j * x * t))

    many = steady_precession_rates(**PLAIN, w3=[[1.0], [5.0]], cos_tilt=[1, 0.5, 0])
    assert many.slow.shape == (2, 3) and np.isnan(many.slow[0, :2]).all() and np.isnan(many.fast[0, :2]).all()
    assert many.slow[1, 2] == 0.5 and many.fast[1, 2] == np.inf


def test_mean_rates_are_those_of_the_motion():
    w0 = np.array([[0, 0, 10.0], [1.0, -2.0, 10.0]])
    rates = mean_rates(**PLAIN, q0=[1, 0.5, 0, 0.25], w0=w0)
    assert rates.precession_rad_s.shape == rates.nutation_rad_s.shape == (2,)
    for i in range(2):
        top = LagrangeTop(**PLAIN, q0=[1, 0.5, 0, 0.25], w0=w0[i])
        assert math.isclose(rates.nutation_rad_s[i] * top.nutation_period_s, 2 * math.pi, rel_tol=1e-12)
        axis = matrix(top.at(np.linspace(0, 10 * top.nutation_period_s, 2001)).q_NB)[..., 2]
        azimuth = np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))
        assert math.isclose(rates.precession_rad_s[i], (azimuth[-1] - azimuth[0]) / (10 * top.nutation_period_s), rel_tol=1e-11)
    assert np.isnan(mean_rates(**PLAIN, q0=[1, 0, 0, 0], w0=[0, 0, 2])).all()  # it takes for ever to fall


def test_upright_top_and_its_separatrix():
    w_c = critical_spin(**PLAIN)
    assert isinstance(w_c, float) and math.isclose(w_c, 2.5)
    assert np.allclose(critical_spin(I1=[0.5, 2.0], I3=0.8, mgl=2.0), [2.5, 5.0])
    growth = upright_growth_rate(**PLAIN, w3=[0, 1.5, 2.5, 3])
    assert np.allclose(growth, [2, 1.6, 0, 0]) and growth[3] == 0
    assert LagrangeTop(**PLAIN, q0=[1, 0, 0, 0], w0=[0, 0, 3]).regime == "sleeping"

    t = np.linspace(-3, 3, 13)
    state = homoclinic_top(t, **PLAIN, w3=1.5)
    k, g = 0.8, 1.6
    axis = matrix(state.q_NB)[..., 2]
    assert np.allclose(axis[..., 2], 1 - 2 * (k / np.cosh(g * t)) ** 2, rtol=0, atol=1e-14)
    assert axis[6, 1] < -0.5 and abs(axis[6, 0]) < 1e-15  # South
    energy = 0.25 * (state.w_NB_B_rad_s[:, :2] ** 2).sum(axis=-1) + 2 * axis[:, 2]
    assert np.allclose(energy, 2, rtol=0, atol=1e-13) and (state.w_NB_B_rad_s[:, 2] == 1.5).all()
    top = LagrangeTop(**PLAIN, q0=state.q_NB[6], w0=state.w_NB_B_rad_s[6])
    assert top.regime == "homoclinic" and top.nutation_period_s > 35 / g / 2  # infinite but for the rounding of the start
    assert angle(top.at(t).q_NB, state.q_NB).max() < 1e-12


def test_separatrix_of_the_free_body():
    t = np.linspace(-4, 4, 9)
    state = separatrix_free_body(t, moments=[1, 2, 3], w2=1)
    s = math.sqrt(1 / 3)
    assert np.allclose(state.w_NB_B_rad_s, np.stack([1 / np.cosh(s * t), np.tanh(s * t), s / np.cosh(s * t)], axis=-1))
    L_N = np.einsum("tij,tj->ti", matrix(state.q_NB), state.w_NB_B_rad_s * [1, 2, 3])
    assert np.allclose(L_N, [0, 0, 2])
    body = FreeBody(moments=[1, 2, 3], q0=state.q_NB[4], w0=state.w_NB_B_rad_s[4])
    assert angle(body.at(t).q_NB, state.q_NB).max() < 1e-12


def test_gyroscope_on_the_earth():
    W = earth_rate_L([0, 30, 90, -90])
    assert W.shape == (4, 3)
    expected = EARTH_RATE_RAD_S * np.array([[0, 1, 0], [0, math.sqrt(0.75), 0.5], [0, 0, 1], [0, 0, -1]])
    assert np.allclose(W, expected, rtol=1e-15, atol=0) and EARTH_RATE_RAD_S == 7.292115e-5

    t = np.array([0, 3600.0, 86164.1 / 2])
    pole = balanced_gyroscope_axis_L(t, axis_L=[0, 1, 0], W_IL_L=W[2])
    assert np.allclose(pole, np.stack([np.sin(W[2, 2] * t), np.cos(W[2, 2] * t), 0 * t], axis=-1))  # clockwise, as the stars
    axis = balanced_gyroscope_axis_L(t, axis_L=[1, 0, 0], W_IL_L=W[1])
    drift = balanced_gyroscope_drift(t, axis_sine=1)
    assert np.allclose(np.arctan2(np.linalg.norm(np.cross(axis, axis[0]), axis=-1), axis @ axis[0]), drift)
    assert math.isclose(drift[1], EARTH_RATE_RAD_S * 3600)


def test_sleeping_top_and_pendulum_on_the_earth():
    top, w3, W = {"I1": 1.2e-4, "I3": 4e-5, "mgl": 0.0294}, 800.0, earth_rate_L(50, 1e-3)
    n = resting_axis_L(**top, w3=w3, W_IL_L=W)
    # At rest in the laboratory, the angular momentum (along n, and of I1 W across it) turns with W as the torque demands.
    L = top["I3"] * w3 * n + top["I1"] * (W - (W @ n) * n)
    assert np.allclose(np.cross(W, L), top["mgl"] * np.cross([0, 0, 1], n), rtol=0, atol=1e-17)
    lean = sleeping_top_lean_south(**top, w3=w3, W_IL_L=W)
    assert math.isclose(lean.value, 4e-5 * 800 * W[1] / 0.0294) and abs(math.atan2(-n[1], n[2]) - lean.value) < lean.left_out
    assert lean.value > 1e-4 > lean.left_out > 0

    latitudes = np.array([-30.0, 30.0, 60.0])
    swing = foucault_rate(I1=1.0, I3=0.0, mgl=-9.8, amplitude=0.01, W_IL_L=earth_rate_L(latitudes))
    assert np.allclose(swing.value, -EARTH_RATE_RAD_S * np.sin(np.radians(latitudes)), rtol=1e-14)
    assert foucault_rate(I1=1.0, I3=1.0, mgl=-9.8, amplitude=0.01, W_IL_L=[0, 0, 2e-5]).value == -1e-5
