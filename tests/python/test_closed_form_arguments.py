# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments and results of closed forms: precisions, shapes, pickles, refusals; and what they do to the calling thread."""

import copy
import ctypes
import doctest
import math
import pickle
import platform
import signal
import threading
import time
from fractions import Fraction

import numpy as np
import pytest

import earthtop as et
from earthtop import _extended
from earthtop.closed_form import (FreeBody, LagrangeTop, State, balanced_gyroscope_axis_L, balanced_gyroscope_drift,
                                  critical_spin, earth_rate_L, foucault_rate, homoclinic_top, mean_rates, resting_axis_L,
                                  seen_from_laboratory, separatrix_free_body, sleeping_top_lean_south, steady_precession,
                                  steady_precession_rates, upright_growth_rate)

EXTENDED = ["long_double", "float128"]
TOP = {"I1": 0.5, "I3": 0.75, "mgl": 2.0, "q0": [1, 0.25, 0.125, 0.5], "w0": [0.5, -0.25, 3.0]}
BODY = {"moments": [1.0, 2.0, 3.5], "q0": [1, -0.5, 0.25, 0], "w0": [0.25, 1.5, -0.5]}
PLAIN = {"I1": 0.5, "I3": 0.8, "mgl": 2.0}


# Precisions -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("precision", EXTENDED)
def test_numbers_pass_without_rounding(precision):
    mpmath = pytest.importorskip("mpmath")
    bits = _extended.BITS[precision]
    unit = 2 ** (bits + 3)  # 1/10 is between 2^-4 and 2^-3
    assert _extended.fraction_of(_extended.rounded("0.1", precision)) == Fraction(round(Fraction(unit, 10)), unit)
    odd = 2**bits - 1
    exact = [0, 0.1, -odd, Fraction(odd, 2**1000), np.float32(0.1), np.int64(2**62 + 1), 3 * 2**9000]
    numbers = np.array([_extended.rounded(x, precision) for x in exact], dtype=object)
    assert [_extended.fraction_of(x) for x in numbers] == [Fraction(*x.as_integer_ratio()) if isinstance(x, np.floating)
                                                          else Fraction(int(x)) if isinstance(x, np.integer)
                                                          else Fraction(x) for x in exact]
    with mpmath.workdps(5):
        assert (_extended.unpacked(_extended.packed(numbers)) == numbers).all()
    # Ties go to even: 2^bits + 1 lies between two numbers.
    assert [int(_extended.rounded(2**bits + x, precision)) - 2**bits for x in (1, 2, 3)] == [0, 2, 4]
    with mpmath.workdps(60):
        long = [mpmath.mpf(2**bits + x) for x in (1, 2, 3)]
    assert [int(_extended.rounded(x, precision)) - 2**bits for x in long] == [0, 2, 4]
    # Through the compiled code: at rest, and about Up, the rate is returned as it was given.
    for number in numbers[:4]:
        body = FreeBody(moments=[1, 1, 1], q0=[1, 0, 0, 0], w0=[0, 0, number], precision=precision)
        assert body.at(0).w_NB_B_rad_s[2] == number


def test_packed_numbers_are_those_of_ieee_754():
    mpmath = pytest.importorskip("mpmath")
    words = {0x3FFF << 112: 1, 0xC000 << 112: -2, (0x3FFF << 112) + 1: 1 + Fraction(1, 2**112), 1: Fraction(1, 2**16494),
             (0x7FFE << 112) + 2**112 - 1: 2**16384 - 2**16271, 1 << 112: Fraction(1, 2**16382)}
    array = np.frombuffer(b"".join(word.to_bytes(16, "little") for word in words), dtype="V16")
    if np.little_endian:
        assert [_extended.fraction_of(x) for x in _extended.unpacked(array)] == list(words.values())
    special = np.frombuffer(b"".join((word << 112).to_bytes(16, "little") for word in (0x7FFF, 0xFFFF)), dtype="V16")
    assert list(_extended.unpacked(special)) == [mpmath.inf, -mpmath.inf]
    with pytest.raises(ValueError):
        _extended.rounded(Fraction(1, 2**16383), "float128")


@pytest.mark.parametrize("precision", EXTENDED)
def test_decimal_times_keep_their_digits(precision):
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(60):
        third = mpmath.mpf(1) / 3
        t = [["0.1", "1e1"], [third, Fraction(1, 3)]]
        with mpmath.workdps(5):  # has no influence on what is computed
            state = steady_precession(t, q0=[1, 0, 0, 0], precession_rate=3, w3=3, precision=precision)
        assert state.q_NB.shape == (2, 2, 4) and state.attitude_error_rad.shape == (2, 2)
        unit = mpmath.mpf(2) ** (1 - _extended.BITS[precision])
        for index, exact in (((0, 0), mpmath.mpf("0.1")), ((0, 1), 10), ((1, 0), third), ((1, 1), third)):
            assert abs(state.q_NB[index][3] - mpmath.sin(1.5 * exact)) < 4 * unit  # twice t, as 0.1 in double differs by 5e-18
            assert abs(state.q_NB[index][0] - mpmath.cos(1.5 * exact)) < 4 * unit


def test_results_of_one_closed_form_are_input_of_another():
    pytest.importorskip("mpmath")
    W = earth_rate_L("45", "1e-4", precision="float128")
    body = FreeBody(**BODY, precision="float128")
    seen = seen_from_laboratory(body.at([1, 2]), [1, 2], W_IL_L=W, precision="float128")
    assert (seen.attitude_error_rad < 1e-28).all()
    with pytest.raises(et.ScenarioError, match="float128"):  # never silently rounded
        seen_from_laboratory(body.at([1, 2]), [1, 2], W_IL_L=[0, 0, 1])


# Habits of arrays -----------------------------------------------------------------------------------------------------


def test_shapes_of_times():
    top = LagrangeTop(**TOP)
    t = np.linspace(0, 3, 24)
    flat = top.at(t)
    assert isinstance(flat, State) and top.regime == "looping" and top.precision == "double"
    assert 0 < top.parameter < 1 and math.isclose(top.parameter + top.complementary_parameter, 1)
    for given in (t.reshape(2, 3, 4), t.reshape(2, 3, 4).tolist(), np.repeat(t, 2)[::2].reshape(2, 3, 4),
                  t.astype(">f8").reshape(2, 3, 4), np.asfortranarray(t.reshape(2, 3, 4))):
        state = top.at(given)
        assert state.q_NB.shape == (2, 3, 4, 4) and state.w_NB_B_rad_s.shape == (2, 3, 4, 3)
        for part, expected in zip(state, flat):
            assert part.flags.c_contiguous and part.flags.owndata and part.dtype == np.float64
            assert np.array_equal(part.reshape(expected.shape), expected)
    one = top.at(t[5])
    assert one.q_NB.shape == (4,) and np.array_equal(one.q_NB, flat.q_NB[5])
    assert isinstance(one.attitude_error_rad, float) and one.attitude_error_rad == flat.attitude_error_rad[5]
    assert np.array_equal(top.at(2).q_NB, top.at(np.int8(2)).q_NB)
    assert top.at([]).q_NB.shape == (0, 4)
    assert top.at(np.zeros((3, 0))).w_NB_B_rad_s.shape == (3, 0, 3)
    assert not np.array_equal(flat.q_NB[1], flat.q_NB[2])
    period = top.nutation_period_s
    w, x, y, z = top.at(np.array([0.3, 0.3 + period / 2, 0.3 + period])).q_NB.T
    tilt = w * w + z * z - x * x - y * y  # its cosine
    assert abs(tilt[0] - tilt[2]) < 1e-14 < abs(tilt[0] - tilt[1])


def test_parameters_are_broadcast():
    t, w3 = np.linspace(0, 2, 5), np.array([[0.5], [1.0], [1.5]])
    state = homoclinic_top(t, **PLAIN, w3=w3)
    assert state.q_NB.shape == (3, 5, 4)
    for i in range(3):
        for j in range(5):
            assert np.array_equal(state.q_NB[i, j], homoclinic_top(t[j], **PLAIN, w3=w3[i, 0]).q_NB)
    axes = np.eye(3)
    turned = balanced_gyroscope_axis_L(t[:, None], axis_L=axes, W_IL_L=[[0, 0, 1.0]])
    assert turned.shape == (5, 3, 3)
    assert np.array_equal(turned[4, 1], balanced_gyroscope_axis_L(2.0, axis_L=[0, 1, 0], W_IL_L=[0, 0, 1]))


@pytest.mark.parametrize("precision", ["double", *EXTENDED])
@pytest.mark.parametrize("make, given", [(LagrangeTop, TOP), (FreeBody, BODY),
                                         (FreeBody, {"inertia": np.diag([1.0, 2, 3]), **{k: BODY[k] for k in ("q0", "w0")}})])
def test_pickles_copies_and_repr(make, given, precision):
    if precision != "double":
        pytest.importorskip("mpmath")
    motion = make(**{**given, "w0": [0.1, 0.2, 0.3]}, precision=precision)
    t = [0, 0.1, 5]
    for other in (pickle.loads(pickle.dumps(motion)), copy.copy(motion), copy.deepcopy(motion), eval(repr(motion))):
        assert type(other) is make and other.precision == precision and other.regime == motion.regime
        assert all((a == b).all() for a, b in zip(other.at(t), motion.at(t)))


def test_arguments_are_not_kept():
    q0, w0 = np.array([1.0, 0, 0, 0]), np.array([1.0, 2, 3])
    body = FreeBody(moments=[1, 2, 3], q0=q0, w0=w0)
    before, text = body.at(1).q_NB, repr(body)
    q0[:], w0[:] = 5, 5
    assert repr(body) == text and np.array_equal(pickle.loads(pickle.dumps(body)).at(1).q_NB, before)


def test_help_says_what_is_what():
    doctests = doctest.testmod(et.closed_form)
    assert doctests.attempted >= 5 and doctests.failed == 0
    for name in et.closed_form.__all__:
        thing = getattr(et.closed_form, name)
        assert name.isupper() or len(thing.__doc__) > 40, name
    for function in (steady_precession, homoclinic_top, seen_from_laboratory, resting_axis_L, LagrangeTop, FreeBody):
        assert "rad/s" in function.__doc__ and "shape" in function.__doc__


# Refusals -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("change, message", [
    ({"I1": 0}, "I1 must be positive"), ({"I3": -1.5}, "I3 must be positive.*not -1.5"),
    ({"I1": [1, 2]}, "I1 must be one number"),
    ({"mgl": math.inf}, "mgl must be finite"), ({"q0": [0, 0, 0, 0]}, "any norm but zero"), ({"q0": [1, 0, 0]}, "4 components"),
    ({"q0": [[1, 0, 0, 0]]}, r"shape \(4,\)"), ({"w0": [1, 2]}, "3 components"),
    ({"w0": [1, 2, math.nan]}, "w0 must be finite.*nan"),
    ({"w0": None}, "real number.*None"), ({"w0": [[1], [2, 3]]}, "one shape"), ({"I1": 1j}, "complex"), ({"I1": True}, "bool"),
    ({"I1": "1"}, "precision="), ({"I1": np.longdouble(1)}, "precision="),
    ({"precision": "quad"}, "one of 'double', .*not 'quad'"),
    ({"I1": 1e-320, "mgl": 1e300}, "too different in size")])
def test_refused_tops(change, message):
    with pytest.raises(et.ScenarioError, match=message):
        LagrangeTop(**{**TOP, **change})


@pytest.mark.parametrize("change, message", [
    ({"I1": "1e5000"}, "finite, and 0 or between"), ({"I1": "1e-5000"}, "finite, and 0 or between"),
    ({"I1": "1e999999999"}, "finite, and 0 or between"), ({"I1": "nan"}, "finite"), ({"I1": "one"}, "real number"),
    ({"I1": None}, "real number"), ({"I1": "-1e-400"}, "positive"), ({"q0": ["0", 0, 0, 0]}, "any norm but zero"),
    ({"I1": 1j}, "real number")])
@pytest.mark.parametrize("precision", EXTENDED)
def test_refused_tops_in_extended_precision(change, message, precision):
    pytest.importorskip("mpmath")
    with pytest.raises(et.ScenarioError, match=message):
        LagrangeTop(**{**TOP, **change}, precision=precision)


@pytest.mark.parametrize("body, message", [
    ({}, "either moments or inertia"), ({"moments": [1, 2, 3], "inertia": np.eye(3)}, "either moments or inertia"),
    ({"moments": [1, 2, 0]}, "positive"), ({"moments": [1, 2]}, "3 components"), ({"moments": [[1, 2, 3]]}, r"shape \(3,\)"),
    ({"inertia": [[1, 2, 0], [0, 1, 0], [0, 0, 1]]}, "symmetric"), ({"inertia": np.eye(2)}, r"shape \(3, 3\)"),
    ({"inertia": [[1, 2, 0], [2, 1, 0], [0, 0, 1]]}, "positive definite"), ({"inertia": -np.eye(3)}, "positive definite"),
    ({"inertia": np.zeros((3, 3))}, "positive definite")])
def test_refused_bodies(body, message):
    with pytest.raises(et.ScenarioError, match=message):
        FreeBody(**body, q0=[1, 0, 0, 0], w0=[1, 2, 3])


@pytest.mark.parametrize("t", [math.nan, [0, -math.inf], "1", None, [[1], [2, 3]], np.datetime64("2020"), 10**400, object()])
def test_refused_times(t):
    with pytest.raises(et.ScenarioError, match="t must be"):
        LagrangeTop(**TOP).at(t)


@pytest.mark.parametrize("call, message", [
    (lambda: steady_precession_rates(**PLAIN, w3=1, cos_tilt=[0, 1.1]), "from -1 to 1, not 1.1"),
    (lambda: mean_rates(I1=1, I3=1, mgl=0, q0=[1, 0, 0, 0], w0=[0, 0, 1]), "other than 0"),
    (lambda: steady_precession(0, q0=[0, 0, 0, 0], precession_rate=1, w3=1), "any norm but zero"),
    (lambda: critical_spin(I1=1, I3=1, mgl=[1, -2]), "hanging"),
    (lambda: upright_growth_rate(I1=1, I3=1, mgl=0, w3=1), "positive"),
    (lambda: homoclinic_top(0, **PLAIN, w3=[1, 2.6]), "no faster than the critical spin"),
    (lambda: homoclinic_top(0, I1=1, I3=1, mgl=-1, w3=1), "positive"),
    (lambda: separatrix_free_body(0, moments=[1, 1, 2], w2=1), "ascending"),
    (lambda: separatrix_free_body(0, moments=[-1, 1, 2], w2=1), "positive"),
    (lambda: separatrix_free_body(0, moments=[1, 2, 3], w2=0), "w2 must be positive"),
    (lambda: separatrix_free_body([1, 2], moments=[1, 2, 3], w2=[1, 2, 3]), "cannot be broadcast"),
    (lambda: earth_rate_L(90.5), "from -90 to 90"), (lambda: earth_rate_L(0, math.nan), "finite"),
    (lambda: seen_from_laboratory(0.5, 0, W_IL_L=[0, 0, 1]), "state must be"),
    (lambda: balanced_gyroscope_axis_L(0, axis_L=[1, 0], W_IL_L=[0, 0, 1]), "3 components"),
    (lambda: balanced_gyroscope_drift(0, axis_sine=1.5), "from 0 to 1"),
    (lambda: resting_axis_L(**PLAIN, w3=1, W_IL_L=[0, 0, 2]), "at least 2 I1 W"),
    (lambda: sleeping_top_lean_south(I1=1, I3=1, mgl=0, w3=1, W_IL_L=[0, 0, 1]), "other than 0"),
    (lambda: foucault_rate(**PLAIN, amplitude=0.1, W_IL_L=[0, 0, 1]), "hangs"),
    (lambda: foucault_rate(I1=1, I3=0, mgl=-1, amplitude=0.6, W_IL_L=[0, 0, 1]), "at most 0.5")])
def test_refused_special_cases(call, message):
    with pytest.raises(et.ScenarioError, match=message):
        call()


# The calling thread ---------------------------------------------------------------------------------------------------


def test_a_signal_ends_a_long_call():
    class Ended(Exception):
        pass

    def handler(number, frame):
        raise Ended

    top, t = LagrangeTop(**TOP), np.linspace(0, 1, 6_000_000)  # a second or two
    start = time.process_time()
    top.at(t[::6])
    whole = 6 * (time.process_time() - start)
    before = signal.signal(signal.SIGVTALRM, handler)
    try:
        start = time.process_time()
        with pytest.raises(Ended):
            signal.setitimer(signal.ITIMER_VIRTUAL, 0.1)  # of processor time
            top.at(t)
        assert time.process_time() - start < 0.5 * whole
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
    assert top.at(t[:3]).q_NB.shape == (3, 4)


def test_threads_run_at_once_and_get_the_same_bits():
    top, t = LagrangeTop(**TOP), np.linspace(0, 50, 1_500_000)
    results, began = [None, None], []

    def work(i):
        began.append(i)
        results[i] = top.at(t).q_NB

    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    while len(began) < 2:
        pass
    start = time.thread_time()
    while any(thread.is_alive() for thread in threads) and time.thread_time() - start < 0.06:
        pass
    assert time.thread_time() - start >= 0.06  # the interpreter was free for more than its switch intervals of 5 ms
    for thread in threads:
        thread.join()
    assert np.array_equal(*results) and np.array_equal(results[0][::1000], top.at(t[::1000]).q_NB)


@pytest.mark.skipif(platform.machine() != "x86_64" or platform.system() != "Linux", reason="sets x86's control word")
def test_rounding_and_subnormal_numbers_do_not_depend_on_the_caller():
    libm = ctypes.CDLL("libm.so.6")
    environment = ctypes.create_string_buffer(32)
    libm.fegetenv(environment)
    changed = ctypes.create_string_buffer(environment.raw, 32)
    control = ctypes.c_uint32.from_buffer(changed, 28)  # MXCSR: flush to zero, subnormals are zeros, round upwards
    control.value |= 0x8040 | 0x4000
    t = np.array([0.25, 300.0, 442.0, 444.0])

    def compute():
        top = LagrangeTop(**TOP)
        return [*top.at(t), *homoclinic_top(t, **PLAIN, w3=1.5), top.parameter]

    expected = compute()
    tiny = abs(expected[4][:, 1])
    assert ((0 < tiny) & (tiny < np.finfo(float).tiny)).any()
    libm.fesetenv(changed)
    try:
        got = compute()
        after = ctypes.create_string_buffer(32)
        libm.fegetenv(after)
    finally:
        libm.fesetenv(environment)
    assert ctypes.c_uint32.from_buffer(after, 28).value & 0xE040 == control.value & 0xE040  # the caller's setting is kept
    assert all(np.array_equal(a, b) for a, b in zip(got, expected))
