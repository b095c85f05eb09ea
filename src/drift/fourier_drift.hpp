// SPDX-License-Identifier: GPL-3.0-or-later
/// The drift of a plain symmetric top from the Fourier sums of its two motions (fourier_top.hpp).
#pragma once

#include "earthtop/drift/drift_integration.hpp"

namespace earthtop {

/// An observer other than the laboratory asks for an independent check: the torus is then found in other axes, on a finer grid.
/// A top without such sums ends as not_converged, without a row.
/// @throws std::logic_error for a model that is not a top symmetric about body axis 3
template <class T>
DriftTrajectory<T> fourier_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch);

}  // namespace earthtop
