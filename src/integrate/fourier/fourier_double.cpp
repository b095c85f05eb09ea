// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/fourier/fourier_motion.ipp"
#include "integrate/fourier/fourier_top.ipp"

namespace earthtop {
template class FourierTop<double>;
template MotionTrajectory<double> fourier_motion(const MotionProblem<double>&, const Watch&);
}  // namespace earthtop
