// SPDX-License-Identifier: GPL-3.0-or-later
// Compares rows with the closed forms of the whole motion, computed in 113 bits; and the table of all closed forms.
#include <functional>
#include <limits>

#include "earthtop/closed_form/exact_motion.hpp"
#include "earthtop/closed_form/special_cases.hpp"
#include "earthtop/model/model.hpp"
#include "verify/formulas.hpp"
#include "verify/geometry.hpp"
#include "verify/judge.hpp"
#include "verify/scene.hpp"

namespace earthtop::verify_detail {
namespace {

using Q = float128;

/// The closed form of the rotating motion, or of the reference.
class Exact {
 public:
  Exact(const Scene& scene, bool rotating) : release_(scene.release<Q>()) {
    const Model<Q> model = rotating ? scene.model<Q>() : scene.without_rotation().model<Q>();
    if (!has_closed_form(exact_kind(model))) throw NotJudged("this motion has no closed form");
    W_L_ = model.W_IL_L;
    Vec3<Q> w_IB_B = release_.w_XB_B;
    if (release_.X == RatesRelativeTo::laboratory) w_IB_B += rotation_matrix(release_.q_LB).transpose() * W_L_;
    motion_.emplace(exact_body(model), release_.q_LB, w_IB_B);
  }
  Quaternion<Q> q_LB(double t_s) const { return seen_from_laboratory<Q>(motion_->at(t_s), W_L_, t_s).q_LB; }

 private:
  Release<Q> release_;
  Vec3<Q> W_L_;
  std::optional<ExactMotion<Q>> motion_;
};

double attitude_error(const RunResult& result, bool rotating, double until_s) {
  const Exact exact(result.scene, rotating);
  double error = 0;
  for (const DriftRow& row : result.rows)
    if (row.t_s <= until_s)
      error = worse(error, attitude_distance(quaternion<Q>(rotating ? row.q_LB : row.ref_q_LB), exact.q_LB(row.t_s)));
  return error;
}

/// The error of the axis alone: after 1e9 turns a double cannot hold the spin angle accurately.
double axis_error(const RunResult& result, double until_s) {
  const Exact exact(result.scene, true);
  double error = 0;
  for (const DriftRow& row : result.rows) {
    if (row.t_s > until_s) break;
    const Vec3<Q> axis = rotation_matrix(exact.q_LB(row.t_s)).col(2);
    error = worse(error, static_cast<double>(norm(Vec3<Q>(vector<Q>(row.axis_L) - axis))));
  }
  return error;
}

struct Formula {
  std::string_view word;
  std::function<double(const RunResult&, double until_s)> error;
};

const Formula kFormulas[] = {
    {"reference", [](const RunResult& r, double until_s) { return attitude_error(r, false, until_s); }},
    {"motion", [](const RunResult& r, double until_s) { return attitude_error(r, true, until_s); }},
    {"motion_axis", axis_error},
    {"balanced_axis", [](const RunResult& r, double) { return balanced_axis_error(r); }},
    {"steady_precession", [](const RunResult& r, double) { return steady_precession_error(r); }},
    {"homoclinic_tilt", homoclinic_tilt_error},
    {"separatrix_rates", separatrix_rates_error},
    {"cusp_tilts", [](const RunResult& r, double) { return cusp_tilts_error(r); }},
    {"growth_rate", [](const RunResult& r, double) { return growth_rate_error(r); }},
    {"foucault_rate", [](const RunResult& r, double) { return foucault_rate_error(r); }},
    {"resting_axis", [](const RunResult& r, double) { return resting_axis_error(r); }},
    {"mean_lean", [](const RunResult& r, double) { return mean_lean_error(r); }},
};

}  // namespace

double closed_form_error(const CriterionSpec& criterion, Runs& runs) {
  const RunResult& result = runs.run(criterion.set);
  for (const Formula& formula : kFormulas)
    if (formula.word == criterion.quantity)
      return formula.error(result, criterion.until_s.value_or(std::numeric_limits<double>::infinity()));
  throw std::logic_error("no such closed form: " + criterion.quantity);
}

SymmetricTop<double> symmetric_top(const Scene& scene) {
  if (scene.symmetry_axis() != 2) throw NotJudged("the formula is that of a top symmetric about body axis 3");
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  return {inertia(0, 0), inertia(2, 2), scene.axial_gravity_torque_N_m()};
}

Vec3<double> earth_rate_L(const Scene& scene) { return scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site()); }

}  // namespace earthtop::verify_detail
