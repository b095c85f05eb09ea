// SPDX-License-Identifier: GPL-3.0-or-later
// Theory of a laboratory that travels: where a damped compass settles, how a level axis wanders, what a level beam that is carried round
// keeps, and the drift of a body without torque.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "earthtop/model/laboratory_now.hpp"
#include "run/assessment.hpp"
#include "scene/gimbal_rest.hpp"
#include "scene/journey_figures.hpp"

namespace earthtop {
namespace {

/// The integrals over the run of the laboratory's inertial rate about Up, and of its level part.
struct TurnedByLaboratory {
  double up = 0, level = 0;
};
TurnedByLaboratory turned_by_laboratory(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  const double end = scene.scenario().duration_s;
  std::vector<double> corners = model.journey.joints();
  corners.insert(corners.begin(), 0.0);
  corners.push_back(end);
  TurnedByLaboratory turned;
  constexpr double kNode[3] = {-0.7745966692414834, 0, 0.7745966692414834}, kWeight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    constexpr int kParts = 64;  // of Gauss's rule with three nodes
    const double half = (corners[i + 1] - corners[i]) / (2 * kParts);
    for (int part = 0; part < kParts; ++part)
      for (int node = 0; node < 3; ++node) {
        const double t = corners[i] + half * (2 * part + 1 + kNode[node]);
        const Vec3<double> w = LaboratoryNow<double>(model, t).w_IL_L;
        turned.up += half * kWeight[node] * w[2];
        turned.level += half * kWeight[node] * real::hypot(w[0], w[1]);
      }
  }
  return turned;
}

/// Whether the outer axis of a suspension is upright in the laboratory, and free of springs and dry friction.
bool has_upright_axis(const Scene& scene) {
  const Gimbals<double>& gimbals = scene.model<double>().gimbals;
  const Bearing<double>& outer = gimbals.outer;
  return !scene.scenario().platform && scene.scenario().effects.plain() && scene.scenario().moving_masses.empty() &&
         !outer.locked && outer.coulomb == 0 && outer.torsion == 0 && gimbals.R_P0(2, 2) == 1;
}
bool is_balanced(const Model<double>& model) {
  return model.mass_moment_B == Vec3<double>::Zero() && model.gimbals.ring.mass_moment == Vec3<double>::Zero();
}

/// The azimuth of the rotor's axis of the rotating motion, clockwise from North.
double rotor_azimuth(const DriftRow& look) { return real::atan2(look.rotor->axis_L[0], look.rotor->axis_L[1]); }
double rotor_elevation(const DriftRow& look) {
  const auto& n = look.rotor->axis_L;
  return real::atan2(n[2], real::hypot(n[0], n[1]));
}
/// The same angle between -pi and pi.
double short_way(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

/// A damped compass that is held level settles along the level part of the laboratory's inertial rate.
std::optional<TheoryReport> settling_azimuth(const Scene& scene, const std::vector<DriftRow>& looks) {
  const Model<double>& model = scene.model<double>();
  const Gimbals<double>& gimbals = model.gimbals;
  if (!has_upright_axis(scene) || !gimbals.has_rotor || !gimbals.inner.locked || gimbals.outer.viscous == 0 ||
      !is_balanced(model))
    return std::nullopt;
  const double h = std::abs(gimbal_rotor_momentum(scene)), end = scene.scenario().duration_s;
  const LaboratoryNow<double> now(model, end);
  const Vec3<double>&w = now.w_IL_L, &slope = now.alpha_IL_L;
  const double square = w[0] * w[0] + w[1] * w[1];
  constexpr double kLevel = 1e-9;
  if (!(w[1] > 0) || !(h > 0) || !(std::abs(rotor_elevation(looks.front())) < kLevel)) return std::nullopt;
  const double sign = gimbal_rotor_momentum(scene) > 0 ? 1 : -1;
  const auto azimuth = [&](const DriftRow& look) {
    return sign > 0 ? rotor_azimuth(look) : short_way(rotor_azimuth(look) + std::numbers::pi);
  };
  const double last = azimuth(looks.back());
  double swing = 0;  // in the last fifth
  for (auto look = looks.end() - static_cast<std::ptrdiff_t>(looks.size() / 5); look != looks.end(); ++look)
    swing = std::max(swing, std::abs(short_way(azimuth(*look) - last)));
  TheoryReport report;
  report.name = "settling_azimuth";
  report.statement =
      "azimuth at which a damped level compass settles: -atan(v cos C/(M + h) / (Omega cos(latitude) + v sin C/(N + h)))";
  report.unit = "rad";
  report.predicted = azimuth_of(w);
  // It lags behind a direction that turns, by the time in which the damper turns it back.
  const double turning = std::abs(slope[0] * w[1] - slope[1] * w[0]) / square;
  report.predicted_error = 1e-9 + 2 * turning * gimbals.outer.viscous / (h * std::sqrt(square)) + turning * turning / square;
  constexpr double kSettled = 1e-3;
  report.applies = swing < kSettled + turning * end / 5 && report.predicted_error < 0.05;
  report.computed = last;
  report.computed_error = 2 * swing + 1e-12;
  return report;
}

/// A free axis that is level turns in azimuth as the laboratory turns about Up.
std::optional<TheoryReport> wander(const Scene& scene, const std::vector<DriftRow>& looks) {
  const GimbalReleaseSpec& release = *scene.scenario().release.gimbals;
  const Gimbals<double>& gimbals = scene.model<double>().gimbals;
  if (!has_upright_axis(scene) || !gimbals.has_rotor || gimbals.inner.locked || !has_magnus_drift(scene) ||
      release.outer_rate_rad_s != 0 || release.inner_rate_rad_s != 0)
    return std::nullopt;
  constexpr double kLevel = 1e-6;
  if (!(std::abs(rotor_elevation(looks.front())) < kLevel)) return std::nullopt;
  const TurnedByLaboratory turned = turned_by_laboratory(scene);
  double azimuth = 0, elevation = 0;
  for (std::size_t i = 1; i < looks.size(); ++i) {
    azimuth += short_way(rotor_azimuth(looks[i]) - rotor_azimuth(looks[i - 1]));
    elevation = std::max(elevation, std::abs(rotor_elevation(looks[i])));
  }
  TheoryReport report;
  report.name = "directional_gyro_wander";
  report.statement =
      "turn of a level free axis in azimuth: the integral of Omega sin(latitude) + v sin C tan(latitude)/(N + h)";
  report.unit = "rad";
  report.predicted = turned.up;
  constexpr double kNutation = 2e-6;
  report.predicted_error = real::tan(std::min(elevation, 1.0)) * turned.level + kNutation;
  report.applies = report.predicted_error < 0.1 * std::abs(report.predicted);
  report.computed = azimuth;
  report.computed_error = looks.back().drift_axis_bound_rad + 1e-12;
  return report;
}

/// A level beam on an upright axis without friction keeps its momentum about Up, while Up is carried along.
std::optional<TheoryReport> carried_beam(const Scene& scene, const std::vector<DriftRow>& looks) {
  const Model<double>& model = scene.model<double>();
  const Gimbals<double>& gimbals = model.gimbals;
  if (!has_upright_axis(scene) || gimbals.has_rotor || !gimbals.inner.locked || gimbals.outer.viscous != 0 ||
      !is_balanced(model) || gimbals.release.inner != 0 || gimbals.skew_sin != 0 ||
      model.gimbals.ring.I != Mat3<double>::Zero())
    return std::nullopt;
  const Mat3<double>& I = model.I_BP_B;
  if (I(0, 0) != I(1, 1) || I(0, 1) != 0 || I(0, 2) != 0 || I(1, 2) != 0) return std::nullopt;
  const double end = looks.back().t_s;
  const double kept = looks.front().gimbals->outer_rate_rad_s + LaboratoryNow<double>(model, 0.0).w_IL_L[2];
  TheoryReport report;
  report.name = "carried_beam_turn";
  report.statement = "turn of a level beam that keeps its inertial rate about an upright axis which is carried along";
  report.unit = "rad";
  report.predicted = kept * end - turned_by_laboratory(scene).up;
  report.predicted_error = 1e-11 * (1 + std::abs(report.predicted));
  report.computed = looks.back().gimbals->outer_angle_rad - looks.front().gimbals->outer_angle_rad;
  report.computed_error = 1e-11 * (1 + std::abs(*report.computed));
  return report;
}

/// A body without torque, released with the same inertial rates, drifts by the Earth's turn on any journey.
std::optional<TheoryReport> turned_body(const Scene& scene, const std::vector<DriftRow>& looks, const DriftSummary& drift) {
  const Scenario& scenario = scene.scenario();
  const double turned = std::abs(short_way(scene.rotation_rate_rad_s() * looks.back().t_s));
  if (scene.support().has_moving_parts() || scenario.platform || !scenario.effects.plain() ||
      scenario.release.rates_relative_to != RatesRelativeTo::inertial ||
      scenario.travel->reference != TravelReference::same_path || scene.model<double>().mass_moment_B != Vec3<double>::Zero() ||
      !(turned < std::numbers::pi) || turned == 0)
    return std::nullopt;
  TheoryReport report;
  report.name = "free_attitude_drift";
  report.statement = "attitude drift of a body without torque, on any journey: the angle by which the Earth has turned";
  report.unit = "rad";
  report.predicted = turned;
  report.predicted_error = 1e-15 * std::abs(scene.rotation_rate_rad_s()) * looks.back().t_s;
  report.computed = drift.attitude_final_rad;
  report.computed_error = drift.attitude_bound_rad;
  return report;
}

}  // namespace

std::vector<TheoryReport> assess_theory_of_journey(const Scene& scene, const std::vector<DriftRow>& looks,
                                                   const DriftSummary& drift) {
  std::vector<TheoryReport> reports;
  if (looks.size() < 3) return reports;
  const auto add = [&](std::optional<TheoryReport> report) {
    if (report) reports.push_back(*std::move(report));
  };
  if (!scene.support().has_gimbals) {
    add(turned_body(scene, looks, drift));
    return reports;
  }
  if (looks.front().rotor) add(settling_azimuth(scene, looks)), add(wander(scene, looks));
  add(carried_beam(scene, looks));
  return reports;
}

}  // namespace earthtop
