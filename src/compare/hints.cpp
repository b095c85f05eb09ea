// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/hints.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earthtop::compare {
namespace {

constexpr double kShiftLeaves = 1e-3;  // a shift explains a difference if undoing it leaves at most this part
constexpr double kWorthAGuess = 1e-6;  // rad: smaller differences are no shift
constexpr double kSameRatio = 1e-6;    // relative scatter of numbers that have one ratio
constexpr double kKnownRatio = 1e-4;   // relative error of a known ratio; the ratios in the list differ by more

/// The largest difference of a measure over the pairs.
/// @param later  number of places by which the candidate's rows are shifted against those of the reference
double largest_difference(const Measure& measure, std::span<const SeenPair> seen, int later) {
  double largest = 0;
  const auto count = static_cast<std::ptrdiff_t>(seen.size());
  for (std::ptrdiff_t i = std::max(0, -later); i < std::min(count, count - later); ++i) {
    const Row& candidate = seen[static_cast<std::size_t>(i)].candidate;
    const Row& reference = seen[static_cast<std::size_t>(i + later)].reference;
    if (presence(measure, candidate) != Presence::whole || presence(measure, reference) != Presence::whole) continue;
    largest = std::max(largest, difference(measure, reference, candidate));
  }
  return largest;
}

/// The ratio of the candidate's numbers to the reference's; none unless it is the same for all numbers.
std::optional<double> common_ratio(const Measure& measure, std::span<const SeenPair> seen) {
  double products = 0, squares = 0, candidate_squares = 0;
  for (const SeenPair& pair : seen) {
    if (presence(measure, pair.reference) != Presence::whole || presence(measure, pair.candidate) != Presence::whole) continue;
    for (std::size_t i = measure.column; i < measure.column + measure.width; ++i) {
      const double a = pair.reference.value[i], b = pair.candidate.value[i];
      products += a * b;
      squares += a * a;
      candidate_squares += b * b;
    }
  }
  if (!(squares > 0) || !(candidate_squares > 0)) return std::nullopt;
  const double ratio = products / squares;
  const double rest = candidate_squares - ratio * products;  // sum of squares of what is left
  return rest < kSameRatio * kSameRatio * candidate_squares ? std::optional(ratio) : std::nullopt;
}

struct KnownRatio {
  double ratio;
  const char* what;
};
constexpr KnownRatio kRatios[] = {
    {180 / std::numbers::pi, "degrees instead of radians"},
    {std::numbers::pi / 180, "radians instead of degrees"},
    {648000 / std::numbers::pi, "arcseconds instead of radians"},
    {1e3, "a unit a thousand times smaller"},
    {1e-3, "a unit a thousand times larger"},
    {0.5 / std::numbers::pi, "turns instead of radians"},
    {30 / std::numbers::pi, "turns per minute instead of radians per second"},
    {-1, "the opposite sign"},
};

void look_for_ratio(const Measure& measure, std::span<const SeenPair> seen, std::vector<std::string>& found) {
  const auto ratio = common_ratio(measure, seen);
  if (!ratio) return;
  for (const KnownRatio& known : kRatios)
    if (std::abs(*ratio / known.ratio - 1) < kKnownRatio)
      found.push_back(
          fmt::format("{}: new values are {:.6g} times the reference's, as with {}", measure.name, *ratio, known.what));
}

void look_for_shift(const Measure& measure, std::span<const SeenPair> seen, double difference,
                    std::vector<std::string>& found) {
  for (const int later : {-1, 1})
    if (seen.size() > 3 && largest_difference(measure, seen, later) < kShiftLeaves * difference)
      found.push_back(fmt::format("{}: each new row is that of the reference one row {}: are the times shifted by a sample?",
                                  measure.name, later > 0 ? "later" : "before"));
}

}  // namespace

std::vector<std::string> hints(std::span<const SeenPair> seen) {
  std::vector<std::string> found;
  for (const Measure& measure : trajectory_table().measures) {
    const double now = largest_difference(measure, seen, 0);
    if (measure.part == RowPart::error || !(now > 0) || tells_motion(measure)) continue;
    if (measure.kind == MeasureKind::number || measure.kind == MeasureKind::angle || measure.kind == MeasureKind::vector)
      look_for_ratio(measure, seen, found);
    else if (now >= kWorthAGuess)
      look_for_shift(measure, seen, now, found);
  }
  return found;
}

}  // namespace earthtop::compare
