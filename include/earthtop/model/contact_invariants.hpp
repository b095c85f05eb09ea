// SPDX-License-Identifier: GPL-3.0-or-later
/// The quantities that a top on a table conserves, exactly or up to a known rate; w is the rate relative to the laboratory, L_C the inertial
/// angular momentum about the centre of mass, rho = r z + r_c from the contact point to C, W the Earth's rate:
///
/// | quantity                         | for                        | rate                                  |
/// | Jacobi J                         | any body and law           | dJ/dt = F.v_P + M.w                    |
/// | Jellett lambda = L_C.rho         | symmetric bodies, any law  | dlambda/dt = r L_C.(W x z) + M.rho     |
/// | Routh                            | symmetric, rolling, no M   | 0 on a level table without the Earth  |
///
/// J = m v_C^2/2 + w.Theta_C w/2 - m g.p_C - m |W x p_C|^2/2 - W.Theta_C W/2. Both rates hold where all of the Earth's torques
/// act, and neither a tide nor the gradient of gravitation does.
#pragma once

#include "earthtop/model/general_contact.hpp"
#include "earthtop/model/reduced_contact.hpp"

namespace earthtop {

/// The Jacobi integral, with the size of its terms.
/// @param I  inertia about C in the axes of all arguments   @param p_C, v_C  relative to the laboratory
template <class S>
struct ContactJacobi {
  S value, kinetic, potential;
};
template <class S>
ContactJacobi<S> contact_jacobi(const Contact<S>& c, const ContactSurroundings<S>& around, const Mat3<S>& I, const Vec3<S>& w,
                                const Vec3<S>& p_C, const Vec3<S>& v_C) {
  const Vec3<S>& W = around.W;
  const Vec3<S> Wp = W.cross(p_C);
  const S kinetic = (c.mass * inner(v_C, v_C) + inner(w, times(I, w))) / S(2);
  const S potential = -c.mass * inner(around.gravity, p_C);
  return {kinetic + potential - (c.mass * inner(Wp, Wp) + inner(W, times(I, W))) / S(2), kinetic, potential};
}
template <class S>
ContactJacobi<S> contact_jacobi(const Contact<S>& c, const ContactSurroundings<S>& around, const ReducedContactState<S>& x) {
  const auto k = reduced_contact::kinematics(c, around, x);
  Mat3<S> I;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) I(i, j) = (i == j ? c.I1 : S(0)) + (c.I3 - c.I1) * (x.n[i] * x.n[j]);
  return contact_jacobi(c, around, I, k.w, Vec3<S>(x.p_O + k.r_c), k.v_C);
}
template <class S>
ContactJacobi<S> contact_jacobi(const Contact<S>& c, const ContactSurroundings<S>& around, const GeneralContactState<S>& x) {
  const auto k = general_contact::kinematics(c, around, x);
  return contact_jacobi(c, around, k.I, k.w, Vec3<S>(x.p_O + k.r_c), Vec3<S>(k.v_O + Vec3<S>(k.w.cross(k.r_c))));
}
/// dJ/dt: the power of friction.   @param w  relative to the laboratory
template <class S>
S jacobi_rate(const ContactReaction<S>& reaction, const Vec3<S>& v_P, const Vec3<S>& w) {
  return inner(reaction.friction, v_P) + inner(reaction.moment, w);
}

/// Jellett's lambda = L_C.rho of a symmetric body, and its rate.
template <class S>
S jellett(const Contact<S>& c, const ContactSurroundings<S>& around, const ReducedContactState<S>& x) {
  const Vec3<S> L_C = c.I1 * x.u + S(c.I3 * x.w3) * x.n;
  return inner(L_C, Vec3<S>(c.tip_radius * around.normal + c.height_of_center * x.n));
}
template <class S>
S jellett_rate(const Contact<S>& c, const ContactSurroundings<S>& around, const ReducedContactState<S>& x,
               const ContactReaction<S>& reaction) {
  const Vec3<S> L_C = c.I1 * x.u + S(c.I3 * x.w3) * x.n;
  const Vec3<S> rho = c.tip_radius * around.normal + c.height_of_center * x.n;
  return c.tip_radius * inner(L_C, Vec3<S>(around.W.cross(around.normal))) + inner(reaction.moment, rho);
}

/// Routh's integral w3 sqrt(I1 I3 + m (I1 r^2 sin^2 + I3 (l + r cos)^2)) of pure rolling, with the angle of n to the normal.
template <class S>
S routh(const Contact<S>& c, const ContactSurroundings<S>& around, const ReducedContactState<S>& x) {
  using real::sqrt;
  const S cosine = inner(x.n, around.normal);
  const Vec3<S> across = x.n.cross(around.normal);
  const S lever = c.height_of_center + c.tip_radius * cosine;
  return x.w3 *
         sqrt(c.I1 * c.I3 + c.mass * (c.I1 * c.tip_radius * c.tip_radius * inner(across, across) + c.I3 * lever * lever));
}

}  // namespace earthtop
