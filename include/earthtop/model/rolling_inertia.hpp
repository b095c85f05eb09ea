// SPDX-License-Identifier: GPL-3.0-or-later
/// The inertia with which a symmetric body on a table turns while its tip rolls: A = Theta_C + m (rho^2 1 - rho rho^T) with the arm
/// rho = r z + l n from the contact point to the centre of mass. It is a multiple of 1 and two dyads, so that A x = y is solved by
/// two quotients: with d = I1 + m rho^2, e = I3 - I1 and c = n.rho,
///
///   n.x (I3 + m rho^2 + m e c^2/I1) = n.y + (m c/I1) rho.y ,  I1 rho.x = rho.y - e c n.x ,  d x = y - e (n.x) n + m (rho.x) rho
///
/// The first denominator is above I3 and the second above I1.
#pragma once

#include "earthtop/model/contact.hpp"
#include "earthtop/model/contact_algebra.hpp"

namespace earthtop {

template <class S>
class RollingInertia {
 public:
  /// @param z  unit normal of the table   @param n  unit vector along axis 3
  RollingInertia(const Contact<S>& c, const Vec3<S>& z, const Vec3<S>& n) : c_(c), z_(z), n_(n) {
    arm_ = c.tip_radius * z + c.height_of_center * n;
    const S up = inner(z, n);
    along_ = c.tip_radius * up + c.height_of_center;
    const S square = c.tip_radius * c.tip_radius + c.height_of_center * c.height_of_center +
                     S(S(2) * c.tip_radius * c.height_of_center) * up;
    extra_ = c.I3 - c.I1, per_I1_ = S(1) / c.I1;
    inverse_ = S(1) / (c.I1 + c.mass * square);
    about_axis_ = c.I3 + c.mass * square + S(c.mass * extra_ * per_I1_) * (along_ * along_);
  }
  const Vec3<S>& arm() const { return arm_; }
  /// The x of A x = y.
  Vec3<S> solved(const Vec3<S>& y) const {
    const S n_y = inner(n_, y), arm_y = c_.tip_radius * inner(z_, y) + c_.height_of_center * n_y;
    const S n_x = (n_y + S(c_.mass * per_I1_) * (along_ * arm_y)) / about_axis_;
    const S m_arm_x = S(c_.mass * per_I1_) * (arm_y - extra_ * (along_ * n_x));
    const Vec3<S> sum = y + S(c_.height_of_center * m_arm_x - extra_ * n_x) * n_ + S(c_.tip_radius * m_arm_x) * z_;
    return inverse_ * sum;
  }

 private:
  const Contact<S>& c_;
  Vec3<S> z_, n_, arm_;
  S along_, extra_, per_I1_, inverse_, about_axis_;
};

}  // namespace earthtop
