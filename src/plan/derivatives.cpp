// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/derivatives.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "measure/prediction_problem.hpp"
#include "measure/scaled_problem.hpp"
#include "plan/planned_rows.hpp"

namespace earthtop::plan {
namespace {

using measure::FitProblem, measure::PredictedMotion, measure::ScaledProblem;

/// The number of predictions: for each number some to find its step, and two for its derivative.
double expected_predictions(std::size_t numbers) { return 1 + 6 * static_cast<double>(numbers); }

std::vector<PlannedValue> values_of(const Measurement& measurement, std::size_t quantities,
                                    const std::vector<MeasurementResidual>& residuals) {
  std::vector<PlannedValue> values;
  std::map<std::pair<std::size_t, std::string_view>, std::size_t> series;
  std::size_t at = 0;
  for (std::size_t i = 0; i < measurement.values.size(); ++i) {
    const std::size_t components = measurement.values[i].quantity == MeasuredQuantity::axis ? 2 : 1;
    for (std::size_t c = 0; c < components; ++c, ++at) {
      const auto key = std::pair(i % quantities, residuals[at].quantity);
      const std::size_t number = series.try_emplace(key, series.size()).first->second;
      values.push_back({i / quantities, measurement.values[i].t_s, number, i % quantities});
    }
  }
  return values;
}

}  // namespace

Derivatives derivatives_of(const Scene& scene, const measure::EstimatedInputs& inputs, std::size_t estimated,
                           const std::vector<PlannedQuantity>& quantities, const std::vector<double>& times_s,
                           const Watch& watch, std::int64_t& predictions) {
  Derivatives found;
  const double part = 1 / expected_predictions(inputs.list().size());
  Measurement measurement = empty_measurement(quantities, times_s);
  const PredictedMotion motion = measure::predict(scene, measurement, watch.part(0, part));
  ++predictions;
  found.status = motion.status;
  if (motion.status != RunStatus::completed) {
    found.outcome = motion.status == RunStatus::interrupted ? PlanOutcome::interrupted : PlanOutcome::prediction_failed;
    found.reason = fmt::format("the scenario's own motion ended with {}", to_string(motion.status));
    return found;
  }
  fill_in(measurement, motion);
  const std::vector<MeasurementResidual> own = measure::residuals_of(measurement, motion);
  found.values = values_of(measurement, quantities.size(), own);

  measure::Trials trials{predictions, part, part};
  const measure::JointInputs alone({&inputs}, {estimated}, {});
  const std::vector<measure::VariedRelease> varied = {measure::varied_release(inputs, measurement, own)};
  const FitProblem problem = measure::prediction_problem(alone, varied, watch, trials);
  ScaledProblem scaled(problem);
  const std::vector<double> start(inputs.list().size(), 1);
  try {
    found.J.resize(static_cast<Eigen::Index>(scaled.residuals()), static_cast<Eigen::Index>(estimated));
    found.exact.resize(found.J.rows(), static_cast<Eigen::Index>(start.size() - estimated));
    Eigen::VectorXd column;
    for (std::size_t j = 0; j < start.size(); ++j) {
      const bool is_exact = j >= estimated;
      const auto step = scaled.derivative(start, j, is_exact ? ScaledProblem::Step::rough : ScaledProblem::Step::fine, column);
      if (!is_exact && step == ScaledProblem::StepFound::no_prediction) {
        found.outcome = PlanOutcome::prediction_failed;
        found.reason = "there is no prediction next to the scenario's numbers";
        return found;
      }
      if (is_exact)
        found.exact.col(static_cast<Eigen::Index>(j - estimated)) = column;
      else
        found.J.col(static_cast<Eigen::Index>(j)) = column;
    }
  } catch (const ScaledProblem::Stopped&) {
    found.outcome = PlanOutcome::interrupted;
    found.status = RunStatus::interrupted;
  }
  return found;
}

Derivatives joined(const std::vector<Derivatives>& releases, const measure::JointInputs& inputs) {
  Derivatives all;
  Eigen::Index rows = 0, row = 0;
  for (const Derivatives& release : releases) rows += release.J.rows();
  const auto estimated = static_cast<Eigen::Index>(inputs.fitted());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(inputs.list().size()));
  std::size_t series = 0;
  for (std::size_t r = 0; r < releases.size(); ++r) {
    const Derivatives& release = releases[r];
    const std::size_t begin = series;
    for (PlannedValue value : release.values) {
      value.series += begin;
      series = std::max(series, value.series + 1);
      all.values.push_back(value);
    }
    for (std::size_t i = 0; i < inputs.places(r).size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i), own = release.J.cols();
      J.col(static_cast<Eigen::Index>(inputs.places(r)[i])).segment(row, release.J.rows()) =
          at < own ? release.J.col(at) : release.exact.col(at - own);
    }
    row += release.J.rows();
  }
  all.J = J.leftCols(estimated);
  all.exact = J.rightCols(J.cols() - estimated);
  return all;
}

}  // namespace earthtop::plan
