// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/exact_motion.hpp"

#include "earthtop/closed_form/exact_motion.hpp"
#include "earthtop/model/model.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"

namespace earthtop {

template <class T>
ExactLaboratoryMotion<T> exact_laboratory_motion(const Scene& scene) {
  const Model<T>& model = scene.model<T>();
  if (!scene.support().is_fixed_pivot || !has_closed_form(exact_kind(model))) return {};
  const Release<T>& release = scene.release<T>();
  const Vec3<T> W_L = model.W_IL_L;
  Vec3<T> w_IB_B = release.w_XB_B;
  if (release.X == RatesRelativeTo::laboratory) w_IB_B += transposed_times(rotation_matrix(release.q_LB), W_L);
  return [motion = ExactMotion<T>(exact_body(model), release.q_LB, w_IB_B), W_L](T t) {
    return seen_from_laboratory(motion.at(t), W_L, t);
  };
}
template ExactLaboratoryMotion<double> exact_laboratory_motion(const Scene&);
template ExactLaboratoryMotion<float80> exact_laboratory_motion(const Scene&);
template ExactLaboratoryMotion<float128> exact_laboratory_motion(const Scene&);

}  // namespace earthtop
