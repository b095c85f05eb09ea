// SPDX-License-Identifier: GPL-3.0-or-later
/// Statistics of a table's points, gathered in one pass: moments, straight lines, Sobol indices.
#pragma once

#include <gsl/gsl_multilarge.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace earthtop::study {

/// Count, mean, spread and extremes (Welford's update).
struct Moments {
  std::uint64_t count = 0;
  double mean = 0, squares = 0;  ///< squares: sum of (x - mean)^2
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();

  void include(double x) {
    ++count;
    const double step = x - mean;
    mean += step / static_cast<double>(count);
    squares += step * (x - mean);
    least = std::min(least, x);
    most = std::max(most, x);
  }
  std::optional<double> standard_deviation() const {
    if (count < 2) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(count - 1));
  }
};

/// y = a + b x, with standard errors estimated from the scatter about the line.
struct Line {
  std::uint64_t points = 0;
  double a = 0, b = 0;
  std::optional<double> a_standard_error, b_standard_error, residual_rms;  ///< none for two points
};

/// Least squares for points that are passed one after the other (GSL's sequential QR decomposition).
class LineFit {
 public:
  LineFit();
  void include(double x, double y);
  /// The fitted line; nothing if there are fewer than two points, or if all have the same x.
  std::optional<Line> line();

 private:
  static constexpr std::size_t kBlock = 256;
  void flush();
  struct Free {
    void operator()(gsl_multilarge_linear_workspace* w) const { gsl_multilarge_linear_free(w); }
  };
  std::unique_ptr<gsl_multilarge_linear_workspace, Free> workspace_;
  std::vector<std::array<double, 2>> block_;
  std::uint64_t points_ = 0;
  double x_least_ = std::numeric_limits<double>::infinity(), x_most_ = -std::numeric_limits<double>::infinity();
};

/// The standard error of a mean or of a smooth function of means, from the values that it takes with each part of the data left
/// out (jackknife; Efron and Stein, Ann. Statist. 9 (1981) 586). Where few parts carry most of it, it is itself known to few
/// degrees of freedom (Satterthwaite, from the fourth moment). It is widened so that two of it hold 95 % of the errors, as for many
/// of them: by Student's quantile (Abramowitz and Stegun 26.7.5).
/// @param without  at least two values, one for each part
double jackknife_error(const std::vector<double>& without);

/// First- and total-order index of one input.
struct SobolIndex {
  double first = 0, first_standard_error = 0;
  double total = 0, total_standard_error = 0;
};

/// The fewest base points from which Sobol indices are computed.
inline constexpr std::uint64_t kFewestBasePoints = 32;

/// The parts of the data that are left out, one after the other, for standard errors: many, so that the error of an error is small.
inline constexpr std::size_t kJackknifeParts = 256;

/// Sums for Sobol indices over blocks of values: f(A), f(B), and for each input f(A with that input's column taken from B).
/// First order: A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, table 2 (b). Total order: M. Jansen, Comput. Phys.
/// Commun. 117 (1999) 35. Standard errors are those of independent base points; those of a Sobol sequence err less.
class SobolSums {
 public:
  /// @param mean approximate mean of f. It is subtracted, because in products of large numbers small differences would be lost.
  SobolSums(std::size_t inputs, double mean) : inputs_(inputs), mean_(mean) {}
  /// @param f_ABi one value for each input
  void include(double f_A, double f_B, const std::vector<double>& f_ABi);
  std::uint64_t blocks() const;
  /// One index for each input; empty if f does not vary, or if there are fewer than `kFewestBasePoints` blocks.
  std::vector<SobolIndex> indices() const;

 private:
  struct Sums {
    std::uint64_t blocks = 0;
    double sum = 0, squares = 0;       // sums of f(A) + f(B) and of their squares, mean subtracted
    std::vector<double> first, total;  // sums of f_B (f_ABi - f_A) and of (f_A - f_ABi)^2 / 2
  };
  std::size_t inputs_;
  double mean_;
  std::vector<Sums> parts_;
  std::size_t next_part_ = 0;
};

/// The derivative-based index of one input and the bound that it sets on the total index.
struct DerivativeIndex {
  std::uint64_t points = 0;
  double mean_square = 0, mean_square_standard_error = 0;  ///< of the derivative
  double total_bound = 0, total_bound_standard_error = 0;
};

/// Sums for a derivative-based index: of f, and of its derivative by an input that is uniform over a range, at points of the design.
/// The total index is at most (range / pi)^2 mean(derivative^2) / variance(f): I. M. Sobol and S. Kucherenko, Math. Comput. Simul. 79
/// (2009) 3009, theorem 2.
class DerivativeSums {
 public:
  /// @param mean  approximate mean of f, as for SobolSums
  explicit DerivativeSums(double mean) : mean_(mean) {}
  /// @param derivative  of f by the input   @param per_range  of f by the input's place in its range, which goes from 0 to 1
  void include(double f, double derivative, double per_range);
  /// Nothing if there are fewer than two points, or if f does not vary.
  std::optional<DerivativeIndex> index() const;

 private:
  struct Sums {
    double points = 0, sum = 0, squares = 0, derivative_squares = 0, per_range_squares = 0;
  };
  double mean_;
  std::vector<Sums> parts_;
  std::size_t next_part_ = 0;
};

}  // namespace earthtop::study
