// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/assessment.hpp"

#include <cmath>

#include "earthtop/model/invariants.hpp"
#include "earthtop/model/ledger.hpp"
#include "run/invariant_follower.hpp"
#include "run/ledger_report.hpp"

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

template <class T>
std::vector<InvariantReport> follow_invariants(const Scene& scene, const std::vector<BasicDriftRow<T>>& rows,
                                               const Watch& watch) {
  const Body<T>& body = scene.body<T>();
  const Vec3<T> mass_moment_B = body.mass * body.p_PBcm_B;
  const Vec3<T> gravity_L = apparent_gravity_L<T>(scene.site());
  const Vec3<T> W_L = T(scene.rotation_rate_rad_s()) * celestial_axis_L<T>(scene.site());
  const int axis = symmetry_axis(body);
  InvariantFollower<T> jacobi("jacobi_integral", "J"), energy("reference_energy", "J"), spin("inertial_spin", "rad/s");
  for (const BasicDriftRow<T>& row : rows) {
    if (watch.asks_to_stop()) break;
    const Quaternion<T> q = quaternion(row.q_LB);
    const Vec3<T> w_LB_B = vector(row.w_LB_B);
    const auto J = jacobi_integral(body.I_BP_B, mass_moment_B, gravity_L, W_L, q, w_LB_B);
    jacobi.include(J.value, J.scale);
    const auto E = jacobi_integral<T>(body.I_BP_B, mass_moment_B, gravity_L, Vec3<T>::Zero(), quaternion(row.ref_q_LB),
                                      vector(row.ref_w_LB_B));
    energy.include(E.value, E.scale);
    if (axis >= 0) {
      const T w = w_LB_B[axis] + transposed_times(rotation_matrix(q), W_L)[axis];
      spin.include(w, std::max(real::abs(w), norm(w_LB_B)));
    }
  }
  std::vector<InvariantReport> reports{jacobi.report(), energy.report()};
  if (axis >= 0) reports.push_back(spin.report());
  return reports;
}

template <class T>
std::vector<LedgerRow<T>> ledger_rows(const Scene& scene, const std::vector<BasicDriftRow<T>>& rows, const Watch& watch) {
  const Model<T>& model = scene.model<T>();
  std::vector<LedgerRow<T>> ledger;
  ledger.reserve(rows.size());
  for (const BasicDriftRow<T>& row : rows) {
    if (watch.asks_to_stop()) break;
    if (ledger.size() % 64 == 0) watch.reach(static_cast<double>(ledger.size()) / static_cast<double>(rows.size()));
    ledger.push_back(
        ledger_row(ledger_entry(*scene.scenario().ledger, model, row.t_s, quaternion(row.q_LB), vector(row.w_LB_B))));
  }
  return ledger;
}

}  // namespace

std::vector<InvariantReport> assess_invariants(const RunResult& result, const Watch& watch) {
  const Scene& scene = result.modelled;
  if (!scene.is_plain()) return {};
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
