// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/fourier_drift.ipp"

namespace earthtop {
template DriftTrajectory<double> fourier_drift(const DriftProblem<double>&, const IntegrationOptions&, const Watch&);
}  // namespace earthtop
