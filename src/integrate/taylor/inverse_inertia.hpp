// SPDX-License-Identifier: GPL-3.0-or-later
/// Theta^-1 times a vector. Where the body axes are principal axes, it divides by the moments: the rounding of an inverse would
/// be the same at every step and add up to a phase error.
#pragma once

#include "earthtop/model/model.hpp"

namespace earthtop {

template <class T>
class InverseInertia {
 public:
  explicit InverseInertia(const Model<T>& model)
      : moments_(model.I_BP_B.diagonal()), inverse_(model.I_BP_B_inverse), principal_(model.I_BP_B.isDiagonal(T(0))) {}
  Vec3<T> times(const Vec3<T>& v_B) const {
    if (principal_) return v_B.cwiseQuotient(moments_);
    return earthtop::times(inverse_, v_B);
  }

 private:
  Vec3<T> moments_;
  Mat3<T> inverse_;
  bool principal_;
};

}  // namespace earthtop
