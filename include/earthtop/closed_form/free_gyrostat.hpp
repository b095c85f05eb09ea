// SPDX-License-Identifier: GPL-3.0-or-later
/// The free gyrostat (case of Zhukovskii and Volterra): the motion of a body in which a rotor turns, without torque about its pivot,
/// including its attitude.
#pragma once

#include <memory>

#include "earthtop/closed_form/state.hpp"

namespace earthtop {

enum class GyrostatRegime {
  uniform,  ///< the rate lies along the momentum, or along the rotor's axis: uniform rotation for ever, also about an unstable axis
  symmetric,     ///< equal moments across the rotor's axis: regular precession
  real_roots,    ///< four real roots: two ovals of momenta have this energy
  complex_roots  ///< two real roots
};

/// How far a body has turned about an axis fixed in it: the integral of w.c from 0 to t.
template <class T>
struct AxialTurn {
  T angle = T(0);  ///< rad
  T error = T(0);  ///< bound on its error (rad)
};

template <class T>
struct FreeGyrostatMotion;

/// Torque-free motion of a body with a constant momentum h c inside, where c is a body axis and a principal one: c h is the momentum of a
/// rotor without friction (h = C (w.c + sigma), moments without the rotor's axial moment C), or of one that a motor drives at a constant
/// rate sigma (h = C sigma, moments with C). In principal axes P whose axis 3 is c, with G = |L|, l = L / G and x = l3,
///   L = (I1 w1, I2 w2, I3 w3 + h),   dL/dt = L x w,   (dx/dt)^2 = a quartic in x
/// (N. Zhukovskii 1885; V. Volterra, Acta Math. 22 (1899) 201). x moves between two of its roots lo < hi,
///   x = (lo c^2 + hi rho s^2) / (c^2 + rho s^2).
/// If the other roots p, q are real, s and c are sn and cn of u = nu t + u0 with the parameter m, and rho = (lo - p) / (hi - p). If they are
/// complex, s and c are sine and cosine of am(2 u | m) / 2, and rho = |lo - p| / |hi - p|. One period of x is 2 K(m) of u in both cases, and
/// l1 and l2 are products of s, c and dn over c^2 + rho s^2. The attitude is
///   R_NP = R_NM Rz(psi) Rmin(l),   dpsi/dt = (w.l + w3) / (1 + x),
/// with Rmin the smallest rotation that takes l to axis 3. Axis 3 is oriented so that the lower end is the one farther from the singular
/// direction -3. psi and the turn about c are a secular part and an integral of the third kind, R_J (DLMF 19.16.2; with conjugate arguments
/// where roots are complex).
///
/// Constants and phases are computed in 113 bits, so that many periods lose nothing in double; the rest in the wider type. The given
/// numbers are taken as exact. Where two roots nearly coincide (a separatrix) the stated error grows: in 113 bits soon, in double only
/// where nearly all of 113 bits are lost. Moments must be finite and positive; otherwise the results are NaN.
template <class T>
class FreeGyrostat {
 public:
  /// @param I_BP_B  inertia (kg m^2); no products between `axis` and the other two; only the lower triangle is read
  /// @param axis  index of the body axis c   @param momentum  h, along plus that axis (kg m^2/s)
  /// @param q0_NB  attitude at t = 0, of any norm but zero   @param w0_NB_B  rate at t = 0 (rad/s)
  FreeGyrostat(const Mat3<T>& I_BP_B, int axis, const T& momentum, const Quaternion<T>& q0_NB, const Vec3<T>& w0_NB_B);

  /// The motion at any time before or after the start (s).
  ClosedFormState<T> at(T t_s) const;
  AxialTurn<T> axial_turn(T t_s) const;

  GyrostatRegime regime() const { return regime_; }

 private:
  bool is_steady() const;

  std::shared_ptr<const FreeGyrostatMotion<T>> motion_;
  GyrostatRegime regime_;
};

extern template class FreeGyrostat<double>;
extern template class FreeGyrostat<float80>;
extern template class FreeGyrostat<float128>;

}  // namespace earthtop
