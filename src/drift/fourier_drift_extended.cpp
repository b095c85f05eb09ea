// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/fourier_drift.ipp"

namespace earthtop {
template DriftTrajectory<float80> fourier_drift(const DriftProblem<float80>&, const IntegrationOptions&, const Watch&);
template DriftTrajectory<float128> fourier_drift(const DriftProblem<float128>&, const IntegrationOptions&, const Watch&);
}  // namespace earthtop
