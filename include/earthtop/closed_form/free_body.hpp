// SPDX-License-Identifier: GPL-3.0-or-later
/// The free rigid body (Euler-Poinsot): a body without torque about its pivot, attitude included.
#pragma once

#include <memory>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

enum class FreeBodyRegime {
  at_rest,          ///< no rate
  spherical,        ///< three equal moments: a uniform turn about any axis
  principal_axis,   ///< the rate lies exactly along a principal axis: a uniform turn, for ever, also where it is unstable
  symmetric,        ///< two equal moments: regular precession
  around_smallest,  ///< three moments; the rate circles the axis of the smallest one
  around_largest,   ///< three moments; the rate circles the axis of the largest one
  separatrix,       ///< L^2 = 2 T B, B the middle moment: the rate goes from one end of the middle axis to the other, once
};

template <class T>
struct FreeBodyMotion;

/// Torque-free motion of a rigid body about its pivot, in closed form: Jacobi's elliptic functions for the rate, a theta
/// function of complex argument for the turn about the angular momentum. No branch is counted and no direction is singular.
///
/// Moments A, B, C along the axes 1, 2, 3 of P: the principal axes, numbered so that the rate circles axis 3 and B lies between
/// A and C, and turned so that w3 > 0 and w1 >= 0 at t = 0. L and T are the size of the angular momentum and the kinetic
/// energy, l = L_P / L the direction of the angular momentum in the body. Then
///   w = (w1m cn u, s w2m sn u, w3m dn u),  u = p t + u0,  s = sign(C - B)       [Landau and Lifshitz, Mechanics, section 37]
///   R_NP = R_NM Rz(psi) Rmin(l),  dpsi/dt = (2 T + L w3) / (L + C w3),
/// with Rmin the least turn that takes l to axis 3, regular because l3 > 0 always. That exp(i psi / 2) is a linear phase times
/// a theta function of complex argument follows from the zeros of L + C w3 in complex time; the solution by theta functions is
/// Jacobi's, the momentum frame M that of R. van Zon and J. Schofield, J. Comput. Phys. 225 (2007) 145.
///
/// Moments must be finite and positive, the triangle inequality is not needed; anything else gives NaN. The given numbers count
/// as exact, and the statements of error hold for them, as long as moments squared times rates squared stay within the range of
/// long double (for T = double: always) or float128.
template <class T>
class FreeBody {
 public:
  /// @param moments  of the body axes, which are principal axes, about the pivot (kg m^2)
  /// @param q0_NB    attitude at t = 0, of any norm but zero   @param w0_NB_B  rate at t = 0 (rad/s)
  FreeBody(const Vec3<T>& moments, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B);
  /// @param I_BP_B  symmetric inertia tensor about the pivot, in any body axes (kg m^2); only its lower triangle is read. With
  ///   products of inertia the statements of error bound what finding the axes may lose: near an unstable axis far more than it
  ///   does.
  FreeBody(const Mat3<T>& I_BP_B, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B);

  /// The motion at any time, before and after the start (s).
  ClosedFormState<T> at(T t_s) const;

  FreeBodyRegime regime() const { return regime_; }

 private:
  std::shared_ptr<const FreeBodyMotion<T>> motion_;
  FreeBodyRegime regime_;
};

extern template class FreeBody<double>;
extern template class FreeBody<long double>;
extern template class FreeBody<float128>;

}  // namespace earthtop
