// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/measure/rate_finding.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/measure/measurement.hpp"
#include "measure/sigmas.hpp"

namespace earthtop {
namespace measure {
namespace {

std::string words_on(const std::vector<InputError>& culprits) {
  if (culprits.empty()) return "no error of one of its inputs alone would do it";
  constexpr std::size_t kNamed = 3;
  const std::size_t named = std::min(culprits.size(), kNamed);
  std::string text = "an error of ";
  for (std::size_t i = 0; i < named; ++i)
    text += fmt::format("{}{} by {:+.2g}{}{}",
                        i == 0           ? ""
                        : i + 1 == named ? " or "
                                         : ", ",
                        name_in_release(culprits[i].name, culprits[i].release), culprits[i].error,
                        culprits[i].unit.empty() ? "" : " ", culprits[i].unit);
  return text + " would do it";
}

}  // namespace
}  // namespace measure

std::string_view to_string(RateOutcome outcome) {
  switch (outcome) {
    case RateOutcome::seen: return "seen";
    case RateOutcome::not_seen: return "not_seen";
    case RateOutcome::contradicts: return "contradicts";
  }
  return "";
}

RateOutcome RateFinding::outcome() const {
  if (std::abs(from_known_sigma) >= kLimit_sigma) return RateOutcome::contradicts;
  return from_zero_sigma >= kLimit_sigma ? RateOutcome::seen : RateOutcome::not_seen;
}

RateFinding rate_finding(double estimate, double standard_error, const KnownRate& known, std::optional<double> prior) {
  RateFinding finding{known, 0, 0, prior.has_value()};
  if (prior) {  // information adds up: the data's is what the prior's leaves of the estimate's
    const double of_both = 1 / (standard_error * standard_error), of_prior = 1 / (*prior * *prior);
    const double of_data = of_both - of_prior;
    // A fit's standard errors have some six digits: a smaller part of the information is not known to be the data's.
    constexpr double kRounding = 1e-9;
    if (!(of_data > kRounding * of_both)) return finding;  // the data say nothing
    estimate = known.value + (estimate - known.value) * (of_both / of_data);
    standard_error = 1 / std::sqrt(of_data);
  }
  finding.from_zero_sigma = std::abs(estimate) / standard_error;
  finding.from_known_sigma =
      (estimate - known.value) / std::sqrt(standard_error * standard_error + known.standard_error * known.standard_error);
  return finding;
}

std::string finding_words(const RateFinding& finding) {
  using measure::sigmas, measure::words_on;
  const KnownRate& known = finding.known;
  constexpr double kShown = 1e-6;  // of the rate: a smaller error is beyond the digits of "{:.7g}"
  const std::string value = known.standard_error > kShown * std::abs(known.value)
                                ? with_standard_error(known.value, known.standard_error)
                                : fmt::format("{:.7g}", known.value);
  const std::string rate =
      fmt::format("the {} {}, {} sigma {} it", known.is_earths ? "known" : "scenario's", value,
                  sigmas(std::abs(finding.from_known_sigma)), finding.from_known_sigma < 0 ? "below" : "above");
  const std::string by_data = finding.had_prior ? "by the data alone " : "", from_zero = sigmas(finding.from_zero_sigma);
  switch (finding.outcome()) {
    case RateOutcome::seen:
      return fmt::format("{}seen, zero is excluded at {} sigma; consistent with {}", by_data, from_zero, rate);
    case RateOutcome::not_seen:
      return fmt::format("{}not seen, {} sigma from zero; consistent with {}", by_data, from_zero, rate);
    case RateOutcome::contradicts:
      return fmt::format("{}contradicts {}: something {}in the scenario is wrong or missing; {}", by_data, rate,
                         known.is_earths ? "else " : "", words_on(finding.culprits));
  }
  return "";
}

}  // namespace earthtop
