// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/seen_directions.hpp"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "error/gsl_errors.hpp"
#include "measure/influences.hpp"

namespace earthtop::measure {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A parameter takes part in an unseen direction if its component is above this, which is a hundred times the error of the
/// derivatives of strong influences: what is neglected, and the error of what is not, are below a hundredth of the direction's
/// effect on it.
constexpr double kLeastPart = 1e-6;

/// An orthonormal basis of the same space as the given one's columns, without the small components that errors of the derivatives
/// make: Gauss's elimination leaves each direction with as few components as it can have.
MatrixXd cleaned(MatrixXd basis) {
  std::vector<bool> is_taken(static_cast<std::size_t>(basis.rows()), false);
  for (Index c = 0; c < basis.cols(); ++c) {
    Index pivot = -1;
    for (Index i = 0; i < basis.rows(); ++i)
      if (!is_taken[static_cast<std::size_t>(i)] && (pivot < 0 || std::abs(basis(i, c)) > std::abs(basis(pivot, c)))) pivot = i;
    is_taken[static_cast<std::size_t>(pivot)] = true;
    basis.col(c) /= basis(pivot, c);
    for (Index other = 0; other < basis.cols(); ++other)
      if (other != c) basis.col(other) -= (basis(pivot, other) * basis.col(c)).eval();
  }
  basis = (basis.array().abs() > kLeastPart).select(basis, 0);
  // Each column is 1 where all others are 0, so that the Gram-Schmidt process loses no digits.
  for (Index c = 0; c < basis.cols(); ++c) {
    for (Index before = 0; before < c; ++before)
      basis.col(c) -= (basis.col(before).dot(basis.col(c)) * basis.col(before)).eval();
    basis.col(c).normalize();
  }
  return basis;
}

}  // namespace

MatrixXd SeenDirections::seen_part(MatrixXd J) const {
  if (unseen.cols() == 0) return J;
  for (Index j = 0; j < J.cols(); ++j)
    if (lengths[j] > 0) J.col(j) /= lengths[j];
  J -= ((J * unseen).eval() * unseen.transpose()).eval();
  return J * lengths.asDiagonal();
}

SeenDirections seen_directions(const MatrixXd& J) {
  const ReturnedGslErrors returned;
  const Index parameters = J.cols();
  SeenDirections found;
  found.lengths = J.colwise().norm();
  RowMajor unit = RowMajor::Zero(std::max(J.rows(), parameters), parameters), V(parameters, parameters);
  unit.topRows(J.rows()) = J;
  for (Index j = 0; j < parameters; ++j)
    if (found.lengths[j] > 0) unit.col(j) /= found.lengths[j];
  VectorXd singular(parameters);  // in descending order
  const auto n = static_cast<std::size_t>(parameters);
  gsl_matrix_view of_unit = gsl_matrix_view_array(unit.data(), static_cast<std::size_t>(unit.rows()), n);
  gsl_matrix_view of_V = gsl_matrix_view_array(V.data(), n, n);
  gsl_vector_view of_singular = gsl_vector_view_array(singular.data(), n);
  gsl_linalg_SV_decomp_jacobi(&of_unit.matrix, &of_V.matrix, &of_singular.vector);
  Index seen = 0;
  while (seen < parameters && singular[seen] > Influences::kLeast * singular[0]) ++seen;
  MatrixXd rows = singular.head(seen).asDiagonal() * V.leftCols(seen).transpose();
  if (seen < parameters) {
    found.unseen = cleaned(V.rightCols(parameters - seen));
    rows -= ((rows * found.unseen).eval() * found.unseen.transpose()).eval();
  }
  found.rows = rows * found.lengths.asDiagonal();
  return found;
}

}  // namespace earthtop::measure
