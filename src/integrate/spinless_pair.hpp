// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "closed_form/complex.hpp"
#include "earthtop/frames/rotation.hpp"
#include "earthtop/integrate/motion_integration.hpp"

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

/// The sample of a rotating motion at one row of a problem, from its attitude and rates without the spin w3 t.
/// @param w3, across, spin_excess, t  natural units
template <class T>
MotionSample<T> sample_with_spin(const MotionProblem<T>& problem, std::size_t row, const Quaternion<T>& q_LF,
                                 const Complex<T>& across, T w3, T spin_excess, T t) {
  const Quaternion<T> spin = steady_turn(2, w3, t);
  MotionSample<T> sample;
  sample.t_s = T(problem.times_s[row]);
  sample.q_LB = q_LF * spin;
  sample.w_LB_B = transposed_times(rotation_matrix(spin), Vec3<T>(across.re, across.im, w3 + spin_excess));
  for (int k = 0; k < 3; ++k) sample.w_LB_B[k] = problem.units.rate_to_rad_s(sample.w_LB_B[k]);
  return sample;
}

}  // namespace earthtop
