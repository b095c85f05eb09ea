#include "compare/weighted_fit.hpp"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_vector.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <new>

#include "compare/scaled_problem.hpp"
#include "error/gsl_errors.hpp"

namespace earthtop::compare {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 100;
constexpr double kConverged = 1e-3;  // of the standard errors, scaled ones where the scatter is larger than stated
/// Directions of the parameters whose influence is less than this of the largest one's, each parameter's influence taken for 1:
/// ten times what the differences are uncertain by.
constexpr double kLeastInfluence = 1e-5;
/// Where there is no prediction, the sum of squares is so much larger than at the last place that the step is taken back.
constexpr double kNoPrediction = 1e3;

/// What C's callbacks need; an exception waits here until GSL has returned.
struct Callbacks {
  ScaledProblem* problem;
  std::exception_ptr thrown;
  double worst_norm = 0;      // of residuals so far
  bool all_predicted = true;  // of the last iteration's trials
};

std::vector<double> values_of(const gsl_vector* vector) {
  std::vector<double> values(vector->size);
  for (std::size_t i = 0; i < vector->size; ++i) values[i] = gsl_vector_get(vector, i);
  return values;
}

int evaluate_residuals(const gsl_vector* u, void* data, gsl_vector* f) {
  auto& callbacks = *static_cast<Callbacks*>(data);
  try {
    VectorXd values;
    const bool predicted = callbacks.problem->evaluate(values_of(u), values);
    callbacks.all_predicted = callbacks.all_predicted && predicted;
    if (predicted) callbacks.worst_norm = std::max(callbacks.worst_norm, values.norm());
    for (std::size_t i = 0; i < f->size; ++i)
      gsl_vector_set(f, i, predicted ? values[static_cast<Index>(i)] : kNoPrediction * (1 + callbacks.worst_norm));
    return GSL_SUCCESS;
  } catch (...) {
    callbacks.thrown = std::current_exception();
    return GSL_EBADFUNC;
  }
}

int evaluate_jacobian(const gsl_vector* u, void* data, gsl_matrix* J) {
  auto& callbacks = *static_cast<Callbacks*>(data);
  try {
    MatrixXd values;
    if (!callbacks.problem->jacobian(values_of(u), values)) return GSL_EBADFUNC;
    for (std::size_t i = 0; i < J->size1; ++i)
      for (std::size_t j = 0; j < J->size2; ++j) gsl_matrix_set(J, i, j, values(static_cast<Index>(i), static_cast<Index>(j)));
    return GSL_SUCCESS;
  } catch (...) {
    callbacks.thrown = std::current_exception();
    return GSL_EBADFUNC;
  }
}

/// Normal equations by way of their triangular factor, each column of the derivatives divided by its length.
struct Normal {
  Normal(const gsl_matrix* J, const gsl_vector* f) {
    const auto n = static_cast<Index>(J->size1), p = static_cast<Index>(J->size2);
    MatrixXd scaled(n, p);
    VectorXd values(n);
    for (Index i = 0; i < n; ++i) {
      values[i] = gsl_vector_get(f, static_cast<std::size_t>(i));
      for (Index j = 0; j < p; ++j) scaled(i, j) = gsl_matrix_get(J, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    }
    lengths = scaled.colwise().norm().transpose();
    has_all_influences = lengths.minCoeff() > 0 && lengths.allFinite();
    if (!has_all_influences) return;
    scaled.array().rowwise() /= lengths.transpose().array();
    const Eigen::HouseholderQR<MatrixXd> qr(scaled);
    const MatrixXd R = qr.matrixQR().topRows(p).triangularView<Eigen::Upper>();
    const VectorXd projected = qr.householderQ().transpose() * values;
    next_step = projected.head(p).norm();
    svd.compute(R, Eigen::ComputeFullV);
    chi_squared = values.squaredNorm();
  }

  bool is_determined() const {
    return has_all_influences && svd.singularValues().minCoeff() > kLeastInfluence * svd.singularValues().maxCoeff();
  }
  /// The parameters in the direction that the data tell least of.
  std::vector<std::size_t> least_told() const {
    std::vector<std::size_t> parameters;
    const Index p = lengths.size();
    for (Index j = 0; j < p; ++j)
      if (has_all_influences ? std::abs(svd.matrixV()(j, p - 1)) > 0.1 : !(lengths[j] > 0))
        parameters.push_back(static_cast<std::size_t>(j));
    return parameters;
  }
  MatrixXd covariance() const {
    const MatrixXd half = svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal();
    const VectorXd inverse = lengths.cwiseInverse();
    return inverse.asDiagonal() * (half * half.transpose()) * inverse.asDiagonal();
  }

  VectorXd lengths;
  bool has_all_influences = false;
  double next_step = 0;  // what it would take of the sum of squares, as a root: in standard errors
  double chi_squared = 0;
  Eigen::JacobiSVD<MatrixXd> svd;
};

std::string why_not_converged(bool no_progress, bool all_predicted) {
  if (!no_progress) return "the sum of squares still falls";
  return all_predicted
             ? "no step lessens the sum of squares, which is not least in first order either"
             : "the sum of squares falls towards values without a prediction: beyond a number's range, or without such a "
               "motion";
}

Fit fit_scaled(const FitProblem& given, ScaledProblem& problem) {
  Fit fit;
  const std::size_t n = problem.residuals(), p = problem.parameters();
  std::vector<double> u(p, 1);
  for (std::size_t j = 0; j < p; ++j) {
    const auto found = problem.find_step(u, j);
    if (found == ScaledProblem::StepFound::no_influence) fit.undetermined.push_back(j);
    if (found == ScaledProblem::StepFound::no_prediction) {
      fit.outcome = FitOutcome::prediction_failed;
      fit.reason = "beside the start there is no prediction";
      return fit;
    }
  }
  if (!fit.undetermined.empty()) {
    fit.outcome = FitOutcome::not_determined;
    return fit;
  }

  const gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)> workspace(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p), gsl_multifit_nlinear_free);
  if (!workspace) throw std::bad_alloc();
  Callbacks callbacks{&problem, nullptr, 0, true};
  gsl_multifit_nlinear_fdf functions{};
  functions.f = evaluate_residuals;
  functions.df = evaluate_jacobian;
  functions.n = n;
  functions.p = p;
  functions.params = &callbacks;
  const gsl_vector_const_view start = gsl_vector_const_view_array(u.data(), p);
  int status = gsl_multifit_nlinear_init(&start.vector, &functions, workspace.get());
  for (;; ++fit.iterations) {
    if (callbacks.thrown) std::rethrow_exception(callbacks.thrown);
    if (status != GSL_SUCCESS && status != GSL_ENOPROG) {
      fit.outcome = FitOutcome::prediction_failed;
      fit.reason = "on the way to the least sum of squares there is no prediction";
      return fit;
    }
    const Normal normal(workspace->J, workspace->f);
    if (!normal.is_determined()) {
      fit.outcome = FitOutcome::not_determined;
      fit.undetermined = normal.least_told();
      return fit;
    }
    const double scatter = n > p ? std::max(1.0, normal.chi_squared / static_cast<double>(n - p)) : 1.0;
    if (normal.next_step <= kConverged * std::sqrt(scatter)) {
      fit.outcome = FitOutcome::converged;
      fit.parameters = problem.unscaled(values_of(workspace->x));
      const Eigen::Map<const VectorXd> scales(given.scales.data(), static_cast<Index>(p));
      const MatrixXd covariance = scales.asDiagonal() * normal.covariance() * scales.asDiagonal();
      fit.covariance = (covariance + covariance.transpose()) / 2;  // to the last bit
      return fit;
    }
    if (status == GSL_ENOPROG || fit.iterations == kMostIterations) {
      fit.reason = why_not_converged(status == GSL_ENOPROG, callbacks.all_predicted);
      return fit;
    }
    callbacks.all_predicted = true;
    status = gsl_multifit_nlinear_iterate(workspace.get());
  }
}

}  // namespace

Fit fit_weighted(const FitProblem& problem) {
  const ReturnedGslErrors returned;
  ScaledProblem scaled(problem);
  try {
    return fit_scaled(problem, scaled);
  } catch (const ScaledProblem::Stopped&) {
    Fit fit;
    fit.outcome = FitOutcome::interrupted;
    return fit;
  }
}

}  // namespace earthtop::compare
