// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/hints.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace earthtop::compare {
namespace {

using Attitude = std::array<double, 4>;

constexpr double kExplains = 1e-3;     // a mix-up explains a difference if undoing it leaves at most this part
constexpr double kWorthAGuess = 1e-6;  // rad: smaller differences are no mixed-up convention
constexpr double kSameRatio = 1e-6;    // relative scatter of numbers that have one ratio
constexpr double kKnownRatio = 1e-4;   // relative error of a known ratio; the ratios in the list differ by more

Attitude product(const Attitude& a, const Attitude& b) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(a[0], a[1], a[2], a[3]) * Eigen::Quaterniond(b[0], b[1], b[2], b[3]);
  return {q.w(), q.x(), q.y(), q.z()};
}

constexpr double kHalf = std::numbers::sqrt2 / 2;
constexpr Attitude kFromNed = {0, kHalf, kHalf, 0};   // from North, East, Down to East, North, Up
constexpr Attitude kForwardDown = {0, 1, 0, 0};       // turns axes y and z round
constexpr Attitude kXForward = {0.5, 0.5, 0.5, 0.5};  // x, y, z of the file are body axes 3, 1, 2

struct AttitudeMixUp {
  const char* what;
  Attitude (*undo)(const Attitude&);
};
constexpr AttitudeMixUp kAttitudeMixUps[] = {
    {"its quaternions are taken as world-to-body",
     [](const Attitude& q) {
       return Attitude{q[0], -q[1], -q[2], -q[3]};
     }},
    {"its quaternions are read with the scalar part last",
     [](const Attitude& q) {
       return Attitude{q[3], q[0], q[1], q[2]};
     }},
    {"its world axes are taken as North, East, Down", [](const Attitude& q) { return product(kFromNed, q); }},
    {"its world axes are taken as North, East, Down and its body axes 2 and 3 as reversed",
     [](const Attitude& q) { return product(product(kFromNed, q), kForwardDown); }},
    {"its body axes 2 and 3 are taken as reversed", [](const Attitude& q) { return product(q, kForwardDown); }},
    {"its body axes are taken as x-forward: x is the spin axis", [](const Attitude& q) { return product(q, kXForward); }},
    {"its world axes are taken as North, East, Down and its quaternions as world-to-body",
     [](const Attitude& q) {
       return product(kFromNed, Attitude{q[0], -q[1], -q[2], -q[3]});
     }},
};

struct AxisMixUp {
  const char* what;
  std::array<double, 3> (*undo)(const double*);
};
constexpr AxisMixUp kAxisMixUps[] = {
    {"its axes are taken as North, East, Down",
     [](const double* n) {
       return std::array{n[1], n[0], -n[2]};
     }},
    {"its axes are taken as North, West, Up",
     [](const double* n) {
       return std::array{-n[1], n[0], n[2]};
     }},
    {"the axis is reversed",
     [](const double* n) {
       return std::array{-n[0], -n[1], -n[2]};
     }},
};

/// The largest difference of a measure over the pairs, after `change` has been applied to the candidate's rows.
/// @param later  number of places by which the candidate's rows are shifted against those of the reference
double largest_difference(const Measure& measure, std::span<const SeenPair> seen, int later,
                          const std::function<void(Row&)>& change = nullptr) {
  double largest = 0;
  const auto count = static_cast<std::ptrdiff_t>(seen.size());
  for (std::ptrdiff_t i = std::max(0, -later); i < std::min(count, count - later); ++i) {
    Row candidate = seen[static_cast<std::size_t>(i)].candidate;
    const Row& reference = seen[static_cast<std::size_t>(i + later)].reference;
    if (presence(measure, candidate) != Presence::whole || presence(measure, reference) != Presence::whole) continue;
    if (change) change(candidate);
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
    if (seen.size() > 3 && largest_difference(measure, seen, later) < kExplains * difference)
      found.push_back(fmt::format("{}: each new row is that of the reference one row {}: are the times shifted by a sample?",
                                  measure.name, later > 0 ? "later" : "before"));
}

}  // namespace

std::vector<std::string> hints(std::span<const SeenPair> seen) {
  std::vector<std::string> found;
  for (const Measure& measure : trajectory_table().measures) {
    const double now = largest_difference(measure, seen, 0);
    if (measure.part == RowPart::error || !(now > 0)) continue;
    if (measure.kind == MeasureKind::number || measure.kind == MeasureKind::angle || measure.kind == MeasureKind::vector) {
      look_for_ratio(measure, seen, found);
      continue;
    }
    if (now < kWorthAGuess) continue;
    look_for_shift(measure, seen, now, found);
    if (measure.kind == MeasureKind::attitude)
      for (const AttitudeMixUp& mix_up : kAttitudeMixUps) {
        const double then = largest_difference(measure, seen, 0, [&](Row& row) {
          Attitude q;
          std::copy_n(row.value.begin() + static_cast<std::ptrdiff_t>(measure.column), 4, q.begin());
          q = mix_up.undo(q);
          std::copy_n(q.begin(), 4, row.value.begin() + static_cast<std::ptrdiff_t>(measure.column));
        });
        if (then < kExplains * now)
          found.push_back(fmt::format("{}: the new result agrees to {:.2g} rad if {}", measure.name, then, mix_up.what));
      }
    else
      for (const AxisMixUp& mix_up : kAxisMixUps) {
        const double then = largest_difference(measure, seen, 0, [&](Row& row) {
          const auto n = mix_up.undo(row.value.data() + measure.column);
          std::copy_n(n.begin(), 3, row.value.begin() + static_cast<std::ptrdiff_t>(measure.column));
        });
        if (then < kExplains * now)
          found.push_back(fmt::format("{}: the new result agrees to {:.2g} rad if {}", measure.name, then, mix_up.what));
      }
  }
  return found;
}

}  // namespace earthtop::compare
