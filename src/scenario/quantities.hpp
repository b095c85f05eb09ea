// SPDX-License-Identifier: GPL-3.0-or-later
/// The names of what a headline figure or a criterion may be about, separated by '|'.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace earthtop::scenario {

/// Columns of trajectory.csv, and figures of summary.json.
inline constexpr std::string_view kFigures =
    "q_LB_w|q_LB_x|q_LB_y|q_LB_z|w_LB_B_x_rad_s|w_LB_B_y_rad_s|w_LB_B_z_rad_s|"
    "ref_q_LB_w|ref_q_LB_x|ref_q_LB_y|ref_q_LB_z|ref_w_LB_B_x_rad_s|ref_w_LB_B_y_rad_s|ref_w_LB_B_z_rad_s|"
    "axis_L_x|axis_L_y|axis_L_z|ref_axis_L_x|ref_axis_L_y|ref_axis_L_z|"
    "drift_axis_rad|drift_azimuth_rad|drift_tilt_rad|drift_attitude_rad|drift_spin_rad|"
    "drift.axis_max_rad|drift.threshold_time_s|drift.secular.azimuth_rate_rad_s";

/// Vectors of columns (an attitude's error is the angle), and numbers of the whole run.
inline constexpr std::string_view kVectors =
    "q_LB|ref_q_LB|w_LB_B_rad_s|ref_w_LB_B_rad_s|axis_L|ref_axis_L|jacobi_integral_J|reference_energy_J|critical_spin_rad_s";

inline constexpr std::string_view kInvariants =
    "jacobi_integral|reference_energy|inertial_spin|vertical_momentum|kovalevskaya|goryachev_chaplygin";

inline constexpr std::string_view kClosedForms =
    "reference|motion|motion_axis|balanced_axis|steady_precession|homoclinic_tilt|separatrix_rates|cusp_tilts|growth_rate|"
    "foucault_rate|resting_axis|mean_lean";

inline constexpr std::string_view kRelations =
    "same|same_axis|same_drift|mirrored_north_south|proportional_to_earth_rate|reversed_in_time|reference_turned";

inline constexpr std::string_view kZeros = "drift|axis_drift|reference_tilt";

inline constexpr std::string_view kOrders = "step_resonance|convergence";

inline constexpr std::string_view kVerdicts = "reliable|noise_floor|unstable|chaotic|marginal";

/// Several of these lists as one, at compile time.
template <const std::string_view&... lists>
struct Joined {
  static constexpr std::size_t kSize = (lists.size() + ... + (sizeof...(lists) - 1));
  static constexpr std::array<char, kSize> kLetters = [] {
    std::array<char, kSize> letters{};
    std::size_t end = 0;
    const auto add = [&](std::string_view list) {
      if (end > 0) letters[end++] = '|';
      for (const char c : list) letters[end++] = c;
    };
    (add(lists), ...);
    return letters;
  }();
  static constexpr std::string_view text{kLetters.data(), kSize};
};
inline constexpr std::string_view kValues = Joined<kFigures, kVectors>::text;
inline constexpr std::string_view kAllQuantities =
    Joined<kFigures, kVectors, kInvariants, kClosedForms, kRelations, kZeros, kOrders, kVerdicts>::text;

}  // namespace earthtop::scenario
