// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/contact_verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "drift/derivatives/contact_growth.hpp"

namespace earthtop {
namespace {

std::optional<double> first_event(const RunResult& result, ContactEventKind kind) {
  if (!result.contact) return std::nullopt;
  for (const ContactEvent& event : result.contact->events)
    if (event.kind == kind) return event.t_s;
  return std::nullopt;
}

/// Whether neighbouring motions of a symmetric top part in proportion to the time at most: it is integrable without friction,
/// and where it rolls on a level table without moments.
bool is_integrable_on_table(const DriftProblem<double>& problem) {
  const Contact<double>& contact = problem.table->contact;
  if (!is_symmetric(contact) || contact.has_spinning_friction || contact.has_rolling_resistance || contact.air.acts())
    return false;
  const bool level = norm(problem.table->start.q_LH.v) == 0;
  return contact.law == ContactLaw::frictionless || (contact.law == ContactLaw::rolling && level);
}

/// Whether a symmetric top stands well above its critical spin throughout, with its centre of mass above that of the tip's sphere
/// and the tip smaller than that height: it does not fall, and does not turn over as a tippe top.
bool stands_fast(const DriftProblem<double>& problem, const std::vector<DriftRow>& rows) {
  constexpr double kFast = 2;  // square of the spin over the critical one
  const Contact<double>& c = problem.table->contact;
  if (!is_symmetric(c) || !(c.height_of_center > c.tip_radius) || norm(problem.table->start.q_LH.v) > 0) return false;
  const double arm = c.height_of_center + c.tip_radius;
  const double falling = 4 * (c.I1 + c.mass * arm * arm) * c.mass * norm(problem.model.apparent_gravity_L) * arm;
  return std::all_of(rows.begin(), rows.end(), [&](const DriftRow& row) {
    const double momentum = c.I3 * problem.units.rate_from_rad_s(row.ref_w_LB_B[2]);
    return row.ref_axis_L[2] > 0.5 && momentum * momentum > kFast * falling;
  });
}

bool rolls(const DriftRow& row) { return row.contact->state == ContactState::roll; }

/// The problem of a top that rolls on from a row of the non-rotating prediction, after dry friction has stopped its slip.
DriftProblem<double> rolling_on(DriftProblem<double> problem, const DriftRow& row) {
  TableProblem<double>& table = *problem.table;
  table.contact.law = ContactLaw::rolling, table.start.start = ContactStart::rolling;
  const Quaternion<double> q_LB{row.ref_q_LB[0], Vec3<double>(row.ref_q_LB[1], row.ref_q_LB[2], row.ref_q_LB[3])};
  problem.release.q_LB = (table.start.q_LH.conjugate() * q_LB).normalized();
  problem.release.X = RatesRelativeTo::laboratory;
  problem.release.w_XB_B = Vec3<double>(row.ref_w_LB_B[0], row.ref_w_LB_B[1], row.ref_w_LB_B[2]);
  table.start.p_O = Vec3<double>(row.contact->ref_tip_m[0], row.contact->ref_tip_m[1], table.contact.tip_radius);
  return problem;
}

/// Follows disturbances of a run. Exact dry friction has no derivative where the slip stops: they are followed to just before it,
/// and again from the first row at which both predictions roll, where they are as large as they were.
ContactGrowth followed_growth(const DriftProblem<double>& problem, const RunResult& result, const Watch& watch) {
  const bool slides = !rolls(result.looks.front()) || problem.table->contact.law == ContactLaw::rolling;
  const auto stop_s = first_event(result, ContactEventKind::slip_stopped);
  ContactGrowth growth;
  growth.completed = true;
  if (slides) growth = contact_growth(problem, stop_s ? 0.99 * *stop_s : result.reached_s, kContactGrowthTolerance, watch);
  if ((slides && !stop_s) || !growth.completed) return growth;
  const auto row = std::ranges::find_if(result.looks, rolls);
  if (row == result.looks.end() || !(result.reached_s > row->t_s)) return growth;
  ContactGrowth after = contact_growth(rolling_on(problem, *row), result.reached_s - row->t_s, kContactGrowthTolerance, watch);
  const double log_before = std::max(0.0, growth.log_last);
  for (const GrowthPoint& point : after.history)
    growth.history.push_back({point.t_s + row->t_s, point.log_growth + log_before});
  if (!growth.exponential_s && after.exponential_s) growth.exponential_s = *after.exponential_s + row->t_s;
  growth.log_last = after.log_last + log_before;
  growth.end_s = after.end_s + row->t_s;
  growth.completed = after.completed;
  return growth;
}

/// The verdict on a run that needs no growth of disturbances: a motion beyond the onset of a slip is marginal, an integrable one and
/// that of a top which stands fast are reliable. None for the others.
std::optional<VerdictReport> verdict_by_contact(const DriftProblem<double>& problem, const RunResult& result) {
  VerdictReport report;
  if (const auto onset_s = first_event(result, ContactEventKind::slip_started)) {
    report.verdict = Verdict::marginal;
    report.intervals.push_back({*onset_s, {}, Doubt::slip_started});
    report.reason = fmt::format(
        "after {:.6g} s rolling needs more friction than the table gives: how the tip slips from then on is not computed",
        *onset_s);
    return report;
  }
  if (is_integrable_on_table(problem)) {
    report.reason = "the non-rotating prediction is integrable: no disturbance grows exponentially";
    return report;
  }
  if (stands_fast(problem, result.looks)) {
    report.reason = "the top stands, and its spin is well above critical throughout: no disturbance grows exponentially";
    return report;
  }
  return std::nullopt;
}

}  // namespace

GrowthFound growth_on_table(const DriftProblem<double>& problem, const RunResult& result, double log_round_off,
                            const Watch& watch) {
  if (auto settled = verdict_by_contact(problem, result)) return {std::move(settled)};
  const ContactGrowth found = followed_growth(problem, result, watch);
  FollowedGrowth growth;
  growth.completed = found.completed;
  growth.followed_s = found.end_s;
  growth.exponential_s = found.exponential_s;
  if (found.end_s > 0) growth.mean_exponent_1_s = found.log_last / found.end_s;
  if (const auto lost = found.exponential_s ? found.beyond(log_round_off) : std::nullopt) {
    growth.round_off_s = lost->from_s;
    growth.round_off_until_s = lost->until_s;
  }
  // Unlike one in a gimbal or on a pivot, a motion on a table is not called chaotic.
  return {.growth = growth, .is_integrable = true, .contracts = problem.table->contact.law != ContactLaw::frictionless};
}

}  // namespace earthtop
