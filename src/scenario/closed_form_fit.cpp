// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario/closed_form_fit.hpp"

#include "earthtop/closed_form/exact_motion.hpp"

namespace earthtop {
namespace {

Model<double> plain_model(const Scenario& scenario) {
  return make_model<double>(make_body<double>(scenario.body), scenario.site, scenario.rotation_rate_rad_s, {}, nullptr);
}

}  // namespace

ExactKind closed_form_kind(const Scenario& scenario) {
  if (!is_plain(scenario)) return ExactKind::not_plain;
  return exact_kind(plain_model(scenario));
}

double closed_form_turn_rate_rad_s(const Scenario& scenario) {
  const Model<double> model = plain_model(scenario);
  const auto release = make_release<double>(scenario.release, make_body<double>(scenario.body), scenario.site.gravity_m_s2);
  const Vec3<double> W_B = transposed_times(rotation_matrix(release.q_LB), model.W_IL_L);
  const ExactBody<double> body = exact_body(model);
  const auto turn_rate = [&](const Vec3<double>& w_B) { return ExactMotion<double>(body, release.q_LB, w_B).turn_rate(); };
  return turn_rate(release.w_XB_B) + turn_rate(Vec3<double>(release.w_XB_B + W_B)) + norm(model.W_IL_L);
}

}  // namespace earthtop
