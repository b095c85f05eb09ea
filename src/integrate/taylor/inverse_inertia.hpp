// SPDX-License-Identifier: GPL-3.0-or-later
/// Theta^-1 times a vector: by division where the body axes are principal axes. The rounding of an inverse, the same at every
/// step, would add up to a phase.
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
