// SPDX-License-Identifier: GPL-3.0-or-later
/// Phases over many turns: the product of a rate, kept as an unevaluated sum of two numbers, and a time, reduced to one period.
#pragma once

#include "closed_form/wider.hpp"

namespace earthtop {

/// x, known in a wider scalar, as the unevaluated sum of two numbers `high` and `low`.
template <class S, class W>
S split(W x) {
  using T = decltype(S{}.high);
  const T high = static_cast<T>(x);
  return {high, real::isfinite(high) ? static_cast<T>(x - static_cast<W>(high)) : T(0)};
}

template <class T>
struct PhaseRest {
  T turns;     ///< whole periods taken off
  T rest;      ///< within half a period of 0
  T rest_low;  ///< what rounding took off the rest
};

/// (rate.high + rate.low) * t + offset, less whole periods; error eps^2 of the whole.
/// An infinite period takes nothing off.
template <class S, class T>
PhaseRest<T> phase_rest(const S& rate, T t, const S& offset, const S& period) {
  const T product = rate.high * t;
  const T tail = real::fma(rate.high, t, -product) + rate.low * t + offset.low;
  const T whole = product + offset.high;
  const T part = whole - product;
  const T lost = (product - (whole - part)) + (offset.high - part);  // of the sum, exactly (Knuth)
  const T turns = real::isfinite(period.high) ? real::rint(whole / period.high) : T(0);
  const bool whole_periods = turns != T(0);
  const T high = whole_periods ? real::fma(-turns, period.high, whole) : whole;
  const T low = whole_periods ? real::fma(-turns, period.low, tail + lost) : tail + lost;
  const T rest = high + low;
  return {turns, rest, low - (rest - high)};
}

}  // namespace earthtop
