// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/fit_hints.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace earthtop::measure {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr std::string_view kTurns[] = {"/instrument/turn_east_deg", "/instrument/turn_north_deg"};
constexpr std::size_t kMostHints = 3;
constexpr double kLeastMended = 0.5;  // of what chi-squared has too much
constexpr double kLeastSeen = 3e-3;   // of a column, beside the fitted ones: less is the error of differences

struct Candidate {
  std::vector<JointInput> inputs;
  MatrixXd columns;
};

bool is_turn(const EstimatedInput& input) { return std::ranges::find(kTurns, input.pointer) != std::end(kTurns); }

void add_candidates(std::vector<Candidate>& candidates, const JointInputs& inputs, const MatrixXd& columns) {
  const std::size_t begin = candidates.size();
  for (std::size_t j = inputs.fitted(); j < inputs.list().size(); ++j) {
    const JointInput& input = inputs.list()[j];
    const auto column = columns.col(static_cast<Index>(j - inputs.fitted()));
    const auto turn =
        std::find_if(candidates.begin() + static_cast<std::ptrdiff_t>(begin), candidates.end(), [&](const Candidate& c) {
          return is_turn(input) && is_turn(c.inputs.front()) && c.inputs.front().release == input.release;
        });
    if (turn == candidates.end()) {
      candidates.push_back({{input}, column});
      continue;
    }
    turn->inputs.push_back(input);
    turn->columns.conservativeResize(Eigen::NoChange, turn->columns.cols() + 1);
    turn->columns.rightCols(1) = column;
  }
}

/// Whether a number of an instrument has to do with what was measured: a turn of the mount and a clock do; other ones are named after the
/// quantities that are read on their scale.
bool reads(std::string_view key, const Measurement& measurement) {
  if (key.starts_with("turn_") || key.starts_with("time_") || key.starts_with("clock_")) return true;
  std::string_view stem = key.substr(0, key.rfind("_zero"));
  for (const std::string_view end : {"_bias", "_scale"}) stem = stem.substr(0, stem.rfind(end));
  if (stem.starts_with("w_")) stem = "w_";  // all of its axes: they share the scale
  return std::ranges::any_of(measurement.values, [&](const MeasuredValue& value) {
    const std::string_view name = to_string(value.quantity);
    return name.starts_with(stem) || (name == "axis" && (stem == "azimuth" || stem == "tilt"));
  });
}

}  // namespace

EstimatedInputs with_instrument(const Measurement& measurement, const ExactInputs& exact,
                                const ExactInputs::InputsOf& inputs_of) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < exact.fitted(); ++j) names.push_back(exact.all().list()[j].name);
  for (const InstrumentRow& row : kInstrument) {
    if (!reads(instrument_key(row.pointer), measurement)) continue;
    if (std::ranges::find(names, row.pointer) == names.end()) names.emplace_back(row.pointer);
  }
  return inputs_of(names);
}

std::vector<FitHint> hints_of(const ReleasesReport& report, const MatrixXd& J, const JointExactInputs& exact,
                              const JointInputs& of_instrument, const MatrixXd& by_instrument) {
  VectorXd residuals(J.rows());
  Index at = 0;
  for (const MeasurementReport& release : report.releases)
    for (const MeasurementResidual& residual : release.residuals) residuals[at++] = residual.independent();
  for (const Prior& prior : report.priors) residuals[at++] = -prior.pull.value_or(0);
  const auto fitted = static_cast<Index>(exact.fitted());
  const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(J.leftCols(fitted)).householderQ() * MatrixXd::Identity(J.rows(), fitted);

  std::vector<Candidate> candidates;
  add_candidates(candidates, exact.all(), J.rightCols(static_cast<Index>(exact.exact())));
  add_candidates(candidates, of_instrument, by_instrument);
  const double too_much = report.fitted->value - static_cast<double>(report.fitted->degrees_of_freedom);
  std::vector<FitHint> hints;
  for (const Candidate& candidate : candidates) {
    const MatrixXd beside = candidate.columns - Q * (Q.transpose() * candidate.columns);
    if ((beside.colwise().norm().array() <= kLeastSeen * candidate.columns.colwise().norm().array()).any()) continue;
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(beside);
    if (qr.rank() < beside.cols()) continue;
    const VectorXd change = -qr.solve(residuals);  // in scales: beyond one, the first order says nothing
    if ((change.array().abs() > 1).any()) continue;
    const double left = report.fitted->value - residuals.squaredNorm() + (residuals + beside * change).squaredNorm();
    if (!(report.fitted->value - left >= kLeastMended * too_much)) continue;
    const MatrixXd covariance = (beside.transpose() * beside).inverse();
    FitHint hint{{}, left};
    for (std::size_t k = 0; k < candidate.inputs.size(); ++k) {
      const JointInput& input = candidate.inputs[k];
      const auto i = static_cast<Index>(k);
      hint.values.push_back({input.name, input.unit, input.start + change[i] * input.scale,
                             std::sqrt(covariance(i, i)) * input.scale, input.release});
    }
    hints.push_back(std::move(hint));
  }
  // Two numbers must leave clearly less than one does.
  std::ranges::sort(hints, {},
                    [](const FitHint& hint) { return hint.chi_squared + 4 * static_cast<double>(hint.values.size()); });
  if (hints.size() > kMostHints) hints.resize(kMostHints);
  return hints;
}

}  // namespace earthtop::measure
