// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/contact_report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drift/derivatives/contact_derivatives.hpp"
#include "earthtop/vectors.hpp"

namespace earthtop {
namespace {

constexpr double kCoefficientShare = 0.01;  // of a coefficient

/// The coefficients that a contact uses. @returns name and change of each, for a change by its own size
std::vector<std::pair<std::string_view, ProblemDerivative>> coefficient_changes(const Contact<double>& contact) {
  using Coefficients = Contact<double>;
  std::vector<std::pair<std::string_view, ProblemDerivative>> made;
  const auto add = [&](bool used, std::string_view name, double Coefficients::*member) {
    if (used) made.emplace_back(name, ProblemDerivative()).second.table.contact.*member = contact.*member;
  };
  const ContactLaw law = contact.law;
  add(law == ContactLaw::coulomb || law == ContactLaw::contensou, "friction_coefficient", &Coefficients::coefficient);
  add(law == ContactLaw::viscous, "sliding_viscosity_N_s_m", &Coefficients::viscosity);
  add(law == ContactLaw::viscous_load, "sliding_viscosity_s_m", &Coefficients::viscosity);
  add(law == ContactLaw::contensou, "patch_radius_m", &Coefficients::patch_radius);
  add(contact.has_spinning_friction, "spinning_friction_m", &Coefficients::spinning_length);
  add(contact.has_rolling_resistance, "rolling_resistance_m", &Coefficients::rolling_length);
  return made;
}

/// The length of the longest of the vectors a cos(x) + b sin(x).
double longest(const Vec3<double>& a, const Vec3<double>& b) {
  const double aa = inner(a, a), bb = inner(b, b), ab = inner(a, b);
  return real::sqrt((aa + bb) / 2 + real::hypot((aa - bb) / 2, ab));
}

}  // namespace

std::vector<PredictionChange> prediction_changes(const DriftProblem<double>& problem, double at_s, const Watch& watch) {
  if (!(at_s > 0)) return {};
  const TableProblem<double>& table = *problem.table;
  const auto coefficients = coefficient_changes(table.contact);
  std::vector<ProblemDerivative> changes;
  changes.reserve(coefficients.size() + 2);  // and the tilt about two axes
  for (const auto& [name, change] : coefficients) changes.push_back(change);
  for (const auto& azimuth : {SinCos<double>{0, 1}, SinCos<double>{1, 0}})
    changes.push_back(table_tilt_change(problem.model, table.start, azimuth));

  const ContactDerivatives found = contact_derivatives(problem, changes, at_s, kContactDerivativeTolerance, watch);
  if (!found.completed) return {};
  std::vector<PredictionChange> moved;
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    moved.push_back({coefficients[i].first, "1 %", kCoefficientShare * norm(found.each[i].axis_L),
                     kCoefficientShare * norm(found.each[i].tip_L_m)});
  const double arcsecond = real::pi<double>() / 648'000;
  const ContactDerivative &north = found.each[coefficients.size()], &east = found.each[coefficients.size() + 1];
  moved.push_back({"table_tilt", "1 arcsec", arcsecond * longest(north.axis_L, east.axis_L),
                   arcsecond * longest(north.tip_L_m, east.tip_L_m)});
  return moved;
}

void assess_prediction_changes(RunResult& result, const Watch& watch) {
  const DriftProblem<double>& problem = result.modelled.problem_without_rows<double>();
  ContactReport& report = *result.contact;
  double before_s = HUGE_VAL;
  for (const ContactEvent& event : report.events)
    if (ends_run(event.kind) || (event.kind == ContactEventKind::slip_stopped && has_exact_coulomb(problem.table->contact)))
      before_s = std::min(before_s, event.t_s);
  const auto row = std::find_if(result.rows.rbegin(), result.rows.rend(),
                                [&](const DriftRow& r) { return r.drift_reliable && r.t_s < before_s; });
  if (row == result.rows.rend()) return;
  report.at_s = row->t_s;
  report.changes = prediction_changes(problem, report.at_s, watch);
}

}  // namespace earthtop
