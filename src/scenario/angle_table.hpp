// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of angles as CSV text.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "earthtop/frames/angle_table.hpp"

namespace earthtop::scenario {

/// The first fault of a table and the line in which it stands (1-based).
struct TableFault {
  std::size_t line = 0;
  std::string message;
};

/// The table of a CSV text: the header line `t_s,angle_rad`, then at least four lines of two finite numbers, times strictly
/// ascending and from 0 or before to the duration or after. Lines end with LF or CRLF, the last one may end with the text.
/// @param duration_s  (s); nothing is asked of the last time where it is 0   @returns the table, or its first fault
std::variant<AngleTable, TableFault> parse_angle_table(std::string_view text, double duration_s);

}  // namespace earthtop::scenario
