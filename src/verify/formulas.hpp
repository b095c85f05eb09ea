// SPDX-License-Identifier: GPL-3.0-or-later
/// The closed forms that a criterion may name: each gives the error of a run against its formula.
#pragma once

#include "verify/runs.hpp"

namespace earthtop::verify_detail {

// Of small motions about the vertical, errors relative to the effect.
double growth_rate_error(const RunResult& result);
double foucault_rate_error(const RunResult& result);
double resting_axis_error(const RunResult& result);
double mean_lean_error(const RunResult& result);

// Of special motions, errors absolute (rad, or of a cosine) but for the rates, which are relative.
double balanced_axis_error(const RunResult& result);
double steady_precession_error(const RunResult& result);
double homoclinic_tilt_error(const RunResult& result, double until_s);
double separatrix_rates_error(const RunResult& result, double until_s);
double cusp_tilts_error(const RunResult& result);
/// The rotating motion is the reference seen from a laboratory that turns: q_LB = exp(-[W]t) ref_q_LB, and the whole drift is
/// that turn; relative to it. The rows' attitudes have their own round-off, which the run states.
double reference_turned_error(const RunResult& result, double until_s);

/// The spin above which an upright top sleeps (rad/s).
double critical_spin_of(const Scene& scene);

}  // namespace earthtop::verify_detail
