// SPDX-License-Identifier: GPL-3.0-or-later
/// The columns of the result files after the time: those of trajectory.csv, made from the table in drift/row_quantities.hpp,
/// and those of torques.csv, whose table of quantities is in this directory.
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

/// Name of the column of times (s), the first one in every file.
inline constexpr std::string_view kTimeColumn = "t_s";

/// One column of trajectory.csv.
struct Column {
  std::string name;  ///< with its unit
  const DriftQuantity* quantity;
  std::size_t component;
  std::optional<double> value(const DriftRow& row) const { return quantity->value(row, component); }
};

/// All columns of trajectory.csv after the time, in the file's order. Those of the contact come last, and only the files of a top
/// on a table have them.
const std::vector<Column>& trajectory_columns();

/// A torque of the ledger (N m), or the force of a table (N), in the axes of the ledger's observer.
struct TorqueQuantity : ValuedQuantity<LedgerRow<double>, LedgerRow<float128>> {
  bool (*present)(const Scene&);  ///< whether a scene has it (an effect's torque: if the effect acts); null: always
};

/// The quantities of torques.csv after the time, in the file's order.
std::span<const TorqueQuantity> torque_quantities();

}  // namespace earthtop
