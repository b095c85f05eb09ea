# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers with more digits than a double has, as numbers of mpmath.

Results of a run hold them as decimal text. Closed forms take and return them as the 16 bytes of a float128, which holds a
long double, too, without rounding. Numbers of mpmath keep all their digits, whatever ``mpmath.mp.dps`` is; what is computed
with them later is rounded to that. Everything here needs mpmath (Debian: python3-mpmath).
"""

from __future__ import annotations

import decimal
import fractions
import sys
from typing import Any, Iterable, Tuple

import numpy as np

BITS = {"double": 53, "long_double": 64, "float128": 113}  #: of the significand, in each precision

_TEXT_BITS = 128  #: enough to hold any number with the 36 digits of a float128
_PACKED = np.dtype("V16")
_FRACTION_BITS, _BIAS = 112, 16383  # of a float128; a long double has the same exponents
_LEAST_EXPONENT, _MOST_EXPONENT = 1 - _BIAS, _BIAS  # of numbers with all their bits, 1 <= significand < 2


def _mpf(raw: Tuple[int, int, int, int]) -> Any:
    import mpmath

    return mpmath.mp.make_mpf(raw)


def as_mpmath(texts: Iterable[str]) -> np.ndarray:
    """An array of ``mpmath.mpf`` from decimal texts; an empty text gives NaN."""
    from mpmath.libmp import fnan, from_str

    given = np.asarray(texts, dtype=object)
    numbers = np.empty(given.shape, dtype=object)
    for index, text in np.ndenumerate(given):
        numbers[index] = _mpf(from_str(text, _TEXT_BITS, "n") if text else fnan)
    return numbers


def _ratio(number: Any) -> Tuple[int, int]:
    """The exact value as numerator and denominator.

    TypeError if it is no real number; ValueError if it is not finite, or far out of the range of a float128.
    """
    if isinstance(number, str):
        try:
            number = decimal.Decimal(number.strip())
        except decimal.InvalidOperation:
            raise TypeError from None
    if isinstance(number, decimal.Decimal) and number and number.is_finite() and abs(number.adjusted()) > 5000:
        raise ValueError  # its integers would be huge
    if isinstance(number, (bool, np.bool_)) or not hasattr(number, "as_integer_ratio"):
        if not isinstance(number, np.integer):
            raise TypeError
        number = int(number)
    try:
        numerator, denominator = number.as_integer_ratio()
    except OverflowError:  # infinity
        raise ValueError from None
    return int(numerator), int(denominator)


def is_real(number: Any) -> bool:
    """Whether it is a number of some kind or decimal text; it may be too large, infinite or NaN."""
    if hasattr(number, "_mpf_"):
        return True
    try:
        _ratio(number)
    except TypeError:
        return False
    except ValueError:
        pass
    return True


def rounded(number: Any, precision: str) -> Any:
    """The ``mpmath.mpf`` nearest to a number among those of a precision; it is rounded once, from the exact value.

    Parameters
    ----------
    number : number of any kind, or decimal text, for which ``is_real`` holds

    Raises
    ------
    ValueError
        if it is not finite, or not within the range of the precision
    """
    from mpmath.libmp import from_int, fzero, mpf_div, mpf_pos

    bits = BITS[precision]
    raw = getattr(number, "_mpf_", None)
    if raw is None:
        numerator, denominator = _ratio(number)
        raw = mpf_div(from_int(numerator), from_int(denominator), bits, "n")
    else:
        raw = mpf_pos(raw, bits, "n")
    if raw == fzero:
        return _mpf(raw)
    _, mantissa, exponent, length = raw
    if not mantissa or not _LEAST_EXPONENT <= exponent + length - 1 <= _MOST_EXPONENT:
        raise ValueError
    return _mpf(raw)


def packed(numbers: np.ndarray) -> np.ndarray:
    """Numbers that ``rounded`` has made, as the bytes of float128, in an array of the same shape."""

    def word(number: Any) -> int:
        sign, mantissa, exponent, length = (int(part) for part in number._mpf_)
        if not mantissa:
            return 0
        fraction = (mantissa << (_FRACTION_BITS + 1 - length)) - (1 << _FRACTION_BITS)
        return (sign << 127) | ((exponent + length - 1 + _BIAS) << _FRACTION_BITS) | fraction

    data = b"".join(word(number).to_bytes(16, sys.byteorder) for number in numbers.flat)
    return np.frombuffer(data, dtype=_PACKED).reshape(numbers.shape)


def unpacked(array: np.ndarray) -> np.ndarray:
    """The numbers of float128 in an array of their bytes, exactly, as ``mpmath.mpf``."""
    from mpmath.libmp import finf, fnan, fninf, from_man_exp

    def number(word: int) -> Any:
        sign, biased, fraction = word >> 127, (word >> _FRACTION_BITS) & 0x7FFF, word & ((1 << _FRACTION_BITS) - 1)
        if biased == 0x7FFF:
            return _mpf(fnan if fraction else fninf if sign else finf)
        mantissa = fraction | (1 << _FRACTION_BITS) if biased else fraction
        return _mpf(from_man_exp(-mantissa if sign else mantissa, max(biased, 1) - _BIAS - _FRACTION_BITS))

    data = array.tobytes()
    numbers = np.empty(array.size, dtype=object)
    for i in range(array.size):
        numbers[i] = number(int.from_bytes(data[16 * i:16 * i + 16], sys.byteorder))
    return numbers.reshape(array.shape)


def fraction_of(number: Any) -> fractions.Fraction:
    """The exact value of a finite float or number of mpmath."""
    if not hasattr(number, "_mpf_"):
        return fractions.Fraction(number)
    from mpmath.libmp import to_rational

    return fractions.Fraction(*map(int, to_rational(number._mpf_)))


def text_of(number: Any, precision: str) -> str:
    """The shortest decimal text of a finite number that is read back, in its precision, to the same bits."""
    exact = fraction_of(number)
    numerator, denominator = decimal.Decimal(exact.numerator), decimal.Decimal(exact.denominator)
    for digits in range(1, 36):
        text = str(decimal.Context(prec=digits, Emax=99999, Emin=-99999).divide(numerator, denominator))
        if rounded(text, precision) == number:
            return text
    return str(decimal.Context(prec=36, Emax=99999, Emin=-99999).divide(numerator, denominator))
