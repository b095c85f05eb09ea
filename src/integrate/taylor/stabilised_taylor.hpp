// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrates by Taylor series of fixed degree whose last terms are weighted, so that steps may be long compared with a fast
/// relaxation. For tolerances of some digits.
///
/// Along a motion that relaxes at the rate r, a step h by plain terms of degree 12 is stable up to r h = 5.7. Weights w_k of the terms
/// of degree 7 to 12 make a step multiply what relaxes by R(-r h), R(z) = sum_k w_k z^k/k!, which is at most 0.95 from z = -24 to
/// -0.05 [stabilised explicit methods: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.2]. R interpolates
/// exp at 0, seven times, and at six points of the interval, each put where the product of its distances from those before is
/// largest (Leja's order).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "earthtop/elementary.hpp"
#include "integrate/group_norms.hpp"

namespace earthtop::taylor {

inline constexpr int kStabilisedDegree = 12, kUnweightedDegree = 6;
/// Largest step times rate of relaxation.
inline constexpr double kStableRelaxation = 24;

/// The weight of a term of the series.
constexpr double stabilising_weight(int degree) {
  constexpr double kWeights[] = {0.911228207640, 0.668188522441, 0.360396978954,
                                 0.132622840791, 0.029758396317, 0.003084033173};
  return degree <= kUnweightedDegree ? 1 : kWeights[degree - kUnweightedDegree - 1];
}

/// @tparam System  has the `Shape` of its states, and a `Series` with start(x, t) and expand(coefficients, order)
template <class System>
class StabilisedTaylor {
 public:
  using Series = typename System::Series;
  using State = std::array<double, System::kSize>;

  /// @param relative_tolerance  of each step, for what the weights leave out of each term
  StabilisedTaylor(double relative_tolerance, const GroupScales<double, typename System::Shape>& scales)
      : tolerance_(relative_tolerance), scales_(&scales) {}

  /// @param x  the state at t; afterwards the state a step later   @returns the step, at most `longest`
  double step(Series& series, State& x, double t, double longest) {
    coefficients_[0] = x;
    series.start(x, t);
    series.expand(coefficients_.data(), kStabilisedDegree);
    double h = longest;
    for (int k = kUnweightedDegree + 1; k <= kStabilisedDegree; ++k) {
      const double size = (1 - stabilising_weight(k)) * std::sqrt(scales_->largest_squared_ratio(at(k)));
      if (!(size * real::pow(h, k) <= tolerance_)) h = real::pow(tolerance_ / size, 1.0 / k);
    }
    State change = at(kStabilisedDegree);
    for (double& c : change) c *= stabilising_weight(kStabilisedDegree);
    for (int k = kStabilisedDegree - 1; k >= 0; --k)
      for (std::size_t i = 0; i < x.size(); ++i) change[i] = change[i] * h + stabilising_weight(k) * at(k)[i];
    x = change;
    return h;
  }

 private:
  const State& at(int k) const { return coefficients_[static_cast<std::size_t>(k)]; }

  double tolerance_;
  const GroupScales<double, typename System::Shape>* scales_;
  std::array<State, kStabilisedDegree + 1> coefficients_{};
};

}  // namespace earthtop::taylor
