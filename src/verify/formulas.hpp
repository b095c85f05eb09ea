// SPDX-License-Identifier: GPL-3.0-or-later
/// The closed forms that a criterion may name: each function gives the error of a run relative to its formula.
#pragma once

#include "verify/runs.hpp"

namespace earthtop::verify_detail {

// Small motions about the vertical; errors are relative to the effect.
double growth_rate_error(const RunResult& result);
double foucault_rate_error(const RunResult& result);
double resting_axis_error(const RunResult& result);
double mean_lean_error(const RunResult& result);

// Special motions; errors are absolute (rad, or of a cosine), except those of rates, which are relative.
double balanced_axis_error(const RunResult& result);
double steady_precession_error(const RunResult& result);
double homoclinic_tilt_error(const RunResult& result, double until_s);
double separatrix_rates_error(const RunResult& result, double until_s);
double cusp_tilts_error(const RunResult& result);
/// The rotating motion is the reference as seen from a rotating laboratory, q_LB = exp(-[W]t) ref_q_LB, so that the whole drift
/// is this rotation; the error is relative to it. The attitudes in the rows have their own round-off, within the bound that the
/// run states.
double reference_turned_error(const RunResult& result, double until_s);

/// The spin above which an upright top is stable ("sleeps") (rad/s).
double critical_spin_of(const Scene& scene);

}  // namespace earthtop::verify_detail
