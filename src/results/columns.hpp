// SPDX-License-Identifier: GPL-3.0-or-later
/// The columns of the result files after the time: those of trajectory.csv, made of the quantities of a row, and those of
/// torques.csv, whose quantities stand here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drift/row_quantities.hpp"
#include "earthtop/model/ledger_row.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

class Scene;

/// The column of times, the first one in every file.
inline constexpr std::string_view kTimeColumn = "t_s";

/// One column of trajectory.csv.
struct Column {
  std::string name;  ///< with its unit
  const DriftQuantity* quantity;
  std::size_t component;
  std::optional<double> value(const DriftRow& row) const { return quantity->value(row, component); }
};

/// All columns of trajectory.csv after the time, in the file's order.
const std::vector<Column>& trajectory_columns();

/// A torque of the ledger, in its observer's axes (N m).
struct TorqueQuantity : ValuedQuantity<LedgerRow<double>, LedgerRow<float128>> {
  bool (*present)(const Scene&);  ///< whether a scene has it: a share of the physical torques only where its effect acts
};

/// The quantities of torques.csv after the time, in the file's order.
std::span<const TorqueQuantity> torque_quantities();

}  // namespace earthtop
