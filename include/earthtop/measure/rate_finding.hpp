// SPDX-License-Identifier: GPL-3.0-or-later
/// Judges an estimate of the Earth's rate, or of a component of it: the only numbers of which zero means something, that the
/// Earth does not turn. Their limits are here and nowhere else.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/measure/exact_input.hpp"

namespace earthtop {

enum class RateOutcome {
  seen,        ///< consistent with the known rate, and zero is excluded
  not_seen,    ///< consistent with the known rate, and with zero
  contradicts  ///< the known rate is excluded: something else in the scenario is wrong
};
std::string_view to_string(RateOutcome outcome);

/// A rate that is known besides the measurement (rad/s).
struct KnownRate {
  double value = 0;
  double standard_error = 0;
  bool is_earths = true;  ///< or one that only the scenario says
};

struct RateFinding {
  /// A value that is at least so many standard errors away is excluded: by chance alone one result in 370 is.
  static constexpr double kLimit_sigma = 3;

  KnownRate known;
  double from_zero_sigma = 0;   ///< the estimate in its standard errors, without sign
  double from_known_sigma = 0;  ///< estimate minus known rate, in standard errors of that difference
  bool had_prior = false;       ///< whether what was known beforehand is in the estimate; the other members are without it
  /// Where a measurement contradicts, the errors of inputs taken as exact that would do it, each by itself, and that its residuals
  /// do not exclude; those first whose inputs shift the estimate most.
  std::vector<InputError> culprits = {};

  RateOutcome outcome() const;
};

/// @param standard_error  of the estimate (rad/s), above 0
/// @param prior           standard error of the known rate as a datum of the fit, where it was one. The finding is then about
///                        what the other data say.
RateFinding rate_finding(double estimate, double standard_error, const KnownRate& known, std::optional<double> prior);

/// "seen, zero is excluded at 17 sigma; consistent with the known 5.2e-05, 0.1 sigma below it". A contradiction names the first
/// three errors that would do it.
std::string finding_words(const RateFinding& finding);

}  // namespace earthtop
