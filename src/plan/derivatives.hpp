// SPDX-License-Identifier: GPL-3.0-or-later
/// The derivatives of planned values by the estimated numbers: those that a fit of such a measurement uses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "earthtop/plan/plan.hpp"
#include "earthtop/watch.hpp"
#include "measure/joint_inputs.hpp"

namespace earthtop::plan {

/// One planned number: its place in time, and the series of equal quantities to which it belongs.
struct PlannedValue {
  std::size_t row = 0;
  double t_s = 0;
  std::size_t series = 0;    ///< the same for all values of one component of one quantity
  std::size_t quantity = 0;  ///< place of the quantity among the plan's
};

struct Derivatives {
  PlanOutcome outcome = PlanOutcome::determined;
  RunStatus status = RunStatus::completed;
  std::string reason;
  std::vector<PlannedValue> values;
  Eigen::MatrixXd J;      ///< of values in their standard errors (rows) by estimated numbers in their scales (columns)
  Eigen::MatrixXd exact;  ///< the same by the inputs behind these, that are taken as exact
};

/// Computes the derivatives at the scenario's numbers, by the differences that fits take.
/// @param estimated   number of inputs that are estimated, the first ones; those behind them are taken as exact
/// @param quantities  to be measured at each of `times_s`, the first of which is 0
/// @param predictions  is increased by the number of motions computed
/// @throws ScenarioError for an azimuth that is not defined
Derivatives derivatives_of(const Scene& scene, const measure::EstimatedInputs& inputs, std::size_t estimated,
                           const std::vector<PlannedQuantity>& quantities, const std::vector<double>& times_s,
                           const Watch& watch, std::int64_t& predictions);

/// The derivatives of the values of all releases, one after the other, by the numbers of all.
/// @param releases  that are determined   @param inputs  theirs, exact ones included
Derivatives joined(const std::vector<Derivatives>& releases, const measure::JointInputs& inputs);

}  // namespace earthtop::plan
