// SPDX-License-Identifier: GPL-3.0-or-later
/// The settings and quantities of a study's document as a page shows them: in words, and in a unit of their size.
#pragma once

#include <string>
#include <vector>

#include "report/html.hpp"

namespace earthtop::report {

/// A setting or a quantity.
struct StudyColumn {
  std::string key;    ///< its name in the document, and in all tables
  std::string where;  ///< the path or the pointers that it stands for
  std::string words;
  std::string unit;       ///< in which its numbers are shown, as signs: "″"; empty for words and pure numbers
  double factor = 1;      ///< how many of it make one of the document's unit
  bool is_angle = false;  ///< whose unit goes with its size

  /// "spin (rad/s)"
  std::string label() const;
  /// The same, with its key on demand; HTML.
  std::string html() const;
  /// A number of the document, with four digits and its unit: "235.2″".
  std::string text(double number, int digits = 4) const;
  /// The same angle, in the unit of one of its numbers.
  StudyColumn in_own_unit(double rad) const;
  /// The same; HTML, with the document's number on demand.
  std::string number(const Json& number, int digits = 4) const;
};

std::vector<StudyColumn> settings_of(const Json& study);
std::vector<StudyColumn> quantities_of(const Json& study);

/// A number with at most so many digits, as a reader writes it: "0.25", "5.5 × 10⁻⁷".
std::string read_number(double number, int digits = 4);

}  // namespace earthtop::report
