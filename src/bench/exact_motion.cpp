// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/exact_motion.hpp"

#include "earthtop/closed_form/exact_motion.hpp"
#include "scenario/problem.hpp"

namespace earthtop {

template <class T>
ExactLaboratoryMotion<T> exact_laboratory_motion(const Scenario& scenario) {
  const auto model = make_model<T>(scenario);
  if (!has_closed_form(exact_kind(model))) return {};
  const auto release = make_release<T>(scenario.release, make_body<T>(scenario.body), T(scenario.site.gravity_m_s2));
  const Vec3<T> W_L = model.W_IL_L;
  Vec3<T> w_IB_B = release.w_XB_B;
  if (release.X == RatesRelativeTo::laboratory) w_IB_B += transposed_times(rotation_matrix(release.q_LB), W_L);
  return [motion = ExactMotion<T>(exact_body(model), release.q_LB, w_IB_B), W_L](T t) {
    return seen_from_laboratory(motion.at(t), W_L, t);
  };
}
template ExactLaboratoryMotion<double> exact_laboratory_motion(const Scenario&);
template ExactLaboratoryMotion<long double> exact_laboratory_motion(const Scenario&);
template ExactLaboratoryMotion<float128> exact_laboratory_motion(const Scenario&);

}  // namespace earthtop
