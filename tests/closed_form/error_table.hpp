// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors of a closed form in double over random motions, measured against the same closed form at 113 bits.
#pragma once

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "earthtop/closed_form/state.hpp"

namespace earthtop::test {

/// The measured errors of one motion at one time.
struct Measure {
  double error = 0;       ///< angle between double and float128 attitudes (rad)
  double rate_error = 0;  ///< difference of the rates (rad/s)
  double phase = 0;       ///< angle swept: spin + nutation + precession (rad)
  double statement = 0;   ///< the closed form's own bound on `error`
  double rate_statement = 0;
  std::function<double()> kappa;  ///< largest growth of a one-ulp change of an input, in extended precision; costly
  std::function<std::string()> describe;
};

/// A regime of motions: draws and measures one random motion.
struct Regime {
  std::string name;
  std::function<Measure(std::mt19937_64&)> sample;
};

/// The error that the closed forms promise not to exceed: 1e-13 + 4 eps x (phase swept) + 4 eps x kappa (rad).
inline double promised_error(double phase, double kappa) {
  return 1e-13 + 4 * real::epsilon<double>() * phase + 4 * real::epsilon<double>() * kappa;
}

/// error / promised_error; the costly kappa is computed only if the bound is nearly used up without it.
inline double used_part(const Measure& m) {
  const double without = m.error / promised_error(m.phase, 0);
  return without < 0.1 ? without : m.error / promised_error(m.phase, m.kappa());
}

template <class T>
Quaternion<float128> wide(const Quaternion<T>& q) {
  return {float128(q.w), {float128(q.v[0]), float128(q.v[1]), float128(q.v[2])}};
}
template <class T>
Vec3<float128> wide(const Vec3<T>& v) {
  return {float128(v[0]), float128(v[1]), float128(v[2])};
}
/// The angle between two attitudes (rad).
inline double angle_between(const Quaternion<float128>& p, const Quaternion<float128>& q) {
  const Quaternion<float128> turn = p.conjugate() * q;
  return static_cast<double>(2 * real::atan2(norm<float128>(turn.v), real::abs(turn.w)));
}

/// Compares a motion computed in double with the same motion in 113 bits. The caller fills in the phase and the description.
/// @param changed returns the state in 113 bits with input 0, 1, ... changed by one ulp of double
template <class Changed>
Measure measure_against(const ClosedFormState<double>& state, const ClosedFormState<float128>& exact, int inputs,
                        Changed changed) {
  Measure m;
  m.error = angle_between(wide(state.q_NB), exact.q_NB);
  m.rate_error = static_cast<double>(norm<float128>(wide(state.w_NB_B) - exact.w_NB_B));
  m.statement = state.attitude_error;
  m.rate_statement = state.rate_error;
  m.kappa = [exact, inputs, changed] {
    double largest = 0;
    for (int input = 0; input < inputs; ++input)
      largest = std::max(largest, angle_between(changed(input).q_NB, exact.q_NB) / real::epsilon<double>());
    return largest;
  };
  return m;
}

/// The regimes of a list of generators, each of which has a name and a function `draw` that makes the argument of `measure`.
template <class Generators>
std::vector<Regime> regimes_of(const std::string& body, const Generators& generators) {
  std::vector<Regime> regimes;
  for (const auto& generator : generators)
    regimes.push_back(
        {body + ": " + generator.name, [draw = generator.draw](std::mt19937_64& engine) { return measure(draw(engine)); }});
  return regimes;
}

std::vector<Regime> lagrange_regimes();
std::vector<Regime> free_body_regimes();

}  // namespace earthtop::test
