// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/results/headline.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "results/columns.hpp"
#include "results/figures.hpp"

namespace earthtop {
namespace {

/// The row at time `t`, which may differ from the row's time k x step by rounding; null where there is none.
const DriftRow* row_at(const RunResult& result, double t) {
  const double slack = 1e-9 * std::min(result.scene.scenario().output_step_s, result.scene.scenario().duration_s);
  const auto row = std::find_if(result.rows.begin(), result.rows.end(),
                                [&](const DriftRow& candidate) { return std::abs(candidate.t_s - t) <= slack; });
  return row == result.rows.end() ? nullptr : &*row;
}

std::optional<double> finite(std::optional<double> value) { return value && std::isfinite(*value) ? value : std::nullopt; }

/// Whether the name is that of a figure of the summary: those have a dot, names of columns have none.
bool is_figure(std::string_view quantity) { return quantity.find('.') != std::string_view::npos; }

}  // namespace

std::optional<double> find_figure(const RunResult& result, std::string_view quantity, double t_s) {
  if (is_figure(quantity)) {
    const nlohmann::ordered_json value = summary_part(result, quantity);
    return value.is_number() ? finite(value.get<double>()) : std::nullopt;
  }
  for (const Column& column : trajectory_columns()) {
    if (column.name != quantity) continue;
    const DriftRow* row = row_at(result, t_s);
    return row ? finite(column.value(*row)) : std::nullopt;
  }
  return std::nullopt;
}

std::optional<HeadlineCheck> check_headline(const RunResult& result) {
  if (!result.scene.scenario().headline) return std::nullopt;
  HeadlineCheck check{*result.scene.scenario().headline, {}, {}, {}, false};
  const std::string_view quantity = check.stated.quantity;
  const double t_s = check.stated.at_s.value_or(result.scene.scenario().duration_s);
  if (!is_figure(quantity)) check.at_s = t_s;
  if (!has_drift(result)) return check;
  check.computed = find_figure(result, quantity, t_s);
  if (!check.computed) return check;
  const double trusted_s = check.at_s.value_or(result.scene.scenario().duration_s);
  if (quantity.starts_with("drift") ? !result.verdict.trusts(trusted_s) : result.verdict.doubts_motion(trusted_s)) {
    check.computed.reset();  // such a value means nothing
    return check;
  }
  check.difference = *check.computed - check.stated.value;
  check.met = result.status == RunStatus::completed && std::abs(*check.difference) <= check.stated.tolerance;
  return check;
}

}  // namespace earthtop
