/// The symmetric top without its spin: axis n and inertial angular momentum L about the pivot, in axes A (laboratory or
/// inertial), and a frame carried along n that has no inertial rate along it.
///
///   dn/dt = L x n / I1 - W x n ,  dL/dt = m l n x g - W x L ,  da/dt = ((L - (L.n) n)/I1 - W) x a
///
/// with W = 0 in inertial axes. L.n = I3 w3 and |n| are conserved; the spin w3 appears in no rate, so that steps follow the
/// nutation. The attitude is the frame (a, n x a, n) turned by w3 t about n.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

/// The numbers the reduced equations read; made from a `Model` in its units.
template <class T>
struct ReducedTop {
  int axis = 2;            ///< the body axis of symmetry: 0, 1 or 2
  T inverse_I1 = T(1);     ///< of the two equal moments across the axis
  T I1 = T(1), I3 = T(1);  ///< pivot moments across and along the axis
  T mass_moment = T(0);    ///< m l, signed along the axis
};

/// Axis, momentum and the first vector of the frame without inertial spin, or their time derivatives.
template <class T>
struct ReducedMotion {
  Vec3<T> n, L, a;
};

/// Whether a model is a symmetric top under nothing but gravity and the Earth's rotation.
template <class T>
bool is_reducible(const Model<T>& model) {
  return model.kind == SceneKind::plain && symmetry_axis(model.I_BP_B, model.mass_moment_B) >= 0;
}

/// @throws std::logic_error for a model that is not reducible.
template <class T>
ReducedTop<T> reduced_top(const Model<T>& model);
extern template ReducedTop<double> reduced_top(const Model<double>&);
extern template ReducedTop<long double> reduced_top(const Model<long double>&);
extern template ReducedTop<float128> reduced_top(const Model<float128>&);

/// m l n / |n|, to second order in the norm's error: the norm must not scale the torque. A deviation from a motion has to take
/// the same moment: a spin phase drift, which turns no axis, would otherwise leave a torque of its own.
template <class T>
Vec3<T> mass_moment_along(const ReducedTop<T>& top, const Vec3<T>& n) {
  return (top.mass_moment * (T(3) - n.dot(n)) / T(2)) * n;
}

/// @param W_A  rate of the axes A   @param field_A  apparent gravity in A   @param spin_momentum  L.n = I3 w3, as released
template <class T>
ReducedMotion<T> reduced_equation(const ReducedTop<T>& top, const ReducedMotion<T>& x, const Vec3<T>& W_A,
                                  const Vec3<T>& field_A, T spin_momentum) {
  const Vec3<T> rate_A = top.inverse_I1 * x.L - W_A;
  return {rate_A.cross(x.n), field_torque(mass_moment_along(top, x.n), field_A) - W_A.cross(x.L),
          Vec3<T>(rate_A - (top.inverse_I1 * spin_momentum) * x.n).cross(x.a)};
}

}  // namespace earthtop
