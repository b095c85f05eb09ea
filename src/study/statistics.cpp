// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/statistics.hpp"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <algorithm>
#include <new>
#include <numbers>

#include "earthtop/real.hpp"
#include "error/gsl_errors.hpp"

namespace earthtop::study {

LineFit::LineFit() {
  const ReturnedGslErrors returned;
  workspace_.reset(allocated(gsl_multilarge_linear_alloc(gsl_multilarge_linear_tsqr, 2)));
  block_.reserve(kBlock);
}

void LineFit::include(double x, double y) {
  block_.push_back({x, y});
  ++points_;
  x_least_ = std::min(x_least_, x);
  x_most_ = std::max(x_most_, x);
  if (block_.size() == kBlock) flush();
}

void LineFit::flush() {
  if (block_.empty()) return;
  const ReturnedGslErrors returned;
  // The decomposition needs at least as many rows as columns; a row of zeros changes no sum of squares.
  const std::size_t rows = std::max<std::size_t>(block_.size(), 2);
  struct FreeMatrix {
    void operator()(gsl_matrix* m) const { gsl_matrix_free(m); }
  };
  struct FreeVector {
    void operator()(gsl_vector* v) const { gsl_vector_free(v); }
  };
  const std::unique_ptr<gsl_matrix, FreeMatrix> X(allocated(gsl_matrix_calloc(rows, 2)));
  const std::unique_ptr<gsl_vector, FreeVector> y(allocated(gsl_vector_calloc(rows)));
  for (std::size_t i = 0; i < block_.size(); ++i) {
    gsl_matrix_set(X.get(), i, 0, 1);
    gsl_matrix_set(X.get(), i, 1, block_[i][0]);
    gsl_vector_set(y.get(), i, block_[i][1]);
  }
  if (gsl_multilarge_linear_accumulate(X.get(), y.get(), workspace_.get()) == GSL_ENOMEM) throw std::bad_alloc();
  block_.clear();
}

std::optional<Line> LineFit::line() {
  flush();
  if (points_ < 2 || !(x_most_ > x_least_)) return std::nullopt;
  std::array<double, 2> solution{};
  const ReturnedGslErrors returned;
  gsl_vector_view c = gsl_vector_view_array(solution.data(), solution.size());
  double residual = 0, norm = 0;
  if (gsl_multilarge_linear_solve(0, &c.vector, &residual, &norm, workspace_.get()) == GSL_ENOMEM) throw std::bad_alloc();
  Line line{points_, solution[0], solution[1], {}, {}, {}};
  if (points_ == 2) return line;
  // The covariance is s^2 (R^T R)^-1, where R is the triangular factor.
  const gsl_matrix* R = gsl_multilarge_linear_matrix_ptr(workspace_.get());
  const double r00 = gsl_matrix_get(R, 0, 0), r01 = gsl_matrix_get(R, 0, 1), r11 = gsl_matrix_get(R, 1, 1);
  const double s = residual / std::sqrt(static_cast<double>(points_ - 2));
  line.residual_rms = residual / std::sqrt(static_cast<double>(points_));
  line.b_standard_error = s / std::abs(r11);
  line.a_standard_error = s * real::hypot(1 / r00, r01 / (r00 * r11));
  return line;
}

double jackknife_error(const std::vector<double>& without) {
  const auto n = static_cast<double>(without.size());
  double mean = 0, squares = 0, fourths = 0;
  for (const double x : without) mean += x / n;
  for (const double x : without) {
    const double square = (x - mean) * (x - mean);
    squares += square;
    fourths += square * square;
  }
  if (squares == 0) return 0;
  const double kurtosis = n * (fourths / squares) / squares;
  const double freedom = 2 * n / std::max(kurtosis - 1, 2.0);  // that of a normal distribution has 2 for the difference
  constexpr double kZ = 1.96, kZ3 = kZ * kZ * kZ, kZ5 = kZ3 * kZ * kZ;
  const double student = 1 + ((kZ3 + kZ) / (4 * freedom) + (5 * kZ5 + 16 * kZ3 + 3 * kZ) / (96 * freedom * freedom)) / kZ;
  return std::sqrt(squares * (n - 1) / n) * student;
}

void SobolSums::include(double f_A, double f_B, const std::vector<double>& f_ABi) {
  if (parts_.size() <= next_part_) {
    parts_.emplace_back();
    parts_.back().first.resize(inputs_);
    parts_.back().total.resize(inputs_);
  }
  Sums& part = parts_[next_part_];
  next_part_ = (next_part_ + 1) % kJackknifeParts;
  const double a = f_A - mean_, b = f_B - mean_;
  ++part.blocks;
  part.sum += a + b;
  part.squares += a * a + b * b;
  for (std::size_t i = 0; i < inputs_; ++i) {
    const double step = f_ABi[i] - f_A;
    part.first[i] += b * step;
    part.total[i] += step * step / 2;
  }
}

std::uint64_t SobolSums::blocks() const {
  std::uint64_t blocks = 0;
  for (const Sums& part : parts_) blocks += part.blocks;
  return blocks;
}

std::vector<SobolIndex> SobolSums::indices() const {
  if (blocks() < kFewestBasePoints) return {};
  const auto of = [](double n, double sum, double squares, double numerator) {
    const double mean = sum / (2 * n), variance = squares / (2 * n) - mean * mean;
    return numerator / n / variance;
  };
  std::vector<SobolIndex> list(inputs_);
  const auto count = static_cast<double>(blocks());
  double sum = 0, squares = 0;
  for (const Sums& part : parts_) sum += part.sum, squares += part.squares;
  for (std::size_t i = 0; i < inputs_; ++i) {
    double first = 0, total = 0;
    for (const Sums& part : parts_) first += part.first[i], total += part.total[i];
    std::vector<double> first_without, total_without;
    first_without.reserve(parts_.size());
    total_without.reserve(parts_.size());
    for (const Sums& part : parts_) {
      const double n = count - static_cast<double>(part.blocks);
      first_without.push_back(of(n, sum - part.sum, squares - part.squares, first - part.first[i]));
      total_without.push_back(of(n, sum - part.sum, squares - part.squares, total - part.total[i]));
    }
    list[i] = {of(count, sum, squares, first), jackknife_error(first_without), of(count, sum, squares, total),
               jackknife_error(total_without)};
    // Neither is finite where f does not vary, or varies in one part only.
    if (!std::isfinite(list[i].first_standard_error) || !std::isfinite(list[i].total_standard_error)) return {};
  }
  return list;
}

void DerivativeSums::include(double f, double derivative, double per_range) {
  if (parts_.size() <= next_part_) parts_.emplace_back();
  Sums& part = parts_[next_part_];
  next_part_ = (next_part_ + 1) % kJackknifeParts;
  const double y = f - mean_;
  part.points += 1;
  part.sum += y;
  part.squares += y * y;
  part.derivative_squares += derivative * derivative;
  part.per_range_squares += per_range * per_range;
}

std::optional<DerivativeIndex> DerivativeSums::index() const {
  Sums all;
  for (const Sums& part : parts_) {
    all.points += part.points;
    all.sum += part.sum;
    all.squares += part.squares;
    all.derivative_squares += part.derivative_squares;
    all.per_range_squares += part.per_range_squares;
  }
  if (all.points < 2) return std::nullopt;
  const auto bound = [](const Sums& s) {
    const double mean = s.sum / s.points, variance = s.squares / s.points - mean * mean;
    return s.per_range_squares / s.points / variance / (std::numbers::pi * std::numbers::pi);
  };
  DerivativeIndex index{static_cast<std::uint64_t>(all.points), all.derivative_squares / all.points, 0, bound(all), 0};
  std::vector<double> squares_without, bound_without;
  for (const Sums& part : parts_) {
    const Sums rest{all.points - part.points, all.sum - part.sum, all.squares - part.squares,
                    all.derivative_squares - part.derivative_squares, all.per_range_squares - part.per_range_squares};
    squares_without.push_back(rest.derivative_squares / rest.points);
    bound_without.push_back(bound(rest));
  }
  index.mean_square_standard_error = jackknife_error(squares_without);
  index.total_bound_standard_error = jackknife_error(bound_without);
  if (!std::isfinite(index.total_bound) || !std::isfinite(index.total_bound_standard_error)) return std::nullopt;
  return index;
}

}  // namespace earthtop::study
