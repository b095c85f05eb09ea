# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and arrays that users give to closed forms, checked; and what the extension returns for them."""

from __future__ import annotations

from typing import Any, List, Sequence, Tuple

import numpy as np

from . import _core
from ._errors import refuse
from ._extended import BITS, is_real, packed, rounded, unpacked

Numbers = Any  #: a number, a list of numbers or an array


def given(name: str, value: Numbers, precision: str, components: int = 1) -> np.ndarray:
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


def require(name: str, numbers: np.ndarray, holds: Any, what: str) -> None:
    """Refuses an argument unless the condition holds for every element."""
    good = np.asarray(holds, dtype=bool)
    if not good.all():
        culprit = np.asarray(numbers)[~good].flat[0] if good.shape == np.shape(numbers) else numbers
        raise refuse(f"{name} must be {what}, not {_short(culprit)}")


def _short(number: Any) -> str:
    if isinstance(number, np.ndarray):
        return "[" + ", ".join(map(_short, number)) + "]" if number.ndim else _short(number[()])
    return str(number) if hasattr(number, "_mpf_") else f"{float(number):.6g}"


def top_parameters(precision: str, I1: Numbers, I3: Numbers, mgl: Numbers, point_bob: bool = False) -> List[np.ndarray]:
    """The parameters of a symmetric top; of a point bob, I3 may be 0."""
    top = [given(name, value, precision) for name, value in (("I1", I1), ("I3", I3), ("mgl", mgl))]
    require("I1", top[0], top[0] > 0, "positive (kg m^2)")
    if point_bob:
        require("I3", top[1], top[1] >= 0, "0 or positive (kg m^2)")
    else:
        require("I3", top[1], top[1] > 0, "positive (kg m^2)")
    return top


def quaternion(name: str, value: Numbers, precision: str) -> np.ndarray:
    q = given(name, value, precision, 4)
    require(name, q, (q != 0).any(axis=-1), "a quaternion (w, x, y, z) of any norm but zero")
    return q


def passed(numbers: np.ndarray) -> np.ndarray:
    """Numbers as the extension takes them."""
    return packed(numbers) if numbers.dtype == object else numbers


def returned(array: np.ndarray) -> Any:
    """Numbers from the extension as the user gets them: scalars for a single element, as NumPy's functions do."""
    numbers = array if array.dtype == np.float64 else unpacked(array)
    return numbers if numbers.ndim else numbers[()]


def broadcast(arguments: Sequence[Tuple[np.ndarray, int]]) -> Tuple[List[np.ndarray], Tuple[int, ...]]:
    """Arguments, each with its number of components, as the extension takes them; and the shape of the elements."""
    shapes = [numbers.shape if width == 1 else numbers.shape[:-1] for numbers, width in arguments]
    try:
        shape = np.broadcast_shapes(*shapes)
    except ValueError:
        raise refuse(f"the arguments' shapes cannot be broadcast together: {', '.join(map(str, shapes))}") from None
    arrays = []
    for numbers, width in arguments:
        array = passed(numbers)
        if array.size != width:
            array = np.ascontiguousarray(np.broadcast_to(array, shape if width == 1 else shape + (width,)))
        arrays.append(array)
    return arrays, shape


def evaluated(function: str, precision: str, arguments: Sequence[Tuple[np.ndarray, int]]) -> Tuple[Any, ...]:
    """A function of the extension for every element of its arguments."""
    return tuple(map(returned, _core.special_case(function, precision, *broadcast(arguments))))
