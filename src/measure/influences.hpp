// SPDX-License-Identifier: GPL-3.0-or-later
/// The information of rows of data on a few parameters: the singular values of the residuals' derivatives.
#pragma once

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace earthtop::measure {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The singular values of the derivatives, each column divided by its length.
class Influences {
 public:
  /// @param J  derivatives of normalised residuals (rows, at least as many as columns) by parameters   @param f  residuals
  Influences(const gsl_matrix* J, const gsl_vector* f);
  /// The same without residuals.
  static Influences of(const RowMajor& J);

  double chi_squared() const { return chi_squared_; }
  /// The size of the next full step in standard errors: the root of the amount by which that step, in the linear approximation,
  /// would lessen the sum of squares.
  double next_step() const { return next_step_; }

  /// A direction in the space of parameters is not determined if its influence is less than this part of the largest one's, with
  /// each single parameter's influence scaled to 1. It is ten times the uncertainty of the differences that are the derivatives.
  static constexpr double kLeast = 1e-5;

  /// Whether the data determine every parameter.
  bool determine_all(double least = kLeast) const;
  /// The parameters that take part in the direction which the data determine least.
  std::vector<std::size_t> least_determined() const;
  /// The components of that direction, for a change of each parameter in the unit of its column.
  Eigen::VectorXd least_determined_direction() const;
  /// The covariance of the parameters, (J^T J)^-1: the Cramer-Rao bound. Only where all are determined.
  Eigen::MatrixXd covariance() const;

 private:
  struct FreeMatrix {
    void operator()(gsl_matrix* matrix) const { gsl_matrix_free(matrix); }
  };
  struct FreeVector {
    void operator()(gsl_vector* vector) const { gsl_vector_free(vector); }
  };

  Eigen::VectorXd lengths_;
  std::unique_ptr<gsl_matrix, FreeMatrix> V_;
  std::unique_ptr<gsl_vector, FreeVector> S_;
  bool has_all_ = false;
  double next_step_ = 0, chi_squared_ = 0;
};

}  // namespace earthtop::measure
