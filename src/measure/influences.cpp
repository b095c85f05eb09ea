// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/influences.hpp"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>

#include <cmath>

#include "error/gsl_errors.hpp"

namespace earthtop::measure {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

Influences::Influences(const gsl_matrix* J, const gsl_vector* f)
    : lengths_(static_cast<Index>(J->size2)),
      V_(allocated(gsl_matrix_alloc(J->size2, J->size2))),
      S_(allocated(gsl_vector_alloc(J->size2))) {
  const std::unique_ptr<gsl_matrix, FreeMatrix> U(allocated(gsl_matrix_alloc(J->size1, J->size2)));
  gsl_matrix_memcpy(U.get(), J);
  for (std::size_t j = 0; j < J->size2; ++j) {
    gsl_vector_view column = gsl_matrix_column(U.get(), j);
    const double length = gsl_blas_dnrm2(&column.vector);
    lengths_[static_cast<Index>(j)] = length;
    if (length > 0) gsl_vector_scale(&column.vector, 1 / length);
  }
  gsl_blas_ddot(f, f, &chi_squared_);
  has_all_ = lengths_.minCoeff() > 0 && lengths_.allFinite();
  if (!has_all_) return;
  gsl_linalg_SV_decomp_jacobi(U.get(), V_.get(), S_.get());
  const std::unique_ptr<gsl_vector, FreeVector> projected(allocated(gsl_vector_alloc(J->size2)));
  gsl_blas_dgemv(CblasTrans, 1, U.get(), f, 0, projected.get());
  next_step_ = gsl_blas_dnrm2(projected.get());
}

Influences Influences::of(const RowMajor& J) {
  const std::vector<double> zero(static_cast<std::size_t>(J.rows()), 0);
  const gsl_matrix_const_view matrix =
      gsl_matrix_const_view_array(J.data(), static_cast<std::size_t>(J.rows()), static_cast<std::size_t>(J.cols()));
  const gsl_vector_const_view none = gsl_vector_const_view_array(zero.data(), zero.size());
  return {&matrix.matrix, &none.vector};
}

bool Influences::determine_all(double least) const {
  return has_all_ && gsl_vector_get(S_.get(), S_->size - 1) > least * gsl_vector_get(S_.get(), 0);
}

std::vector<std::size_t> Influences::least_determined() const {
  std::vector<std::size_t> parameters;
  const std::size_t p = S_->size;
  for (std::size_t j = 0; j < p; ++j)
    if (has_all_ ? std::abs(gsl_matrix_get(V_.get(), j, p - 1)) > 0.1 : !(lengths_[static_cast<Index>(j)] > 0))
      parameters.push_back(j);
  return parameters;
}

VectorXd Influences::least_determined_direction() const {
  const auto p = static_cast<Index>(S_->size);
  VectorXd direction = VectorXd::Zero(p);
  for (Index j = 0; j < p; ++j) {
    if (!has_all_)
      direction[j] = lengths_[j] > 0 ? 0 : 1;
    else
      direction[j] = gsl_matrix_get(V_.get(), static_cast<std::size_t>(j), static_cast<std::size_t>(p - 1)) / lengths_[j];
  }
  return direction;
}

MatrixXd Influences::covariance() const {
  const auto p = static_cast<Index>(S_->size);
  MatrixXd half(p, p);
  for (Index i = 0; i < p; ++i)
    for (Index j = 0; j < p; ++j) {
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      half(i, j) = gsl_matrix_get(V_.get(), row, column) / gsl_vector_get(S_.get(), column) / lengths_[i];
    }
  return half * half.transpose();
}

}  // namespace earthtop::measure
