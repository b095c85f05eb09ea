#include "bench/exact_motion.hpp"

#include <cmath>

#include "earthtop/closed_form/free_body.hpp"
#include "earthtop/closed_form/lagrange_top.hpp"
#include "run/setup.hpp"

namespace earthtop {

template <class T>
ExactMotion<T> exact_motion(const Scenario& scenario) {
  const auto model = make_model<T>(scenario);
  if (model.kind != SceneKind::plain) return {};
  const auto release = make_release<T>(scenario.release, make_body<T>(scenario.body), T(scenario.site.gravity_m_s2));
  const Vec3<T> W_L = model.W_IL_L;
  Vec3<T> w_IB_B = release.w_XB_B;
  if (release.X == RatesRelativeTo::laboratory) w_IB_B += transposed_times(rotation_matrix(release.q_LB), W_L);

  const bool torque_free = norm(model.mass_moment_B) == T(0) || norm(model.apparent_gravity_L) == T(0);
  if (torque_free)
    return
        [body = FreeBody<T>(model.I_BP_B, release.q_LB, w_IB_B), W_L](T t) { return seen_from_laboratory(body.at(t), W_L, t); };
  const bool gravity_stands_still = W_L[0] == T(0) && W_L[1] == T(0);
  if (!gravity_stands_still || !is_reducible(model)) return {};
  const ReducedTop<T> reduced = reduced_top(model);
  if (reduced.axis != 2) return {};
  const SymmetricTop<T> top{reduced.I1, reduced.I3, model.mass_moment_B[2] * norm(model.apparent_gravity_L)};
  return [motion = LagrangeTop<T>(top, release.q_LB, w_IB_B), W_L](T t) { return seen_from_laboratory(motion.at(t), W_L, t); };
}
template ExactMotion<double> exact_motion(const Scenario&);
template ExactMotion<long double> exact_motion(const Scenario&);
template ExactMotion<float128> exact_motion(const Scenario&);

}  // namespace earthtop
