// SPDX-License-Identifier: GPL-3.0-or-later
/// A function of time that a scenario gives as a table in a file: the angle of a platform, or the rate of a rotor.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace earthtop {

/// Measured angles (rad), or rates (rad/s), at given times.
struct AngleTable {
  std::vector<double> t_s;    ///< strictly ascending; at least four
  std::vector<double> value;  ///< one for each time
  double last_digit = 0;      ///< the smallest unit of a last digit printed in the file; 0 if there is no file
  bool operator==(const AngleTable&) const = default;
};

/// A table and the file that it comes from.
struct FiledTable {
  std::shared_ptr<const AngleTable> rows = nullptr;  ///< null where there is none; copies share it
  std::string file = {};                             ///< as the scenario names it
  std::string file_sha256 = {};                      ///< hash of that file's bytes

  /// Two tables are equal if their rows are.
  bool operator==(const FiledTable& other) const {
    const bool same_rows = rows == other.rows || (rows && other.rows && *rows == *other.rows);
    return same_rows && file == other.file && file_sha256 == other.file_sha256;
  }
};

}  // namespace earthtop
