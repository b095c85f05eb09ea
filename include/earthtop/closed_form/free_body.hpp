// SPDX-License-Identifier: GPL-3.0-or-later
/// The free rigid body (Euler-Poinsot case): the motion of a body without torque about its pivot, including its attitude.
#pragma once

#include <memory>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

enum class FreeBodyRegime {
  at_rest,          ///< no rate
  spherical,        ///< three equal moments: uniform rotation about any axis
  principal_axis,   ///< the rate lies exactly along a principal axis: uniform rotation for ever, also about an unstable axis
  symmetric,        ///< two equal moments: regular precession
  around_smallest,  ///< three moments; the rate circles the axis of the smallest one
  around_largest,   ///< three moments; the rate circles the axis of the largest one
  separatrix,       ///< L^2 = 2 T B, B the middle moment: the rate passes once from one end of the middle axis to the other
};

template <class T>
struct FreeBodyMotion;

/// Torque-free motion of a rigid body about its pivot, in closed form: the rate by Jacobi's elliptic functions, the rotation
/// about the angular momentum by a theta function of complex argument. No branches have to be counted and no direction is
/// singular.
///
/// A, B, C are the moments along the axes 1, 2, 3 of P. P are the principal axes, numbered so that the rate circles axis 3 and
/// B lies between A and C, and oriented so that w3 > 0 and w1 >= 0 at t = 0. L is the magnitude of the angular momentum, T the
/// kinetic energy, l = L_P / L the direction of the angular momentum in the body. Then
///   w = (w1m cn u, s w2m sn u, w3m dn u),  u = p t + u0,  s = sign(C - B)       [Landau and Lifshitz, Mechanics, section 37]
///   R_NP = R_NM Rz(psi) Rmin(l),  dpsi/dt = (2 T + L w3) / (L + C w3),
/// with Rmin the smallest rotation that takes l to axis 3, which is regular because l3 > 0 always. That exp(i psi / 2) is a
/// linear phase times a theta function of complex argument follows from the zeros of L + C w3 in complex time. The solution by
/// theta functions is due to Jacobi; the momentum frame M is that of R. van Zon and J. Schofield, J. Comput. Phys. 225 (2007)
/// 145.
///
/// Moments must be finite and positive (the triangle inequality is not needed); otherwise the results are NaN. The given
/// numbers are taken as exact. The stated error bounds hold as long as moments squared times rates squared stay within the
/// range of float80 (for T = double: always) or float128.
template <class T>
class FreeBody {
 public:
  /// @param moments  moments about the pivot along the body axes, which must be principal axes (kg m^2)
  /// @param q0_NB    attitude at t = 0, of any norm but zero   @param w0_NB_B  rate at t = 0 (rad/s)
  FreeBody(const Vec3<T>& moments, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B);
  /// @param I_BP_B  symmetric inertia tensor about the pivot, in any body axes (kg m^2); only its lower triangle is read. If it
  /// has products of inertia, the error bounds include what the computation of the principal axes may lose; near an unstable
  /// axis this bound is far larger than the true loss.
  FreeBody(const Mat3<T>& I_BP_B, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B);

  /// The motion at any time before or after the start (s).
  ClosedFormState<T> at(T t_s) const;

  FreeBodyRegime regime() const { return regime_; }

 private:
  std::shared_ptr<const FreeBodyMotion<T>> motion_;
  FreeBodyRegime regime_;
};

extern template class FreeBody<double>;
extern template class FreeBody<float80>;
extern template class FreeBody<float128>;

}  // namespace earthtop
