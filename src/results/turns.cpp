// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/turns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace earthtop {
namespace {

constexpr std::size_t kNodes = 9;  // of the polynomial: with twelve points a period its error is 3e-7 of the swing
/// A value that the polynomial cannot tell from zero, as a share of the largest of its nodes.
constexpr double kLeast = 1e-6;

/// The values at which Lagrange's polynomial through points at 0, 1, 2, ... weighs them.
std::array<double, kNodes> weights_at(double place) {
  constexpr std::array<double, kNodes> kScales{1.0 / 40320, -1.0 / 5040, 1.0 / 1440,  -1.0 / 720, 1.0 / 576,
                                               -1.0 / 720,  1.0 / 1440,  -1.0 / 5040, 1.0 / 40320};
  std::array<double, kNodes> weights = kScales;
  double before = 1;
  for (std::size_t k = 0; k < kNodes; ++k) weights[k] *= before, before *= place - static_cast<double>(k);
  double after = 1;
  for (std::size_t k = kNodes; k-- > 0;) weights[k] *= after, after *= place - static_cast<double>(k);
  return weights;
}

/// The line's value, or the square of its length, between its points.
class Between {
 public:
  Between(const std::vector<double>& values, std::span<const std::vector<double>> parts, std::size_t begin)
      : values_(values), parts_(parts), begin_(begin) {}
  double operator()(double place) const {
    const std::array<double, kNodes> weights = weights_at(place);
    if (parts_.empty()) return sum(weights, values_);
    double squared = 0;
    for (const std::vector<double>& part : parts_) {
      const double component = sum(weights, part);
      squared += component * component;
    }
    return squared;
  }

 private:
  double sum(const std::array<double, kNodes>& weights, const std::vector<double>& list) const {
    double total = 0;
    for (std::size_t k = 0; k < kNodes; ++k) total += weights[k] * list[begin_ + k];
    return total;
  }
  const std::vector<double>& values_;
  std::span<const std::vector<double>> parts_;
  std::size_t begin_;
};

/// The first of the nodes around a point: those at equal steps that lie most evenly about it. None where there are too few.
std::optional<std::size_t> nodes_around(const std::vector<double>& x, const std::vector<double>& y, std::size_t point) {
  constexpr double kEqual = 0.01;  // of a step
  const double step = x[point + 1] - x[point];
  const std::size_t count = std::min(x.size(), y.size());
  for (const std::size_t before : {4U, 3U, 5U, 2U, 6U, 1U, 7U}) {
    if (before > point || point - before + kNodes > count) continue;
    const std::size_t begin = point - before;
    bool fits = true;
    for (std::size_t k = begin; k + 1 < begin + kNodes && fits; ++k)
      fits = std::abs(x[k + 1] - x[k] - step) < kEqual * step && std::isfinite(y[k]) && std::isfinite(y[k + 1]);
    if (fits) return begin;
  }
  return std::nullopt;
}

}  // namespace

void move_to_turns(std::vector<double>& moved_x, std::vector<double>& moved_y, std::span<const std::vector<double>> parts) {
  const std::size_t count = std::min(moved_x.size(), moved_y.size());
  const std::vector<double> x = moved_x, y = moved_y;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const bool is_most = y[i] > y[i - 1] && y[i] >= y[i + 1], is_least = y[i] < y[i - 1] && y[i] <= y[i + 1];
    if (!is_most && !is_least) continue;
    const auto begin = nodes_around(x, y, i);
    if (!begin) continue;
    const Between between(y, parts, *begin);
    const auto middle = static_cast<double>(i - *begin);
    double place = middle;
    // Parabolas through ever nearer points.
    for (const double apart : {1.0, 0.25, 0.03}) {
      const double before = between(place - apart), here = between(place), after = between(place + apart);
      const double curvature = (before - here) + (after - here);
      if ((curvature > 0) != is_least || curvature == 0) break;
      place += apart * std::clamp((before - after) / (2 * curvature), -1.0, 1.0);
      place = std::clamp(place, middle - 1, middle + 1);
    }
    const double value = between(place);
    double turned = value;
    if (!parts.empty()) {
      const double at = between(middle);
      if (!(at > 0)) continue;
      turned = std::max(y[i] * std::sqrt(value / at), kLeast * std::max(y[*begin], y[*begin + kNodes - 1]));
    }
    // The curve never shows less of a swing than its points do.
    if (!(is_most ? turned >= y[i] : turned <= y[i])) continue;
    moved_x[i] = x[i] + (place - middle) * (x[i + 1] - x[i]);
    moved_y[i] = turned;
  }
}

}  // namespace earthtop
