// SPDX-License-Identifier: GPL-3.0-or-later
// Values known from other sources.
#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "drift/row_quantities.hpp"
#include "earthtop/model/conserved.hpp"
#include "earthtop/results/headline.hpp"
#include "text/number_words.hpp"
#include "verify/differences.hpp"
#include "verify/formulas.hpp"
#include "verify/judge.hpp"
#include "verify/scene.hpp"

namespace earthtop::verify_detail {
namespace {

constexpr std::string_view kAxisColumns[] = {"axis_L_x", "axis_L_y", "axis_L_z"};

/// The value at the release of the conserved energy that is called so; none for another quantity.
std::optional<double> initial_energy(const RunResult& result, std::string_view quantity) {
  for (const auto& conserved : kConserved<double>) {
    if (conserved.unit != "J" || quantity != fmt::format("{}_J", conserved.name)) continue;
    for (const InvariantReport& invariant : result.invariants)
      if (invariant.name == conserved.name) return invariant.initial;
    throw NotJudged(fmt::format("this run has no {}", conserved.name));
  }
  return std::nullopt;
}

double figure(const RunResult& result, std::string_view quantity, double t_s) {
  if (const auto found = find_figure(result, quantity, t_s)) return *found;
  throw NotJudged(fmt::format("this run has no {} at t = {}", quantity, time_text(t_s)));
}

/// The rate about body axis 3 relative to inertial space in the row at time `t_s` (rad/s): of the rotating motion that relative
/// to the laboratory plus the Earth's part.
double inertial_spin(const RunResult& result, Prediction prediction, double t_s) {
  if (prediction == Prediction::reference) return figure(result, "ref_w_LB_B_z_rad_s", t_s);
  const Vec3<double> W_L = earth_rate_L(result.scene);
  double spin = figure(result, "w_LB_B_z_rad_s", t_s);
  for (int i = 0; i < 3; ++i) spin += W_L[i] * figure(result, kAxisColumns[i], t_s);
  return spin;
}

/// The numbers of a quantity: of a vector those of its columns.
std::vector<double> numbers_of(const RunResult& result, const std::string& quantity, double t_s) {
  if (const auto energy = initial_energy(result, quantity)) return {*energy};
  if (quantity == "critical_spin_rad_s") return {critical_spin_of(result.scene)};
  if (quantity == "inertial_spin_rad_s") return {inertial_spin(result, Prediction::rotating, t_s)};
  if (quantity == "ref_inertial_spin_rad_s") return {inertial_spin(result, Prediction::reference, t_s)};
  for (const RowQuantity& row_quantity : kDriftQuantities) {
    if (!row_quantity.is_called(quantity)) continue;
    std::vector<double> numbers;
    for (std::size_t i = 0; i < row_quantity.width(); ++i) numbers.push_back(figure(result, row_quantity.column(i), t_s));
    return numbers;
  }
  return {figure(result, quantity, t_s)};
}

}  // namespace

double value_error(const CriterionSpec& criterion, Runs& runs) {
  const RunResult& result = runs.run(criterion.set);
  const double t_s = criterion.at_s.value_or(result.scene.scenario().duration_s);
  const std::vector<double> computed = numbers_of(result, criterion.quantity, t_s), &known = criterion.values;
  if (computed.size() == 4)
    return attitude_distance({computed[0], computed[1], computed[2], computed[3]}, {known[0], known[1], known[2], known[3]});
  double error = 0;
  for (std::size_t i = 0; i < computed.size(); ++i) error = worse(error, std::abs(computed[i] - known[i]));
  return error;
}

}  // namespace earthtop::verify_detail
