// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/scaled_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace earthtop::measure {
namespace {

constexpr double kFirstStep = 0x1p-20, kLongestStep = 1e-3, kShortestStep = 1e-9;  // parts of a parameter's scale
constexpr double kLongestStepInErrors = 1e-2;  // where errors are so large that a longer step makes no difference to them
constexpr double kWantedChange_rad = 1e-4;
constexpr double kWantedChange = 1;  // of all residuals together, in standard errors: a ripple below the errors is not followed
constexpr double kFine = 2, kRough = 30;  // factors by which a change may differ from the wanted one

}  // namespace

ScaledProblem::ScaledProblem(const FitProblem& problem)
    : problem_(problem),
      steps_(problem.steps.empty() ? std::vector<double>(problem.start.size(), kFirstStep) : problem.steps),
      residuals_(problem.standard_error.size()) {}

std::vector<double> ScaledProblem::unscaled(const std::vector<double>& u) const {
  std::vector<double> x(u.size());
  for (std::size_t j = 0; j < u.size(); ++j) x[j] = problem_.start[j] + (u[j] - 1) * problem_.scales[j];
  return x;
}

std::vector<double> ScaledProblem::scaled(const std::vector<double>& x) const {
  std::vector<double> u(x.size());
  for (std::size_t j = 0; j < x.size(); ++j) u[j] = 1 + (x[j] - problem_.start[j]) / problem_.scales[j];
  return u;
}

/// Computes the data's residuals in their standard errors, not whitened.
bool ScaledProblem::predict(const std::vector<double>& u, Eigen::VectorXd& f) {
  if (problem_.stopped()) throw Stopped();
  const bool predicted = problem_.residuals_at(unscaled(u), residuals_);
  if (problem_.stopped()) throw Stopped();  // a prediction that was cut short does not count as a missing one
  if (!predicted) return false;
  f.resize(static_cast<Eigen::Index>(residuals_.size()));
  for (std::size_t i = 0; i < residuals_.size(); ++i)
    f[static_cast<Eigen::Index>(i)] = residuals_[i] / problem_.standard_error[i];
  return f.allFinite();
}

const Eigen::VectorXd* ScaledProblem::predicted_at(const std::vector<double>& u) {
  if (here_at_ == u) return &here_;
  here_at_.clear();
  if (!predict(u, here_)) return nullptr;
  here_at_ = u;
  return &here_;
}

bool ScaledProblem::evaluate(const std::vector<double>& u, Eigen::VectorXd& f) {
  const Eigen::VectorXd* const here = predicted_at(u);
  if (!here) return false;
  Eigen::VectorXd data = *here;
  problem_.whitening.whiten(data);
  f.resize(static_cast<Eigen::Index>(residuals()));
  f.head(data.size()) = data;
  for (std::size_t k = 0; k < problem_.priors.size(); ++k) {
    const auto& [parameter, standard_error] = problem_.priors[k];
    f[data.size() + static_cast<Eigen::Index>(k)] = (1 - u[parameter]) * problem_.scales[parameter] / standard_error;
  }
  return f.allFinite();
}

/// Differentiates the data's residuals, not whitened. Takes differences to both sides or, where a range ends or a motion cannot be
/// computed, to one side. @param here  the residuals at u, from which the difference is taken: to one side where it can be
bool ScaledProblem::differentiate(const std::vector<double>& u, std::size_t parameter, Eigen::VectorXd& derivative,
                                  const Eigen::VectorXd* here) {
  Eigen::VectorXd high, low;
  std::vector<double> above = u, below = u;
  above[parameter] += steps_[parameter];
  below[parameter] -= steps_[parameter];
  const bool has_high = predict(above, high), has_low = !(here && has_high) && predict(below, low);
  if (!has_high && !has_low) return false;
  const auto take_here = [&](std::vector<double>& at, Eigen::VectorXd& residuals) {
    at = u;
    if (here) residuals = *here;
    return here || predict(u, residuals);
  };
  if (!has_high && !take_here(above, high)) return false;
  if (!has_low && !take_here(below, low)) return false;
  derivative = high - low;
  for (Eigen::Index i = 0; i < derivative.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    if (problem_.period[row] > 0)
      derivative[i] = std::remainder(derivative[i], problem_.period[row] / problem_.standard_error[row]);
  }
  derivative /= above[parameter] - below[parameter];
  return true;
}

bool ScaledProblem::jacobian(const std::vector<double>& u, Eigen::MatrixXd& J) {
  J.resize(static_cast<Eigen::Index>(residuals()), static_cast<Eigen::Index>(parameters()));
  Eigen::VectorXd column;
  const Eigen::VectorXd* const here = problem_.rough ? predicted_at(u) : nullptr;
  if (problem_.rough && !here) return false;
  for (std::size_t j = 0; j < parameters(); ++j) {
    if (columns_at_ == u && columns_[j].size() > 0)
      column = columns_[j];
    else if (!differentiate(u, j, column, here))
      return false;
    J.col(static_cast<Eigen::Index>(j)) = with_priors(column, j);
  }
  return true;
}

/// The derivatives of all residuals by a parameter, from those of the data's residuals, not whitened.
Eigen::VectorXd ScaledProblem::with_priors(Eigen::VectorXd of_data, std::size_t parameter) const {
  problem_.whitening.whiten_derivative(of_data);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(residuals()));
  column.head(of_data.size()) = of_data;
  for (std::size_t k = 0; k < problem_.priors.size(); ++k)
    if (problem_.priors[k].parameter == parameter)
      column[of_data.size() + static_cast<Eigen::Index>(k)] = -problem_.scales[parameter] / problem_.priors[k].standard_error;
  return column;
}

double ScaledProblem::largest_change_rad(const Eigen::VectorXd& derivative, double step) const {
  double change = 0;
  for (Eigen::Index i = 0; i < derivative.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const double size = problem_.size.empty() ? 1 : problem_.size[row];
    change = std::max(change, std::abs(derivative[i]) * step * problem_.standard_error[row] / size);
  }
  return change;
}

ScaledProblem::StepFound ScaledProblem::find_step(const std::vector<double>& u, std::size_t parameter) {
  const Eigen::VectorXd* const here = problem_.rough ? predicted_at(u) : nullptr;
  if (problem_.rough && !here) return StepFound::no_prediction;
  if (columns_at_ != u) columns_.assign(parameters(), {});
  columns_at_ = u;
  Eigen::VectorXd derivative;
  const StepFound found = find_step(u, parameter, kFine, derivative, here);
  if (found == StepFound::yes) columns_[parameter] = std::move(derivative);
  return found;
}

ScaledProblem::StepFound ScaledProblem::derivative(const std::vector<double>& u, std::size_t parameter, Step wanted,
                                                   Eigen::VectorXd& column) {
  Eigen::VectorXd of_data;
  StepFound found = StepFound::no_prediction;
  const Eigen::VectorXd* const here = wanted == Step::rough ? predicted_at(u) : nullptr;
  if (wanted == Step::fine || here) found = find_step(u, parameter, wanted == Step::fine ? kFine : kRough, of_data, here);
  if (found != StepFound::yes) of_data.setZero(static_cast<Eigen::Index>(problem_.standard_error.size()));
  column = with_priors(std::move(of_data), parameter);
  return found;
}

ScaledProblem::StepFound ScaledProblem::find_step(const std::vector<double>& u, std::size_t parameter, double within,
                                                  Eigen::VectorXd& derivative, const Eigen::VectorXd* here) {
  constexpr int kAttempts = 5;
  double& step = steps_[parameter];
  for (int attempt = 1;; ++attempt) {
    if (!differentiate(u, parameter, derivative, here)) {
      if (step <= kShortestStep || attempt == kAttempts) return StepFound::no_prediction;
      step = std::max(kShortestStep, step / 1e2);
      continue;
    }
    const double change_rad = largest_change_rad(derivative, step), change = derivative.norm() * step;
    const double share = std::min(change_rad / kWantedChange_rad, change / kWantedChange);  // of the wanted change
    const double longest = change_rad < kWantedChange_rad ? kLongestStep : kLongestStepInErrors;
    const bool is_fine = share <= within && share >= 1 / within;
    const bool cannot_grow = share < 1 && step >= longest;
    if (cannot_grow && change_rad < 10 * kPredictionError_rad) return StepFound::no_influence;
    if (is_fine || cannot_grow || attempt == kAttempts) return StepFound::yes;
    step = std::clamp(share > 0 ? step / share : longest, kShortestStep, longest);
  }
}

}  // namespace earthtop::measure
