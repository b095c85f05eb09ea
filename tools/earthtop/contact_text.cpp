// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/results/compass_point.hpp"
#include "number_text.hpp"
#include "text/number_words.hpp"

namespace earthtop::tool {
namespace {

bool is_level(const RunResult& result) {
  const auto& contact = result.scene.scenario().contact;
  return !contact || contact->table_tilt_deg == 0;
}

std::string_view name_of(Prediction prediction) { return prediction == Prediction::rotating ? "rotating" : "non-rotating"; }

/// When an event of one prediction happens in the other one.
std::string other_time(const ContactEvent& event) {
  if (!event.time_difference_s) return "";
  // The difference is rotating less reference.
  const double later = event.prediction == Prediction::rotating ? -*event.time_difference_s : *event.time_difference_s;
  const std::string_view other =
      name_of(event.prediction == Prediction::rotating ? Prediction::reference : Prediction::rotating);
  if (later == 0) return fmt::format("; in the {} one at the same time", other);
  return fmt::format("; in the {} one {:.6e} s {}", other, std::abs(later), later > 0 ? "later" : "earlier");
}

}  // namespace

std::string spoken(std::string_view name) {
  std::string words(name);
  for (const std::string_view unit : {"_N_s_m", "_s_m", "_m"})
    if (name.ends_with(unit)) {
      words.resize(name.size() - unit.size());
      break;
    }
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::vector<std::string> tip_drift_lines(const RunResult& result, const DriftRow& last, double bound_m) {
  if (!last.contact) return {};
  const BasicContactRow<double>& contact = *last.contact;
  const auto [x, y] = contact.drift_tip_xy_m;
  const std::string size =
      fmt::format("{} = {}", with_bound(contact.drift_tip_m, bound_m, "m"), pictured_length(contact.drift_tip_m));
  const std::string rates =
      fmt::format("slip {:+.6e} m/s, spin {:+.6e} rad/s", contact.drift_slip_m_s, contact.drift_spin_rate_rad_s);
  if (contact.drift_tip_m == 0) return {size, rates};
  if (!is_level(result)) return {size, fmt::format("{:+.6e} m and {:+.6e} m along the table's axes 1 and 2", x, y), rates};
  return {fmt::format("{} to the {}", size, compass_point(x, y)), fmt::format("{:+.6e} m East, {:+.6e} m North", x, y), rates};
}

std::vector<LabelledLine> contact_event_lines(const RunResult& result) {
  std::vector<LabelledLine> lines;
  if (!result.contact) return lines;
  for (const ContactEvent& event : result.contact->events) {
    lines.push_back({"Contact", fmt::format("t = {}, {} prediction: {}{}", time_with_bound(event.t_s, event.bound_s),
                                            name_of(event.prediction), type_of(event.kind).words, other_time(event))});
    if (!event.time_difference_s && !ends_run(event.kind))
      lines.push_back(
          {"",
           fmt::format("the {} one has no such event", event.prediction == Prediction::rotating ? "non-rotating" : "rotating"),
           true});
  }
  return lines;
}

std::vector<LabelledLine> contact_balance_lines(const RunResult& result) {
  std::vector<LabelledLine> lines;
  if (!result.contact) return lines;
  const ContactBalances &rotating = result.contact->rotating, &reference = result.contact->reference;
  // The larger share of the two; nothing where the integral is 0 in both.
  const auto missed = [](const std::optional<ContactBalance>& a, const std::optional<ContactBalance>& b) {
    const std::optional<double> one = share_of(std::abs(a->balance), a->size);
    const std::optional<double> other = b ? share_of(std::abs(b->balance), b->size) : std::nullopt;
    return std::max(one, other);
  };
  if (rotating.jacobi) {
    const double work = rotating.jacobi->integral;
    const std::optional<double> error = missed(rotating.jacobi, reference.jacobi);
    const std::string text = error ? fmt::format("to {:.1e} of its size, in both predictions", *error) : "in both predictions";
    lines.push_back(
        {"Balances", work == 0 ? "friction does no work, and the Jacobi integral is constant " + text
                               : fmt::format("friction does work of {:+.6e} J, and the Jacobi integral changes by as much, {}",
                                             work, text)});
  }
  if (rotating.jellett) {
    const std::optional<double> error = missed(rotating.jellett, reference.jellett);
    lines.push_back(
        {lines.empty() ? "Balances" : "",
         error ? fmt::format("Jellett's integral changes by {:+.6e} kg m^3/s, as the effects of the Earth and of friction's "
                             "moment predict, to {:.1e} of its size",
                             rotating.jellett->last - rotating.jellett->first, *error)
               : "Jellett's integral is 0 at every time, in both predictions"});
  }
  return lines;
}

std::vector<LabelledLine> prediction_change_lines(const RunResult& result) {
  std::vector<LabelledLine> lines;
  if (!result.contact || result.contact->changes.empty()) return lines;
  const ContactReport& contact = *result.contact;
  const DriftRow* row = last_reliable_row(result);
  lines.push_back(
      {"Prediction", fmt::format("by t = {} it changes, with inputs that nobody knows well, by", time_text(contact.at_s))});
  bool of_friction = false;
  for (const PredictionChange& change : contact.changes) {
    of_friction = of_friction || change.step.ends_with("%");
    std::string text = fmt::format("axis {:.2e} rad, tip {:.2e} m per {} of {}", change.axis_rad, change.tip_m, change.step,
                                   spoken(change.input));
    const std::optional<double> times = row ? share_of(row->drift_axis_rad, change.axis_rad) : std::nullopt;
    if (times && row->t_s == contact.at_s) text += fmt::format(" (the Earth's drift of the axis is {:.2g} times that)", *times);
    lines.push_back({"", std::move(text)});
  }
  lines.push_back({"", of_friction ? "nobody knows a coefficient of friction to 1 %, so the prediction is uncertain; the "
                                     "drift, with the same friction in both predictions, is well defined"
                                   : "few tables are level to an arcsecond, so the prediction is uncertain; the drift, on the "
                                     "same table in both predictions, is well defined"});
  return lines;
}

}  // namespace earthtop::tool
