// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/exact_inputs.hpp"

#include <fmt/core.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "earthtop/scenario/inputs.hpp"
#include "measure/input_places.hpp"
#include "measure/known_rate.hpp"

namespace earthtop {
namespace measure {
namespace {

using Eigen::Index;

constexpr double kUsualShare = 1e-3;  // of an input's scale: the error of one whose standard error is not stated
/// A shift by less than this part of what an input does to the residuals is the error of differences: the fitted inputs take the
/// input's place.
constexpr double kLeastShift = 1e-4;

struct ExactName {
  std::string name;
  std::optional<double> stated;
};

/// The names of all inputs that may be taken as exact. A torque or a motion that the scenario does not have is none of them.
std::vector<ExactName> candidates(Scenario scenario) {
  std::vector<ExactName> names;
  const auto& uncertainty = scenario.uncertainty;
  for (std::size_t i = 0; i < kInputs.size(); ++i) {
    if (kInputs[i].kind == InputKind::number && !kInputs[i].number(scenario)) continue;
    for (const InputPlace& place : places_of(kInputs[i])) {
      const double stated = uncertainty ? (*uncertainty)[i] * place.per_unit : 0;
      names.push_back({std::string(place.estimated), stated > 0 ? std::optional(stated) : std::nullopt});
    }
  }
  for (const char* name : {"/release/azimuth_deg", "omega_sin_latitude_rad_s", "omega_cos_latitude_rad_s"})
    names.push_back({name, {}});
  return names;
}

std::vector<std::string> with(std::vector<std::string> names, const std::string& name) {
  names.push_back(name);
  return names;
}

}  // namespace

ExactInputs::ExactInputs(const Scene& scene, const std::vector<std::string>& fitted, const InputsOf& inputs_of)
    : all_(inputs_of(fitted)), fitted_(fitted.size()) {
  std::vector<std::string> names = fitted;
  for (const ExactName& candidate : candidates(scene.scenario())) {
    if (names.size() == kMost) return;
    try {
      all_ = inputs_of(with(names, candidate.name));
    } catch (const ScenarioError&) {  // the scenario does not have it, or it stands for numbers that are in the list
      continue;
    }
    names.push_back(candidate.name);
    const EstimatedInput& input = all_.list().back();
    const auto known = known_rate(scene, input);
    knowledge_.push_back({candidate.stated, candidate.stated                     ? *candidate.stated
                                            : known && known->standard_error > 0 ? known->standard_error
                                                                                 : kUsualShare * input.scale});
  }
}

namespace {

std::vector<const EstimatedInputs*> inputs_of_all(const std::vector<ExactInputs>& releases) {
  std::vector<const EstimatedInputs*> all;
  all.reserve(releases.size());
  for (const ExactInputs& release : releases) all.push_back(&release.all());
  return all;
}

std::vector<std::size_t> fitted_of_all(const std::vector<ExactInputs>& releases) {
  std::vector<std::size_t> fitted;
  fitted.reserve(releases.size());
  for (const ExactInputs& release : releases) fitted.push_back(release.fitted());
  return fitted;
}

}  // namespace

JointExactInputs::JointExactInputs(const std::vector<ExactInputs>& releases, const std::vector<std::string>& shared)
    : of_releases_(inputs_of_all(releases)), all_(of_releases_, fitted_of_all(releases), shared), knowledge_(exact()) {
  for (std::size_t r = releases.size(); r-- > 0;)  // the first one's counts
    for (std::size_t i = releases[r].fitted(); i < all_.places(r).size(); ++i)
      knowledge_[all_.places(r)[i] - fitted()] = releases[r].knowledge(i);
}

std::vector<ExactInput> JointExactInputs::shifting(const Eigen::MatrixXd& J, std::size_t fitted) const {
  // As many rows as inputs, with the same products of columns.
  const Index rows = std::min(J.rows(), J.cols());
  const Eigen::MatrixXd R = Eigen::HouseholderQR<Eigen::MatrixXd>(J).matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd by_exact = R.rightCols(static_cast<Index>(exact()));
  const Eigen::MatrixXd estimator =
      R.leftCols(static_cast<Index>(this->fitted())).colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(rows, rows));
  const Eigen::MatrixXd all_shifts = estimator * by_exact;
  const double error = estimator.row(static_cast<Index>(fitted)).norm();  // the fitted input's standard error, in its scale
  std::vector<std::pair<double, ExactInput>> found;
  for (std::size_t k = 0; k < exact(); ++k) {
    const auto column = static_cast<Index>(k);
    const double shift = all_shifts(static_cast<Index>(fitted), column);
    if (!(std::abs(shift) > kLeastShift * error * by_exact.col(column).norm())) continue;
    if (!(std::abs(shift) > error)) continue;  // one as wrong as it is large would not shift the estimate by a standard error
    const JointInput& input = all_.list()[this->fitted() + k];
    const double by_unit = shift * all_.list()[fitted].scale / input.scale;
    const double misfit =
        (by_exact.col(column) - R.leftCols(static_cast<Index>(this->fitted())) * all_shifts.col(column)).norm();
    const auto& [stated, usual] = knowledge_[k];
    found.emplace_back(std::abs(by_unit) * usual,
                       ExactInput{input.name, input.unit, input.start, stated, by_unit, misfit / input.scale, input.release});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<ExactInput> inputs;
  inputs.reserve(found.size());
  for (auto& [size, input] : found) inputs.push_back(std::move(input));
  return inputs;
}

}  // namespace measure

std::string name_in_release(const std::string& name, std::size_t release) {
  return release == 0 ? name : fmt::format("{} of release {}", name, release);
}

std::vector<InputError> errors_that_shift(const std::vector<ExactInput>& inputs, double by, double most_chi_squared) {
  std::vector<InputError> errors;
  for (const ExactInput& input : inputs) {
    const double error = by / input.shift, length = input.misfit * error;
    if (length * length <= most_chi_squared) errors.push_back({input.name, input.unit, error, input.release});
  }
  return errors;
}

}  // namespace earthtop
