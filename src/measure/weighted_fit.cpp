// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/weighted_fit.hpp"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_vector.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <utility>

#include "error/gsl_errors.hpp"
#include "measure/influences.hpp"
#include "measure/scaled_problem.hpp"
#include "measure/seen_directions.hpp"

namespace earthtop::measure {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The largest next step of a fit that has converged, in standard errors, and the largest number of iterations.
constexpr double kConverged = 1e-3, kRoughlyConverged = 0.1;
constexpr double kRipple = 0.05;  // of the next step where no step goes lower
constexpr int kMostIterations = 100, kMostRoughIterations = 30;
/// Where there is no prediction, the residuals are made this much larger than any so far, so that GSL takes the step back.
constexpr double kNoPrediction = 1e3;

/// The data of the callbacks that GSL, a C library, calls. An exception may not pass through C: it waits here until GSL has
/// returned.
struct Callbacks {
  ScaledProblem* problem;
  std::exception_ptr thrown;
  double worst_norm = 0;                       // largest norm of the residuals so far
  bool all_predicted = true;                   // whether all trials of the last iteration had a prediction
  std::vector<std::size_t> without_influence;  // parameters that only priors know
  Index priors = 0;                            // their number: the last rows
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

/// Directions that the data do not determine are left to the priors.
void leave_to_priors(MatrixXd& J, const Callbacks& callbacks) {
  auto data = J.topRows(J.rows() - callbacks.priors);
  for (const std::size_t j : callbacks.without_influence) data.col(static_cast<Index>(j)).setZero();
  data = seen_directions(data).seen_part(data);
}

int evaluate_jacobian(const gsl_vector* u, void* data, gsl_matrix* J) {
  auto& callbacks = *static_cast<Callbacks*>(data);
  try {
    MatrixXd values;
    if (!callbacks.problem->jacobian(values_of(u), values)) return GSL_EBADFUNC;
    if (callbacks.priors > 0) leave_to_priors(values, callbacks);
    for (std::size_t i = 0; i < J->size1; ++i)
      for (std::size_t j = 0; j < J->size2; ++j) gsl_matrix_set(J, i, j, values(static_cast<Index>(i), static_cast<Index>(j)));
    return GSL_SUCCESS;
  } catch (...) {
    callbacks.thrown = std::current_exception();
    return GSL_EBADFUNC;
  }
}

/// Whether derivatives tell all parameters apart.
bool determine_all(const MatrixXd& J, const Callbacks& callbacks) {
  return Influences::of(J).determine_all(callbacks.priors > 0 ? kLeastWithPriors : Influences::kLeast);
}

/// Steps along fixed derivatives.
struct Advance {
  int steps = 0;
  bool converged = false;  // whether the next step would be short enough, by these derivatives
  double chi_squared = 0;
};

/// Steps along the derivatives at u, whose differences have been found: each costs one motion where new derivatives cost one or two
/// for each parameter. The last step that was good is kept.
/// @param most  of the next step of a fit that has converged, in standard errors
Advance advance(ScaledProblem& problem, const Callbacks& callbacks, std::vector<double>& u, double most) {
  constexpr int kMost = 12;
  constexpr double kKept = 0.5;  // of what the derivatives promise
  Advance done;
  MatrixXd J;
  VectorXd f;
  if (!problem.evaluate(u, f) || !problem.jacobian(u, J)) return done;
  if (callbacks.priors > 0) leave_to_priors(J, callbacks);
  if (!determine_all(J, callbacks)) return done;
  const Eigen::HouseholderQR<MatrixXd> qr(J);
  const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(J.rows(), J.cols());
  const MatrixXd R = qr.matrixQR().topRows(J.cols()).triangularView<Eigen::Upper>();
  const double freedom = static_cast<double>(std::max<Index>(J.rows() - J.cols(), 1));
  for (; done.steps < kMost; ++done.steps) {
    const VectorXd along = Q.transpose() * f;
    done.chi_squared = f.squaredNorm();
    done.converged = along.norm() <= most * std::sqrt(std::max(1.0, done.chi_squared / freedom));
    if (done.converged) return done;
    const VectorXd step = R.triangularView<Eigen::Upper>().solve(along);
    std::vector<double> next = u;
    for (Index j = 0; j < step.size(); ++j) next[static_cast<std::size_t>(j)] -= step[j];
    VectorXd then;
    if (!problem.evaluate(next, then)) return done;
    if (!(done.chi_squared - then.squaredNorm() >= kKept * along.squaredNorm())) return done;
    u = std::move(next);
    f = std::move(then);
  }
  return done;
}

std::string why_not_converged(bool no_progress, bool all_predicted) {
  if (!no_progress) return "the sum of squares is still decreasing";
  return all_predicted ? "no step reduces the sum of squares, though to first order it is not at its minimum"
                       : "the sum of squares decreases towards values that have no prediction: beyond a number's range, or "
                         "where no such motion exists";
}

Fit fit_scaled(const FitProblem& given, ScaledProblem& problem) {
  Fit fit;
  const std::size_t n = problem.residuals(), p = problem.parameters();
  std::vector<double> u = given.from.empty() ? std::vector<double>(p, 1) : problem.scaled(given.from);
  std::vector<std::size_t> without_influence;
  for (std::size_t j = 0; j < p; ++j) {
    const auto found = problem.find_step(u, j);
    const bool has_prior =
        std::any_of(given.priors.begin(), given.priors.end(), [&](const FitPrior& prior) { return prior.parameter == j; });
    if (found == ScaledProblem::StepFound::no_influence) {
      if (has_prior)
        without_influence.push_back(j);
      else
        fit.undetermined.push_back(j);
    }
    if (found == ScaledProblem::StepFound::no_prediction) {
      fit.outcome = FitOutcome::prediction_failed;
      fit.reason = "there is no prediction next to the values from which the fit starts";
      return fit;
    }
  }
  if (!fit.undetermined.empty()) {
    fit.outcome = FitOutcome::not_determined;
    return fit;
  }

  Callbacks callbacks{&problem, nullptr, 0, true, std::move(without_influence), static_cast<Index>(given.priors.size())};
  const double converged = given.rough ? kRoughlyConverged : kConverged;
  const Advance advanced = advance(problem, callbacks, u, converged);
  fit.iterations = advanced.steps;
  if (given.rough && advanced.converged) {
    fit.outcome = FitOutcome::converged;
    fit.parameters = problem.unscaled(u);
    fit.steps = problem.steps();
    fit.chi_squared = advanced.chi_squared;
    return fit;
  }
  const int most_iterations = given.rough ? kMostRoughIterations : kMostIterations;

  const gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)> workspace(
      allocated(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p)), gsl_multifit_nlinear_free);
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
      fit.reason = "on the way to the minimum of the sum of squares there is no prediction";
      return fit;
    }
    const Influences influences(workspace->J, workspace->f);
    fit.parameters = problem.unscaled(values_of(workspace->x));
    fit.steps = problem.steps();
    fit.chi_squared = influences.chi_squared();
    if (!influences.determine_all(given.priors.empty() ? Influences::kLeast : kLeastWithPriors)) {
      fit.outcome = FitOutcome::not_determined;
      fit.undetermined = influences.least_determined();
      return fit;
    }
    const double scatter = n > p ? std::max(1.0, influences.chi_squared() / static_cast<double>(n - p)) : 1.0;
    // In scaled errors if the scatter is larger than stated. A ripple of the motion, as a nutation far below the errors makes, has minima of its own.
    const double most = status == GSL_ENOPROG && callbacks.all_predicted ? std::max(converged, kRipple) : converged;
    if (influences.next_step() <= most * std::sqrt(scatter)) {
      fit.outcome = FitOutcome::converged;
      fit.jacobian =
          Eigen::Map<const RowMajor, 0, Eigen::OuterStride<>>(workspace->J->data, static_cast<Index>(n), static_cast<Index>(p),
                                                              Eigen::OuterStride<>(static_cast<Index>(workspace->J->tda)));
      const Eigen::Map<const VectorXd> scales(given.scales.data(), static_cast<Index>(p));
      const MatrixXd covariance = scales.asDiagonal() * influences.covariance() * scales.asDiagonal();
      fit.covariance = (covariance + covariance.transpose()) / 2;  // symmetric to the last bit
      return fit;
    }
    if (status == GSL_ENOPROG || fit.iterations >= most_iterations) {
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

}  // namespace earthtop::measure
