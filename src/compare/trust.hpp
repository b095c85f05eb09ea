// SPDX-License-Identifier: GPL-3.0-or-later
/// The times in which the verdicts of two runs do not trust their motions: what they are then is not compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/comparand.hpp"

namespace earthtop::compare {

/// A time from `from_s` (not included) to `until_s`; to the end where that is infinite.
struct Doubted {
  double from_s, until_s;
  bool contains(double t_s) const { return t_s > from_s && t_s < until_s; }
};

/// The times in which the verdict of a run does not trust its motions, ascending, up to `end_s`.
std::vector<Doubted> doubts_of(const Comparand& side, double end_s);
/// Whether the verdict says of the motion that it magnifies rounding, and with it any difference of two runs.
bool magnifies_rounding(const Comparand& side);

/// The times that two runs' verdicts trust together, up to a common end.
struct Trust {
  std::vector<Doubted> doubts;  ///< of either, joined
  std::string fault;            ///< in words, where one verdict trusts far less than the other one; else empty

  bool at(double t_s) const;
  /// Time (s) from which nothing is trusted any more; none where the end is.
  std::optional<double> until_s() const;
};

/// @param least  share of a run's time of trust that the other one has to trust, too
Trust common_trust(const Comparand& reference, const Comparand& candidate, double end_s, double least);

}  // namespace earthtop::compare
