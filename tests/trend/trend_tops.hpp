// SPDX-License-Identifier: GPL-3.0-or-later
/// Random tops for counting how often the trend's bound holds, and their rates over a far longer time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "support/scenes.hpp"

namespace earthtop::testing {

/// The kinds of tops that are drawn, one after the other. `any`: standing or hanging, slow or fast, symmetric or not, on an Earth that turns up to
/// 1000 times as fast as the real one. The others are what people have at hand, three in four on the real Earth: `toy` and
/// `gyro`, a disc on a stick; `hanging`, the same below its pivot; `pendulum`, a bob that hardly spins; `upright`, within five
/// degrees of the vertical; `one_turn` of precession or little more, and `many_turns`, 30 to 400; `asymmetric`, with three
/// moments; `shipped`, variants of this project's scenarios; `effects`, with a gravity gradient, a plumb line and a pole that
/// depart from the ellipsoid's, named methods, loose tolerances and few rows.
inline constexpr std::array<std::string_view, 11> kTrendKinds{
    "any", "toy", "gyro", "hanging", "pendulum", "upright", "one_turn", "many_turns", "asymmetric", "shipped", "effects"};

/// Top number `index`, of kind `index` modulo their number.
/// @returns nothing where the top has no such release, no precession, less than a turn of it, or where a run `times` as long is
/// estimated to take more than `most_seconds`
std::optional<Scenario> random_trend_top(std::uint64_t index, double times, double most_seconds);

/// How the trend of a run compares with that of a run `times` as long.
struct TrendJudged {
  SecularDrift trend;
  TheoryReport theory;  ///< without a name where there is none
  double true_rate_rad_s = 0, true_bound_rad_s = 0;
  double error() const { return std::abs(*trend.azimuth_rate_rad_s - true_rate_rad_s); }
};
/// @returns nothing where one of the two runs has no trend, where the longer one is not reliable, or where both trends rest on the same
/// window
std::optional<TrendJudged> judge_trend(const Scenario& scenario, double times);

}  // namespace earthtop::testing
