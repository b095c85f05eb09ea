// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/bound.hpp"

#include <algorithm>
#include <cmath>

#include "error/gsl_errors.hpp"
#include "measure/error_memory.hpp"
#include "measure/influences.hpp"
#include "measure/seen_directions.hpp"

namespace earthtop::plan {
namespace {

using Eigen::Index;
/// The change that no value notices is stated for so small a part of the scale of the number that changes most.
constexpr double kSmallChange = 0.01;

using measure::RowMajor;

/// The derivatives of the chosen values. Where errors are correlated, each value is replaced by what is new in it beside the one
/// before it in its series, (e_k - rho e_(k-1)) / sqrt(1 - rho^2) with rho = exp(-dt / tau): the errors of these are independent
/// and of variance 1.
/// @param all_J  of all values
RowMajor chosen_rows(const Derivatives& all, const Eigen::MatrixXd& all_J, const ValueChoice& choice) {
  std::vector<Index> chosen;
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    const PlannedValue& value = all.values[i];
    if (value.row % choice.stride == 0 && value.row / choice.stride < choice.rows && value.quantity < choice.quantities)
      chosen.push_back(static_cast<Index>(i));
  }
  const Index numbers = all_J.cols();
  RowMajor J = RowMajor::Zero(std::max(static_cast<Index>(chosen.size()), numbers), numbers);
  std::vector<Index> latest;  // of each series, -1 before its first value
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const PlannedValue& value = all.values[static_cast<std::size_t>(chosen[k])];
    const auto to = static_cast<Index>(k);
    if (value.series >= latest.size()) latest.resize(value.series + 1, -1);
    Index& before = latest[value.series];
    J.row(to) = all_J.row(chosen[k]);
    if (choice.correlation_time_s > 0 && before >= 0) {
      const double elapsed_s = value.t_s - all.values[static_cast<std::size_t>(before)].t_s;
      const auto [rho, fresh] = measure::error_memory(elapsed_s, choice.correlation_time_s);
      J.row(to) = (J.row(to) - rho * all_J.row(before)) / fresh;
    }
    before = chosen[k];
    J.row(to) /= choice.sigma_factor;
  }
  return J;
}

/// The derivatives of the priors (rows) by this many inputs.
Eigen::MatrixXd prior_rows(Index inputs, const std::vector<double>& scales, const std::vector<InputPrior>& priors) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Index>(priors.size()), inputs);
  for (std::size_t k = 0; k < priors.size(); ++k)
    rows(static_cast<Index>(k), static_cast<Index>(priors[k].input)) = scales[priors[k].input] / priors[k].standard_error;
  return rows;
}

/// As many rows as numbers with the same information as J, and below them those of the priors. Directions that the values do not
/// determine are left to the priors.
RowMajor with_priors(const RowMajor& J, const std::vector<double>& scales, const std::vector<InputPrior>& priors) {
  const Index numbers = J.cols();
  const Eigen::MatrixXd seen = measure::seen_directions(J).rows;
  RowMajor rows = RowMajor::Zero(numbers + static_cast<Index>(priors.size()), numbers);
  rows.topRows(seen.rows()) = seen;
  rows.bottomRows(static_cast<Index>(priors.size())) = prior_rows(numbers, scales, priors);
  return rows;
}

}  // namespace

std::optional<double> Bound::standard_error(std::size_t input) const {
  if (!is_determined()) return std::nullopt;
  const auto i = static_cast<Index>(input);
  return std::sqrt(covariance(i, i));
}

Eigen::MatrixXd derivatives_by_all(const Derivatives& derivatives, const std::vector<double>& scales,
                                   const std::vector<InputPrior>& priors, const ValueChoice& choice) {
  Eigen::MatrixXd by_all(derivatives.J.rows(), derivatives.J.cols() + derivatives.exact.cols());
  by_all << derivatives.J, derivatives.exact;
  Eigen::MatrixXd rows = chosen_rows(derivatives, by_all, choice);
  if (priors.empty()) return rows;
  auto of_numbers = rows.leftCols(derivatives.J.cols());
  of_numbers = measure::seen_directions(of_numbers).seen_part(of_numbers);
  const auto number = static_cast<Index>(priors.size());
  rows.conservativeResize(rows.rows() + number, Eigen::NoChange);
  rows.bottomRows(number) = prior_rows(rows.cols(), scales, priors);
  return rows;
}

Bound bound_of(const Derivatives& derivatives, const std::vector<double>& scales, const std::vector<InputPrior>& priors,
               const ValueChoice& choice) {
  const ReturnedGslErrors returned;
  RowMajor J = chosen_rows(derivatives, derivatives.J, choice);
  Bound bound;
  for (Index j = 0; j < J.cols(); ++j) {
    double information = J.col(j).squaredNorm();
    for (const InputPrior& prior : priors)
      if (static_cast<Index>(prior.input) == j) {
        const double part = scales[prior.input] / prior.standard_error;
        information += part * part;
      }
    bound.alone.push_back(scales[static_cast<std::size_t>(j)] / std::sqrt(information));
  }
  if (!priors.empty()) J = with_priors(J, scales, priors);
  const measure::Influences influences = measure::Influences::of(J);
  const Eigen::Map<const Eigen::VectorXd> scale(scales.data(), static_cast<Index>(scales.size()));
  if (influences.determine_all(priors.empty() ? measure::Influences::kLeast : measure::kLeastWithPriors)) {
    const Eigen::MatrixXd covariance = scale.asDiagonal() * influences.covariance() * scale.asDiagonal();
    bound.covariance = (covariance + covariance.transpose()) / 2;
    return bound;
  }
  bound.undetermined = influences.least_determined();
  const Eigen::VectorXd direction = influences.least_determined_direction();
  double largest = 0;
  for (const std::size_t j : bound.undetermined) largest = std::max(largest, std::abs(direction[static_cast<Index>(j)]));
  for (Index j = 0; j < direction.size(); ++j)
    bound.direction.push_back(kSmallChange * direction[j] / largest * scales[static_cast<std::size_t>(j)]);
  return bound;
}

}  // namespace earthtop::plan
