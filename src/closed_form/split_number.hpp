// SPDX-License-Identifier: GPL-3.0-or-later
/// Phases over many turns: the product of a rate, stored as an unevaluated sum of two numbers, and a time, reduced to one
/// period.
#pragma once

#include "closed_form/wider.hpp"

namespace earthtop {

/// x, known in a wider scalar type, as the unevaluated sum of the two numbers `high` and `low`.
template <class S, class W>
S split(W x) {
  using T = decltype(S{}.high);
  const T high = static_cast<T>(x);
  return {high, real::isfinite(high) ? static_cast<T>(x - static_cast<W>(high)) : T(0)};
}

template <class T>
struct PhaseRest {
  T turns;     ///< number of whole periods subtracted
  T rest;      ///< within half a period of 0
  T rest_low;  ///< rounding error of the rest, to be added to it
};

/// (rate.high + rate.low) * t + offset, reduced by whole periods; the error is eps^2 times the unreduced phase. With an
/// infinite period nothing is subtracted.
template <class S, class T>
PhaseRest<T> phase_rest(const S& rate, T t, const S& offset, const S& period) {
  const T product = rate.high * t;
  const T tail = real::fma(rate.high, t, -product) + rate.low * t + offset.low;
  const T whole = product + offset.high;
  const T part = whole - product;
  const T lost = (product - (whole - part)) + (offset.high - part);  // rounding error of the sum, exactly (Knuth)
  const T turns = real::isfinite(period.high) ? real::rint(whole / period.high) : T(0);
  const bool whole_periods = turns != T(0);
  const T high = whole_periods ? real::fma(-turns, period.high, whole) : whole;
  const T low = whole_periods ? real::fma(-turns, period.low, tail + lost) : tail + lost;
  const T rest = high + low;
  return {turns, rest, low - (rest - high)};
}

}  // namespace earthtop
