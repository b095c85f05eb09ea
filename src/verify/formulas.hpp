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

}  // namespace earthtop::verify_detail
