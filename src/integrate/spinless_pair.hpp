// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "closed_form/complex.hpp"
#include "earthtop/frames/rotation.hpp"

namespace earthtop {

/// The two motions of a symmetric top at one instant, without the spin w3 t that they share. (e_w, epsilon y) is the quaternion of
/// R_ref^T R_rot.
template <class T>
struct SpinlessPair {
  Quaternion<T> ref_q_LF;
  Complex<T> ref_across;
  T e_w = T(1);
  Vec3<T> y = Vec3<T>::Zero();
  Complex<T> across;     ///< rate of the rotating motion's axis relative to the laboratory, in its own frame
  T spin_excess = T(0);  ///< rate of the rotating motion along the axis relative to the laboratory, less w3
};

}  // namespace earthtop
