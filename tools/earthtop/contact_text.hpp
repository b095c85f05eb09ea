// SPDX-License-Identifier: GPL-3.0-or-later
/// The text that `earthtop run` prints about the contact of a top with its table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop::tool {

/// A line with its label, which is empty on a line that continues the one before.
struct LabelledLine {
  std::string_view label;
  std::string text;
  bool is_warning = false;
};

/// The name of an input or a force in words, without its unit.
std::string spoken(std::string_view name);

/// The lines on the drift of the contact point, without labels; none for a fixed pivot.
/// @param last  the row they are about   @param bound_m  largest bound on the rows' errors
std::vector<std::string> tip_drift_lines(const RunResult& result, const DriftRow& last, double bound_m);

/// The events of the contact in plain English.
std::vector<LabelledLine> contact_event_lines(const RunResult& result);

/// The effect of friction's work and of the Earth on the integrals of the motion, and how well the computed motion keeps to
/// it. Empty where the run has no such balances.
std::vector<LabelledLine> contact_balance_lines(const RunResult& result);
/// How much the prediction itself changes with the inputs of the contact, and what that means for the drift.
std::vector<LabelledLine> prediction_change_lines(const RunResult& result);

}  // namespace earthtop::tool
