// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/statistics.hpp"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <algorithm>
#include <new>

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

void SobolSums::include(double f_A, double f_B, const std::vector<double>& f_ABi) {
  Sums& group = groups_[next_group_];
  next_group_ = (next_group_ + 1) % kGroups;
  const double a = f_A - mean_, b = f_B - mean_;
  ++group.blocks;
  group.sum += a + b;
  group.squares += a * a + b * b;
  for (std::size_t i = 0; i < inputs_; ++i) {
    const double step = f_ABi[i] - f_A;
    group.first[i] += b * step;
    group.total[i] += step * step / 2;
  }
}

std::uint64_t SobolSums::blocks() const {
  std::uint64_t blocks = 0;
  for (const Sums& group : groups_) blocks += group.blocks;
  return blocks;
}

std::vector<SobolIndex> SobolSums::indices() const {
  if (blocks() < 2 * kGroups) return {};
  constexpr std::size_t kNone = kGroups;
  struct Estimate {
    double first, total;
  };
  const auto estimate = [&](std::size_t input, std::size_t left_out) {
    double n = 0, sum = 0, squares = 0, first = 0, total = 0;
    for (std::size_t g = 0; g < kGroups; ++g) {
      if (g == left_out) continue;
      n += static_cast<double>(groups_[g].blocks);
      sum += groups_[g].sum;
      squares += groups_[g].squares;
      first += groups_[g].first[input];
      total += groups_[g].total[input];
    }
    const double mean = sum / (2 * n), variance = squares / (2 * n) - mean * mean;
    return Estimate{first / n / variance, total / n / variance};
  };
  std::vector<SobolIndex> list(inputs_);
  for (std::size_t i = 0; i < inputs_; ++i) {
    const Estimate whole = estimate(i, kNone);
    if (!std::isfinite(whole.first) || !std::isfinite(whole.total)) return {};
    double first_mean = 0, total_mean = 0, first_squares = 0, total_squares = 0;
    std::array<Estimate, kGroups> part{};
    for (std::size_t g = 0; g < kGroups; ++g) {
      part[g] = estimate(i, g);
      first_mean += part[g].first / kGroups;
      total_mean += part[g].total / kGroups;
    }
    for (const Estimate& p : part) {
      first_squares += (p.first - first_mean) * (p.first - first_mean);
      total_squares += (p.total - total_mean) * (p.total - total_mean);
    }
    constexpr double kJackknife = (kGroups - 1.0) / kGroups;
    list[i] = {whole.first, std::sqrt(kJackknife * first_squares), whole.total, std::sqrt(kJackknife * total_squares)};
  }
  return list;
}

}  // namespace earthtop::study
