// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/drift/trend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "earthtop/elementary.hpp"

namespace earthtop {
namespace {

/// Which swings a fit has besides the line: those at 1 to `precessions` times the precession, and those at 1 to `nutations` times
/// the nutation, alone and with up to `sums` times the precession added or taken away; of the nutations' first `growing` also
/// those that grow with time.
struct Swings {
  int precessions, nutations, sums, growing;
  double edge;            ///< part of the window over which the weights fall to zero at either end
  double edge_nutations;  ///< the same in periods of nutation, if that is shorter; 0: not asked for
};
constexpr std::array kFits{Swings{2, 1, 1, 1, 0.25, 8}, Swings{2, 1, 2, 1, 0.25, 8}, Swings{2, 2, 1, 2, 0.25, 8},
                           Swings{2, 3, 2, 3, 0.4, 0}};
/// The fits whose slopes tell the frequency of precession for the others.
constexpr std::array kRough{Swings{2, 0, 0, 0, 0.25, 0}, kFits[0]};

/// A swing, as an odd function of the time from the middle of the window.
struct Swing {
  double rate;  ///< rad/s
  bool grows;   ///< with time: time x cosine instead of a sine
  double size;  ///< expected, relative to the others
};

/// A function that rises from 0 to 1 between 0 and 1 and has all derivatives.
double smooth_step(double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double rising = real::exp(-1 / x), falling = real::exp(-1 / (1 - x));
  return rising / (rising + falling);
}

std::vector<Swing> swings_of(const Swings& fit, const TrendFrequencies& frequencies, double half_width) {
  constexpr double kDecay = 0.5;  // of the swings from one multiple of a frequency to the next
  constexpr double kGrowing = 0.1;
  std::vector<Swing> swings;
  const double p = frequencies.precession_rad_s, n = frequencies.nutation_rad_s;
  // The rates of change of the swings are taken to be alike, so that slow ones are larger.
  const auto add = [&](double rate, double size) {
    swings.push_back({rate, false, size / std::max(std::abs(rate) * half_width, 1.0)});
  };
  for (int k = 1; k <= fit.precessions; ++k) add(k * p, std::ldexp(1, 1 - k));
  for (int j = 1; j <= fit.nutations; ++j) {
    double decay = 1;
    for (int i = 1; i < j; ++i) decay *= kDecay;
    for (int k = -fit.sums; k <= fit.sums; ++k) add(j * n + k * p, std::abs(k) > 1 ? decay * kDecay : decay);
    if (j <= fit.growing) swings.push_back({j * n, true, decay * kDecay * kGrowing});
  }
  return swings;
}

/// Least squares by Householder's reflections; columns one after the other.
class LeastSquares {
 public:
  LeastSquares(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), a_(rows * (columns + 1)) {}
  double* column(std::size_t j) { return a_.data() + j * rows_; }
  double* right() { return column(columns_); }
  /// The last unknown.
  double last_unknown() {
    for (std::size_t j = 0; j < columns_; ++j) reflect(j);
    return right()[columns_ - 1] / column(columns_ - 1)[columns_ - 1];
  }

 private:
  void reflect(std::size_t j) {
    double* v = column(j);
    const double square = product(v, v, j);
    if (square == 0) return;
    const double head = v[j], diagonal = head > 0 ? -std::sqrt(square) : std::sqrt(square);
    v[j] = head - diagonal;
    const double scale = -1 / (diagonal * v[j]);  // 2 / |v|^2
    for (std::size_t k = j + 1; k <= columns_; ++k) {
      double* x = column(k);
      const double along = scale * product(v, x, j);
      for (std::size_t i = j; i < rows_; ++i) x[i] -= along * v[i];
    }
    v[j] = diagonal;
  }

  /// The scalar product of the rows from `first` on, by four sums, none of which waits for another.
  double product(const double* v, const double* x, std::size_t first) const {
    std::array<double, 4> sums{};
    std::size_t i = first;
    for (; i + sums.size() <= rows_; i += sums.size())
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += v[i + k] * x[i + k];
    for (; i < rows_; ++i) sums[0] += v[i] * x[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

  std::size_t rows_, columns_;
  std::vector<double> a_;
};

class WindowFit {
 public:
  WindowFit(std::span<const double> drift, double step, const TrendFrequencies& frequencies)
      : drift_(drift), step_(step), frequencies_(frequencies) {}

  /// The slope in the window of the samples `first` to `last`. About its middle the line is odd, so that only the odd part of
  /// everything is needed: half the differences of values as long before the middle as after it.
  double slope(const Swings& fit, std::size_t first, std::size_t last) const {
    const std::size_t intervals = last - first, pairs = (intervals + 1) / 2;
    const bool has_middle = intervals % 2 == 0;
    const double half = step_ * static_cast<double>(intervals) / 2;
    const double size = rate_size(first, last) * half;
    if (!(size > 0)) return 0;
    const std::vector<Swing> swings = swings_of(fit, frequencies_, half);
    const std::size_t columns = swings.size() + 1;
    LeastSquares squares(pairs + swings.size(), columns);
    const std::vector<double> weights = weights_of(fit, pairs, has_middle, half);
    const auto time = [&](std::size_t r) { return step_ * (static_cast<double>(r) + (has_middle ? 1.0 : 0.5)); };
    for (std::size_t j = 0; j < swings.size(); ++j) {
      double* column = squares.column(j);
      // Sine and cosine go on from row to row by a rotation.
      const double turn = swings[j].rate * step_, turn_cos = real::cos(turn), turn_sin = real::sin(turn);
      double c = real::cos(swings[j].rate * time(0)), s = real::sin(swings[j].rate * time(0));
      for (std::size_t r = 0; r < pairs; ++r) {
        column[r] = weights[r] * (swings[j].grows ? c * (time(r) / half) : s);
        const double next = c * turn_cos - s * turn_sin;
        s = s * turn_cos + c * turn_sin;
        c = next;
      }
      // A swing far larger than expected is held back; so swings that the window cannot tell apart stay small.
      column[pairs + j] = kHold * std::sqrt(static_cast<double>(pairs)) / swings[j].size;
    }
    double *line = squares.column(columns - 1), *right = squares.right();
    for (std::size_t r = 0; r < pairs; ++r) {
      const std::size_t after = last - (pairs - 1 - r), before = first + (pairs - 1 - r);
      line[r] = weights[r] * (time(r) / half);
      right[r] = weights[r] * ((drift_[after] - drift_[before]) / 2 / size);
    }
    return squares.last_unknown() * size / half;
  }

 private:
  static constexpr double kHold = 4.5e-8;

  /// The root of the mean square of the drift's rate.
  double rate_size(std::size_t first, std::size_t last) const {
    double largest = 0, sum = 0;
    for (std::size_t i = first; i < last; ++i) largest = std::max(largest, std::abs(drift_[i + 1] - drift_[i]));
    if (!(largest > 0)) return 0;
    for (std::size_t i = first; i < last; ++i) {
      const double change = (drift_[i + 1] - drift_[i]) / largest;  // the squares of tiny drifts would underflow
      sum += change * change;
    }
    return largest * std::sqrt(sum / static_cast<double>(last - first)) / step_;
  }
  std::vector<double> weights_of(const Swings& fit, std::size_t pairs, bool has_middle, double half) const {
    std::vector<double> weights(pairs, 1.0);
    double edge = fit.edge * 2 * half;
    if (fit.edge_nutations > 0 && frequencies_.nutation_rad_s > 0)
      edge = std::min(edge, fit.edge_nutations * 2 * std::numbers::pi / frequencies_.nutation_rad_s);
    if (!(edge > 0)) return weights;
    for (std::size_t r = 0; r < pairs; ++r) {
      const double t = step_ * (static_cast<double>(r) + (has_middle ? 1.0 : 0.5));
      weights[r] = std::sqrt(smooth_step((half - t) / edge));
    }
    return weights;
  }

  std::span<const double> drift_;
  double step_;
  TrendFrequencies frequencies_;
};

/// Every `factor`-th value of smooth means over `kWidth` times as many; a line stays the same line. Swings too fast for the thinned
/// values, which would look slow in them, shrink by exp(-2 sqrt(pi kWidth)) or more.
std::vector<double> thinned(std::span<const double> values, std::size_t factor) {
  constexpr std::size_t kWidth = 32;
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t k = 1; k < kWidth * factor; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(kWidth * factor);
    weights.push_back(real::exp(-1 / (x * (1 - x))));
    sum += weights.back();
  }
  std::vector<double> means;
  for (std::size_t first = 0; first + weights.size() <= values.size(); first += factor) {
    double mean = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) mean += weights[k] / sum * values[first + k];
    means.push_back(mean);
  }
  return means;
}

/// A window, as parts of the run.
struct Window {
  double begin, end;
};
constexpr Window kWhole{0, 1};
/// The windows whose slopes decide which fit is taken, and those whose slopes tell its error.
constexpr std::array kChoosing{Window{0, 0.75}, Window{0.25, 1}};
constexpr std::array kJudging{Window{0, 0.92}, Window{0.08, 1}, Window{0.04, 0.96}, Window{0, 0.96},
                              Window{0.04, 1}, Window{0, 0.85}, Window{0.15, 1},    Window{0.08, 0.92}};
// The numbers from here to `kOfEstimated` were found by counting over 1675 random tops, so that the bound contains the error in 94.5
// to 95 % of them and its median is small.
/// The bound over the scatter of the slopes, and the share that the next best fit has in the scatter.
constexpr double kSafety = 1.5, kOfNext = 0.05;
/// The windows of a fit that agrees far better than the next do so because it has the swings that matter; their scatter then
/// overstates the error, the more the better the fit. The bound is proportional to this power of the ratio of the two.
constexpr double kOfDistinction = 0.4;
/// Where precession is nearly as fast as nutation, swings of higher order are slow, and the windows agree on what is none of the trend.
constexpr double kOfNearness = 4, kNearest = 0.6;
/// By how much larger the bound is where the frequencies are estimates.
constexpr double kOfEstimated = 2;
/// Where the drift swings by hundredths of a radian, what is of higher order in it is no longer small beside what is fitted. Counted over
/// 1900 tops, half of them within five degrees of the vertical or on strings.
constexpr double kOfSwings = 40, kLargest = 0.1;
/// Rounding alone leaves this part of the largest drift in the fits.
constexpr double kRounding = 1e-9;

}  // namespace

TrendEstimate estimate_trend(std::span<const double> drift, double step_s, const TrendFrequencies& reference) {
  constexpr std::size_t kMost = 1200;
  if (drift.size() > kMost) {
    const std::size_t factor = drift.size() / kMost + 1;
    return estimate_trend(thinned(drift, factor), step_s * static_cast<double>(factor), reference);
  }
  const std::size_t last = drift.size() - 1;
  const double duration = step_s * static_cast<double>(last);
  // The swings have the frequency of the rotating top: that of the reference changed by the rate which is sought. A fit to swings
  // of a frequency that is off by a little is off by its square, so that two rough rates suffice.
  TrendFrequencies frequencies = reference;
  double rough = (drift[last] - drift[0]) / duration;
  for (const Swings& swings : kRough) {
    frequencies.precession_rad_s = reference.precession_rad_s - rough;
    rough = WindowFit(drift, step_s, frequencies).slope(swings, 0, last);
  }
  frequencies.precession_rad_s = reference.precession_rad_s - rough;
  const WindowFit fit(drift, step_s, frequencies);

  const auto slope_in = [&](const Swings& swings, const Window& window) {
    const auto at = [&](double part) { return static_cast<std::size_t>(std::lround(part * static_cast<double>(last))); };
    return fit.slope(swings, at(window.begin), at(window.end));
  };
  struct Fitted {
    const Swings* swings;
    double rate, apart;
  };
  std::vector<Fitted> fitted;
  for (const Swings& swings : kFits) {
    const double rate = slope_in(swings, kWhole);
    double apart = 0;
    for (const Window& window : kChoosing) apart = std::max(apart, std::abs(slope_in(swings, window) - rate));
    if (std::isfinite(rate) && std::isfinite(apart)) fitted.push_back({&swings, rate, apart});
  }
  if (fitted.size() < 2) return {(drift[last] - drift[0]) / duration, HUGE_VAL};
  std::ranges::stable_sort(fitted, {}, &Fitted::apart);
  const Fitted &best = fitted[0], &next = fitted[1];
  const double beside = kOfNext * (next.rate - best.rate);
  double squares = beside * beside;
  for (const Window& window : kJudging) {
    const double apart = slope_in(*best.swings, window) - best.rate;
    squares += apart * apart / kJudging.size();
  }
  double factor = kSafety;
  if (next.apart > 0) factor *= real::pow(best.apart / next.apart, kOfDistinction);
  const double nearness = std::min(std::abs(reference.precession_rad_s / reference.nutation_rad_s), kNearest);
  factor *= 1 + kOfNearness * nearness * nearness;
  if (!reference.exact) factor *= kOfEstimated;
  double largest = 0, least_rest = 0, most_rest = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const double value = drift[i] - drift[0], rest = value - best.rate * step_s * static_cast<double>(i);
    largest = std::max(largest, std::abs(value));
    least_rest = std::min(least_rest, rest), most_rest = std::max(most_rest, rest);
  }
  factor *= 1 + kOfSwings * std::min((most_rest - least_rest) / 2, kLargest);
  return {best.rate, factor * std::sqrt(squares) + kRounding * largest / duration};
}

}  // namespace earthtop
