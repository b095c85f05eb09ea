// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/explanation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "earthtop/elementary.hpp"

namespace earthtop::compare {
namespace {

using Eigen::Vector3d;

constexpr double kNearRelease = 1e-3;  // rad: attitudes at the release that were meant to be one

}  // namespace

Explainer::Explainer(const Evidence& evidence, const Mapping& mapping, const ByMeasure& tolerance,
                     const Eigen::Vector3d& rate_IL_L)
    : evidence_(evidence), tolerance_(tolerance), reader_(evidence, mapping, rate_IL_L), rate_unit_(mapping.rate_unit_rad_s) {}

/// The largest differences; with shifted rows those of the rows at the beginning.
ByMeasure Explainer::apart(const Reading& reading, const Tops& expected) const {
  ByMeasure largest;
  std::size_t end = std::min(expected.size(), evidence_.size());
  if (reading.later != 0) end = std::min(end, evidence_.in_a_row);
  for (std::size_t i = reading.later < 0 ? 1 : 0; i < end; ++i) {
    const std::size_t there = i + static_cast<std::size_t>(reading.later);
    if (there >= end) continue;
    const SeenTop top = reader_.read(i, reading);
    const SeenTop& other = expected[there];
    if (evidence_.attitude) largest.attitude = std::max(largest.attitude, turn_between(top.q, other.q));
    if (evidence_.axis) largest.axis = std::max(largest.axis, angle_of(top.axis, other.axis));
    if (evidence_.rates) largest.rates = std::max(largest.rates, (top.rates - other.rates).norm());
  }
  return largest;
}

double Explainer::ratio(const ByMeasure& apart) const {
  return std::max({apart.attitude / tolerance_.attitude, apart.axis / tolerance_.axis, apart.rates / tolerance_.rates});
}

Explanation Explainer::explained(const Reading& reading, const Tops& expected) const {
  const ByMeasure left = apart(reading, expected);
  return {reading, left, ratio(left)};
}

Explanation Explainer::best_reading(const Reading& reading, const Tops& expected) const {
  Explanation best = explained(reading, expected);
  const auto try_one = [&](const Reading& other) {
    const Explanation one = explained(other, expected);
    if (one.ratio * kAlike < best.ratio) best = one;
  };
  for (const bool inertial_attitude : {false, true})
    for (const bool world_rates : {reader_.mapped().world_rates, !reader_.mapped().world_rates})
      for (const bool inertial_rates : {false, true}) {
        if ((inertial_attitude && !evidence_.attitude && !evidence_.axis) || (inertial_rates && !evidence_.rates) ||
            (world_rates != reader_.mapped().world_rates && !(evidence_.rates && evidence_.attitude)))
          continue;
        Reading other = reading;
        other.inertial_attitude = inertial_attitude, other.world_rates = world_rates, other.inertial_rates = inertial_rates;
        other.rate_factor = rate_factor(other);
        try_one(other);
      }
  return best;
}

/// How many times the file's rates are those of the reference, where that is the ratio of two units or an opposite sign; else 1.
double Explainer::rate_factor(const Reading& reading) const {
  if (!evidence_.rates) return 1;
  const std::size_t count = std::min<std::size_t>(evidence_.in_a_row, 20);
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    products += reader_.read(i, reading).rates.dot(evidence_.reference[i].rates);
    squares += evidence_.reference[i].rates.squaredNorm();
  }
  const double factor = squares > 0 ? products / squares : 1;
  constexpr double kOpposite = 1e-3;
  if (std::abs(factor + 1) < kOpposite) return -1;
  const auto unit = rate_unit_for(rate_unit_, factor);
  return unit && unit->value != rate_unit_ ? rate_unit_ / unit->value : 1;
}

std::vector<Reading> Explainer::likely_readings() const {
  struct Likely {
    double apart;
    std::size_t changes;
    Reading reading;
  };
  std::vector<Likely> likely;
  constexpr std::size_t kFirst = 20, kMost = 4, kFewestShifted = 4;
  if (!evidence_.attitude && !evidence_.axis) return {};
  const auto distance = [&](const Reading& reading, std::size_t i) {
    const SeenTop top = reader_.read(i, reading);
    const SeenTop& there = evidence_.reference[i + static_cast<std::size_t>(reading.later)];
    return evidence_.attitude ? turn_between(top.q, there.q) : angle_of(top.axis, there.axis);
  };
  const auto look_at = [&](const Reading& reading) {
    const std::size_t rows = std::min(evidence_.in_a_row, kFirst), begin = reading.later < 0 ? 1 : 0;
    if (reading.later != 0 && rows < kFewestShifted) return;
    const std::size_t end = reading.later > 0 ? rows - 1 : rows;
    if (begin >= end || distance(reading, begin) > kNearRelease) return;
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += std::min(distance(reading, i), 1.0);
    const std::size_t changes = reader_.words(reading).size();
    if (changes > 0) likely.push_back({sum / static_cast<double>(end - begin), changes, reading});
  };
  for (const int later : {0, -1, 1}) {
    Reading reading = reader_.mapped();
    reading.later = later;
    for (const AxisTurn& world : all_turns()) {
      reading.world = world;
      if (!evidence_.attitude) {
        for (const bool reversed : {false, true}) reading.axis_reversed = reversed, look_at(reading);
        continue;
      }
      for (const AxisTurn& body : all_turns())
        for (const ScalarPart scalar : {ScalarPart::as_mapped, ScalarPart::last, ScalarPart::first})
          for (const bool world_to_body : {false, true}) {
            reading.body = body, reading.scalar = scalar, reading.world_to_body = world_to_body;
            look_at(reading);
          }
    }
  }
  std::stable_sort(likely.begin(), likely.end(), [](const Likely& a, const Likely& b) {
    constexpr double kSame = 1e-3;  // of readings that agree alike the simpler one
    return std::tuple(std::floor(a.apart / kSame), a.changes, a.apart) <
           std::tuple(std::floor(b.apart / kSame), b.changes, b.apart);
  });
  std::vector<Reading> readings;
  for (const Likely& one : likely)
    if (readings.size() < kMost) readings.push_back(one.reading);
  return readings;
}

std::string Explainer::left_words(const ByMeasure& left) const {
  if (evidence_.attitude) return fmt::format("{:.2g} rad", left.attitude);
  if (evidence_.axis) return fmt::format("{:.2g} rad", left.axis);
  return fmt::format("{:.2g} rad/s", left.rates);
}

std::string Explainer::if_words(const Reading& reading, std::string_view before) const {
  std::string text;
  for (const std::string& words : reader_.words(reading)) text += (text.empty() ? std::string(before) : " and ") + words;
  return text;
}

}  // namespace earthtop::compare
