// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/why.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "closed_form/top_constants.hpp"
#include "earthtop/closed_form/mean_precession.hpp"
#include "earthtop/elementary.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "run/assessment.hpp"
#include "run/support_reports.hpp"
#include "run/why_told.hpp"

namespace earthtop {
namespace why {
namespace {

/// The largest Coriolis torque beside gravity's largest.
void tell_coriolis_torque(Told& told) {
  const double coriolis = largest_length(told.result, [&](const DriftRow& look) { return coriolis_torque_L(told, look); });
  const double gravity = largest_length(
      told.result, [&](const DriftRow& look) { return Vec3<double>(told.mgl * look.axis_L[0], told.mgl * look.axis_L[1], 0); });
  told.add("coriolis_torque",
           fmt::format("To an observer in the laboratory, a Coriolis torque acts on the spinning top, {:.3g} N m at most: "
                       "{:.2g} times gravity's {:.3g} N m.",
                       coriolis, coriolis / gravity, gravity),
           {{"coriolis_torque_N_m", coriolis}, {"gravity_torque_N_m", gravity}, {"ratio", coriolis / gravity}});
}

std::string_view pace(double faster) { return faster < 0 ? "slower" : "faster"; }

/// @param p  rate of precession of the non-rotating prediction (rad/s, counterclockwise about Up)
void tell_laboratory_turns(Told& told, double p) {
  const double up = told.W_L[2], faster = p > 0 ? -up : up;
  if (std::abs(up) <= kNone * told.Omega()) return;
  told.add("laboratory_turns",
           fmt::format("The laboratory turns about its vertical at {}, {:.5g} rad/s {} seen from above; the "
                       "precession, {:.5g} rad/s {}, therefore looks {} from the laboratory by as much.",
                       told.vertical_rate(), std::abs(up), sense(up), std::abs(p), sense(p), pace(faster)),
           {{"laboratory_rate_rad_s", up}, {"precession_rad_s", p}, {"faster_by_rad_s", faster}});
}

/// The half range of the reference's tilt, and its middle.
struct Tilts {
  double middle, swing;
};
Tilts reference_tilts(const std::vector<DriftRow>& rows) {
  double least = std::numbers::pi, most = 0;
  for (const DriftRow& row : rows) {
    const double tilt = real::atan2(real::hypot(row.ref_axis_L[0], row.ref_axis_L[1]), row.ref_axis_L[2]);
    least = std::min(least, tilt), most = std::max(most, tilt);
  }
  return {(least + most) / 2, (most - least) / 2};
}

/// The lean towards the South that the rows show: the amplitude with which the tilt's drift follows the azimuth. Empty where the axis
/// does not go all round, or where rows in step with the precession see it at a few azimuths only.
std::optional<double> seen_lean(const std::vector<DriftRow>& rows) {
  Mat3<double> normal = Mat3<double>::Zero();
  Vec3<double> right = Vec3<double>::Zero();
  for (const DriftRow& row : rows) {
    const double horizontal = real::hypot(row.ref_axis_L[0], row.ref_axis_L[1]);
    if (!(horizontal > 0)) return std::nullopt;
    const Vec3<double> base(1, row.ref_axis_L[0] / horizontal, -row.ref_axis_L[1] / horizontal);  // 1, East, South
    normal += base * base.transpose();
    right += row.drift_tilt_rad * base;
  }
  const double count = static_cast<double>(rows.size());
  normal /= count;
  constexpr double kWellKnown = 0.05;  // the determinant is 1/4 for evenly spread azimuths
  if (!(normal.determinant() > kWellKnown)) return std::nullopt;
  return (normal.inverse() * (right / count))[2];
}

void tell_cone_leans(Told& told, double p) {
  const double north = told.W_L[1], axial = told.I3 * told.scene.release<double>().w_XB_B[2] / told.I1;
  if (std::abs(north) <= kNone * told.Omega()) return;
  const Tilts tilts = reference_tilts(told.result.looks);
  const ConeLean lean = cone_lean(p, axial, real::cos(tilts.middle), real::sin(tilts.middle), tilts.swing, told.W_L);
  const std::optional<double> seen = seen_lean(told.result.looks);
  constexpr double kMostLeftOut = 0.3, kRows = 0.1;  // parts of the lean; kRows: what the rows' nutation may hide of it
  const double size = std::abs(lean.south_rad);
  if (!seen || !(lean.left_out_rad <= kMostLeftOut * size) ||
      std::abs(*seen - lean.south_rad) > lean.left_out_rad + kRows * size)
    return;
  told.add("cone_leans",
           fmt::format("The laboratory turns about North at {}, {:.5g} rad/s; the cone on which the axis "
                       "precesses therefore leans by {} to the {}.",
                       told.northward_rate(), std::abs(north), angle_text(size, 2), lean.south_rad > 0 ? "South" : "North"),
           {{"laboratory_rate_north_rad_s", north},
            {"lean_south_rad", lean.south_rad},
            {"lean_left_out_rad", lean.left_out_rad},
            {"seen_lean_south_rad", *seen}});
}

/// "slower by 5.2534e-05 ± 4.2e-09 rad/s", or that it is neither.
std::string changed(double faster, double error) {
  if (std::abs(faster) <= error) return fmt::format("neither slower nor faster within {:.1e} rad/s", error);
  return fmt::format("{} by {} rad/s", pace(faster), with_error(std::abs(faster), error));
}

void tell_what_is_left(Told& told, double p) {
  const SecularDrift& trend = *told.result.drift.secular;
  const double sign = p > 0 ? 1 : -1, predicted = sign * told.theory->predicted, computed = sign * *told.theory->computed;
  const double of_release = predicted + sign * told.W_L[2];
  const double computed_error = told.theory->computed_error.value_or(0);
  std::string text;
  if (std::abs(of_release) > told.theory->predicted_error)
    text = fmt::format(
        "With this release the Earth changes the top's mean energy and angular momentum, which makes the precession {} by "
        "{:.3g} rad/s. ",
        pace(of_release), std::abs(of_release));
  text += fmt::format("In all, the precession is {} in theory and {} in this run",
                      changed(predicted, told.theory->predicted_error), changed(computed, computed_error));
  std::vector<std::pair<std::string_view, double>> numbers = {{"of_release_faster_by_rad_s", of_release},
                                                              {"predicted_faster_by_rad_s", predicted},
                                                              {"predicted_error_rad_s", told.theory->predicted_error},
                                                              {"computed_faster_by_rad_s", computed},
                                                              {"computed_error_rad_s", computed_error}};
  if (trend.azimuth_oscillation_rad) {
    text += fmt::format("; about this trend the azimuth swings by {} to either side",
                        angle_text(*trend.azimuth_oscillation_rad, 3));
    numbers.emplace_back("azimuth_swing_rad", *trend.azimuth_oscillation_rad);
  }
  told.add("what_is_left", text + ".", std::move(numbers));
}

void tell_precession(Told& told) {
  const Release<double>& release = told.scene.release<double>();
  const std::optional<MeanRates> rates =
      mean_rates(top_constants(told.scene.body<double>(), told.mgl, release.q_LB, release.w_XB_B));
  if (!rates || rates->jumps() || !told.result.drift.secular) return;
  const double p = rates->precession_rad_s;
  // A precession no faster than its change has no sense that lasts.
  constexpr double kFaster = 10;
  if (!(std::abs(p) > kFaster * (std::abs(told.theory->predicted) + told.Omega()))) return;
  tell_earth_turns(told);
  tell_coriolis_torque(told);
  tell_laboratory_turns(told, p);
  tell_cone_leans(told, p);
  tell_what_is_left(told, p);
}

/// Whether theory applies, and the run agrees with it within the errors of both.
bool agrees(const TheoryReport& theory) {
  constexpr double kRounding = 1e-6;  // of the differences from which theory takes its derivatives
  return theory.applies && theory.computed &&
         std::abs(*theory.computed - theory.predicted) <=
             theory.predicted_error + theory.computed_error.value_or(0) + kRounding * std::abs(theory.predicted);
}

/// A body whose moments across the axis are not equal: as it spins, the mean of their inverses counts.
void tell_unequal_moments(Told& told) {
  const Body<double>& body = told.scene.body<double>();
  const Mat3<double>& inertia = body.I_BP_B;
  const Vec3<double>& center = body.p_PBcm_B;
  const std::optional<SecularDrift>& trend = told.result.drift.secular;
  if (!told.scene.is_plain() || told.mgl == 0 || inertia(0, 1) != 0 || inertia(0, 2) != 0 || inertia(1, 2) != 0 ||
      center[0] != 0 || center[1] != 0 || !trend || trend->of_window || !trend->azimuth_rate_rad_s || !trend->turns_seen)
    return;
  const std::optional<MeanPrecession> mean = mean_precession_of_unequal_moments(told.scene);
  if (!mean) return;
  constexpr double kMostLeftOut = 0.3;  // of the Earth's rate
  const double p = mean->precession_rad_s, window_s = trend->window_s[1] - trend->window_s[0];
  const double seen = 2 * std::numbers::pi * *trend->turns_seen / window_s;
  constexpr double kFaster = 10, kSeen = 0.02;
  if (!(std::abs(p) > kFaster * told.Omega()) || std::abs(std::abs(seen) - std::abs(p)) > kSeen * std::abs(p)) return;
  const TheoryReport theory{"precession_rate_change",
                            "",
                            "rad/s",
                            mean->change_rad_s,
                            -*trend->azimuth_rate_rad_s,
                            mean->left_out_rad_s,
                            mean->left_out_rad_s <= kMostLeftOut * told.Omega(),
                            trend->azimuth_rate_bound_95_rad_s};
  if (!agrees(theory) || *theory.computed_error > kMostLeftOut * told.Omega()) return;
  told.theory = &theory;
  tell_earth_turns(told);
  told.add(
      "unequal_moments",
      fmt::format(
          "The moments across the axis, {:.4g} and {:.4g} kg m², are not equal. As the body spins, the mean of their inverses "
          "counts, that of {:.4g} kg m²: with it the precession is {:.4g} rad/s in theory, and it is {:.4g} rad/s in this run.",
          inertia(0, 0), inertia(1, 1), mean->moment_kg_m2, std::abs(p), std::abs(seen)),
      {{"moment_kg_m2", mean->moment_kg_m2},
       {"predicted_precession_rad_s", std::abs(p)},
       {"computed_precession_rad_s", std::abs(seen)}});
  tell_laboratory_turns(told, p);
  tell_what_is_left(told, p);
  told.theory = nullptr;
}

}  // namespace
}  // namespace why

ConeLean cone_lean(double p, double axial, double cos_tilt, double sin_tilt, double swing, const Vec3<double>& W_L) {
  const double m = axial - p * cos_tilt, resonance = m * (m - 2 * p * cos_tilt);
  const double south = W_L[1] / p * (m * m - p * m * cos_tilt - 2 * p * p) / resonance;
  // Left out: the change of the tilt in nutation, and terms of second order in the Earth's rate.
  constexpr double kSwing = 3, kSecondOrder = 3;
  const double of_swing = kSwing * (swing / sin_tilt) * (swing / sin_tilt), of_earth = kSecondOrder * norm(W_L) / std::abs(p);
  return {south, std::abs(south) * (of_swing + of_earth) * (1 + p * p / std::abs(resonance))};
}

void why::tell_on_pivot(Told& told) {
  if (told.scene.symmetry_axis() != 2) {
    tell_turns_with_the_stars(told);
    if (told.sentences.empty()) tell_unequal_moments(told);
  } else if (told.theory == nullptr) {
    tell_pendulum(told);
    tell_unequal_pendulum(told);
    tell_gyrocompass(told);
    tell_rubbed(told);
  } else if (agrees(*told.theory)) {
    if (told.theory->name == "precession_rate_change") tell_precession(told);
    if (told.theory->name == "free_gyro_axis_drift") tell_free_gyroscope(told);
    if (told.theory->name == "sleeping_top_lean_south") tell_sleeping_top(told);
  }
  tell_without_torque(told);
  tell_caged(told);
}

std::vector<WhySentence> why_sentences(const RunResult& result) {
  const VerdictReport& verdict = result.verdict;
  const Scene& scene = result.modelled;
  const bool is_trusted = verdict.verdict == Verdict::reliable && !verdict.from_s && verdict.intervals.empty();
  if (result.status != RunStatus::completed || result.looks.size() < 3 ||
      (!is_trusted && verdict.verdict != Verdict::unstable) || scene.scenario().platform || scene.scenario().effects.tide ||
      !scene.scenario().effects.all_on() || (scene.rotation_rate_rad_s() == 0 && !scene.scenario().travel))
    return {};
  const Body<double>& body = scene.body<double>();
  why::Told told{result,
                 scene,
                 result.theory.empty() ? nullptr : &result.theory.front(),
                 Vec3<double>(scene.rotation_rate_rad_s() * celestial_axis_L<double>(scene.site())),
                 body.I_BP_B(0, 0),
                 body.I_BP_B(2, 2),
                 scene.axial_gravity_torque_N_m(),
                 {}};
  if (scene.scenario().travel)
    why::tell_on_journey(told);
  else if (is_trusted)
    reports_of(scene).tell(told);
  else
    why::tell_turn_over(told);
  return std::move(told.sentences);
}

}  // namespace earthtop
