// SPDX-License-Identifier: GPL-3.0-or-later
/// The rows of a result as arrays, one for each quantity: as other languages take them, and without a copy where the numbers lie
/// in memory as they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop {

/// A quantity of trajectory.csv or torques.csv in all rows, in double precision.
struct RowArray {
  std::string name;             ///< name of the whole quantity with its unit, e.g. "w_LB_B_rad_s"
  std::string_view meaning;     ///< what it is, with frames and axes
  std::string_view components;  ///< letters of its components, "wxyz", "xyz" or "xy"; empty for a single number
  std::string_view words;       ///< of a word: those it may be, separated by '|'; else empty
  bool is_flag = false;
  std::vector<std::string> columns = {};  ///< its columns in the file, one for each component
  std::size_t rows = 0;

  // The numbers are in one of these three.
  const double* first = nullptr;    ///< the first row's first component, in the result itself; components follow each other
  std::ptrdiff_t stride_bytes = 0;  ///< from one row to the next
  std::vector<double> copied = {};  ///< numbers that a row need not have: NaN where it has none
  std::vector<std::uint8_t> places = {};  ///< of flags: 0 or 1; of words: the place among `words`

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// The time and all quantities of trajectory.csv, in the file's order. The arrays refer to the result's own memory and are valid
/// as long as it is neither changed nor destroyed.
std::vector<RowArray> row_arrays(const RunResult& result);

/// The same of `RunResult::looks`: for pictures.
std::vector<RowArray> look_arrays(const RunResult& result);

/// The same arrays without a row, those of a top on a table included: what there can be.
std::vector<RowArray> row_array_kinds();

/// The time and the quantities of torques.csv, likewise; empty without a ledger. Vectors are in the axes of the ledger's
/// observer.
std::vector<RowArray> torque_arrays(const RunResult& result);
/// The same without a row, for every effect: what there can be.
std::vector<RowArray> torque_array_kinds();

}  // namespace earthtop
