// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/assessment.hpp"

#include <cmath>

#include "earthtop/model/gimbal_ledger.hpp"
#include "earthtop/model/ledger.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/invariant_follower.hpp"
#include "run/ledger_report.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

template <class T>
Quaternion<T> quaternion(const std::array<T, 4>& q) {
  return {q[0], Vec3<T>(q[1], q[2], q[3])};
}
template <class T>
Vec3<T> vector(const std::array<T, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// Whether gravity has no moment about the outer axis of a suspension: this is upright, or all parts are balanced.
bool is_without_gravity_about_outer_axis(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  const bool is_balanced =
      model.mass_moment_B == Vec3<double>::Zero() && model.gimbals.ring.mass_moment == Vec3<double>::Zero();
  const double tilt = scene.scenario().gimbals->axis_tilt_deg;
  return tilt == 0 || tilt == 180 || is_balanced || scene.site().gravity_m_s2 == 0;
}

/// Whether a journey leads along a parallel, evenly: it is then another Earth that turns faster or slower, with its plumb line tilted.
bool is_along_a_parallel(const TravelSpec& travel) {
  const double course = std::abs(travel.course_deg);
  return travel.path == TravelPath::rhumb && (course == 90 || course == 270) && travel.legs.empty();
}

PivotConditions conditions_of(const Scene& scene) {
  PivotConditions conditions;
  conditions.alone = scene.is_plain() || (scene.support().has_moving_parts() && !scene.scenario().platform &&
                                          !scene.scenario().travel && scene.scenario().effects.plain());
  const EffectsSpec& effects = scene.scenario().effects;
  const SupportKind kind = scene.support().kind;
  if (const auto& travel = scene.scenario().travel;
      travel && effects.plain() && !scene.scenario().platform && (kind == SupportKind::journey || kind == SupportKind::rotor)) {
    conditions.aboard = true;
    conditions.alone = is_along_a_parallel(*travel);
  }
  conditions.beside_support =
      scene.support().is_fixed_pivot && effects.all_on() && !effects.tide && effects.applied.support_alone();
  conditions.gimbals = scene.scenario().gimbals ? &*scene.scenario().gimbals : nullptr;
  if (conditions.gimbals != nullptr) conditions.outer_axis_without_gravity = is_without_gravity_about_outer_axis(scene);
  const auto& rotor = scene.scenario().rotor;
  conditions.masses_move = masses_move(scene.scenario());
  conditions.has_rotor = rotor.has_value();
  if (!rotor) {
    conditions.symmetry_axis = scene.symmetry_axis();
    return conditions;
  }
  conditions.rotor_keeps_momentum = !conditions.masses_move && rotor->drive == RotorDrive::none && !rotor->has_friction();
  conditions.rotor_is_steady = conditions.rotor_keeps_momentum || rotor->drive == RotorDrive::constant;
  return conditions;
}

template <class T>
std::vector<InvariantReport> follow_invariants(const Scene& scene, const std::vector<BasicDriftRow<T>>& rows,
                                               const Watch& watch) {
  const Model<T> model = model_of_rows<T>(scene);
  const PivotConditions conditions = conditions_of(scene);
  std::vector<InvariantReport> reports;
  for (const ConservedQuantity<T>& quantity : kConserved<T>)
    if (quantity.holds_on_pivot != nullptr && quantity.holds_on_pivot(conditions))
      reports.push_back(followed_on_pivot(quantity, model, rows, watch));
  return reports;
}

template <class T>
std::vector<LedgerRow<T>> ledger_rows(const Scene& scene, const std::vector<BasicDriftRow<T>>& rows, const Watch& watch) {
  const Model<T> model = model_of_rows<T>(scene);
  std::vector<LedgerRow<T>> ledger;
  ledger.reserve(rows.size());
  for (const BasicDriftRow<T>& row : rows) {
    if (watch.asks_to_stop()) break;
    if (ledger.size() % 64 == 0) watch.reach(static_cast<double>(ledger.size()) / static_cast<double>(rows.size()));
    const T spin = row.rotor ? row.rotor->rate_rad_s : T(0);
    const LedgerObserver observer = *scene.scenario().ledger;
    ledger.push_back(
        ledger_row(row.gimbals ? ledger_entry_in_gimbals(observer, model, row.t_s, gimbal_angles(*row.gimbals, true), spin)
                               : ledger_entry(observer, model, row.t_s, quaternion_of(row.q_LB), vector_of(row.w_LB_B), spin)));
  }
  return ledger;
}

}  // namespace

std::vector<InvariantReport> assess_invariants(const RunResult& result, const Watch& watch) {
  const Scene& scene = result.modelled;
  if (!scene.is_plain() && !scene.support().has_moving_parts() && !scene.scenario().rotor && !scene.scenario().travel &&
      !scene.scenario().effects.applied.support_alone())
    return {};
  return result.extended_rows.empty() ? follow_invariants(scene, result.rows, watch)
                                      : follow_invariants(scene, result.extended_rows, watch);
}

std::optional<LedgerReport> assess_ledger(const RunResult& result, const Watch& watch) {
  const Scene& scene = result.modelled;
  if (!scene.scenario().ledger) return std::nullopt;
  const LedgerObserver observer = *scene.scenario().ledger;
  return result.extended_rows.empty() ? ledger_report(observer, ledger_rows(scene, result.rows, watch))
                                      : ledger_report(observer, ledger_rows(scene, result.extended_rows, watch));
}

}  // namespace earthtop
