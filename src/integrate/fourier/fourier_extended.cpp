// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/fourier/fourier_motion.ipp"
#include "integrate/fourier/fourier_top.ipp"

namespace earthtop {
template class FourierTop<float80>;
template MotionTrajectory<float80> fourier_motion(const MotionProblem<float80>&, const Watch&);
template class FourierTop<float128>;
template MotionTrajectory<float128> fourier_motion(const MotionProblem<float128>&, const Watch&);
}  // namespace earthtop
