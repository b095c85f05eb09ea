// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/moved_input.hpp"

#include <cmath>
#include <numbers>

#include "earthtop/model/gyrostat.hpp"
#include "earthtop/model/release.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

/// Returns the attitude tilted further from the vertical by `angle` (rad).
std::array<double, 4> leant(const std::array<double, 4>& q_LB, double angle) {
  const Quaternion<double> q{q_LB[0], Vec3<double>(q_LB[1], q_LB[2], q_LB[3])};
  const Mat3<double> R_LB = rotation_matrix(q);
  Vec3<double> axis_L(-R_LB(1, 2), R_LB(0, 2), 0);
  if (norm(axis_L) == 0) axis_L = R_LB.col(1);  // a vertical axis leans toward body axis 1
  const Quaternion<double> turned = Rotation<double>::about(Vec3<double>(axis_L / norm(axis_L)), angle).quaternion() * q;
  return {turned.w, turned.v[0], turned.v[1], turned.v[2]};
}

double length(const std::array<double, 3>& v) { return real::hypot(v[0], v[1], v[2]); }

/// Changes a number. @returns the change after rounding
double add(double& number, double step) {
  const double before = number;
  number += step;
  return number - before;
}

}  // namespace

void set_body(Scenario& scenario, const Scene& scene, const Body<double>& body) {
  const bool has_axial = has_axial_moment(scene);
  const Body<double> alone = without_masses(body, scenario.moving_masses);
  const Body<double> given = scenario.rotor ? without_rotor(alone, *scenario.rotor, has_axial) : alone;
  BodySpec spec;
  spec.mass_kg = given.mass;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    spec.center_of_mass_m[at] = given.p_PBcm_B[i];
    for (int j = 0; j < 3; ++j) spec.inertia_kg_m2[at][static_cast<std::size_t>(j)] = given.I_BP_B(i, j);
  }
  scenario.body = spec;
}

double value_of_input(const Scene& scene, std::size_t input) {
  const InputRow& row = kInputs[input];
  const Scenario& scenario = scene.scenario();
  switch (row.kind) {
    case InputKind::inertia_ratio: return scene.body<double>().I_BP_B(2, 2) / scene.body<double>().I_BP_B(0, 0);
    case InputKind::center_of_mass: return norm(scene.body<double>().p_PBcm_B);
    case InputKind::pivot_offset: return length(scenario.platform->pivot_offset_m);
    case InputKind::tilt: {
      if (!scenario.release.quaternion_LB) return scenario.release.tilt_deg;
      const Vec3<double> n_L = rotation_matrix(scene.release<double>().q_LB).col(2);
      return kDegreesPerRadian * real::atan2(real::hypot(n_L[0], n_L[1]), n_L[2]);
    }
    case InputKind::number: break;
  }
  if (row.name() == "gravity_m_s2") return scene.site().gravity_m_s2;
  if (row.name() == "rotation_rate_rad_s") return scene.rotation_rate_rad_s();
  Scenario copy = scenario;
  return *row.number(copy);
}

double scale_of_input(const Scene& scene, std::size_t input) {
  const InputRow& row = kInputs[input];
  if (row.unit == "deg") return kDegreesPerRadian;
  if (const double value = value_of_input(scene, input); value != 0) return std::abs(value);
  if (row.unit == "rad/s") return scene.fastest_rate_rad_s();
  if (row.unit == "rad/s^2") return scene.fastest_rate_rad_s() / scene.scenario().duration_s;
  if (row.unit == "Hz") return 1 / scene.scenario().duration_s;
  if (row.kind == InputKind::center_of_mass) return std::sqrt(scene.body<double>().I_BP_B(2, 2) / scene.body<double>().mass);
  return 1;
}

MovedScenario with_moved_input(const Scene& scene, std::size_t input, double step) {
  MovedScenario moved{scene.scenario(), step};
  Scenario& scenario = moved.scenario;
  const InputRow& row = kInputs[input];
  switch (row.kind) {
    case InputKind::number: moved.change = add(*row.number(scenario), step); break;
    case InputKind::tilt:
      if (auto& q_LB = scenario.release.quaternion_LB)
        q_LB = leant(*q_LB, step / kDegreesPerRadian);
      else
        moved.change = add(scenario.release.tilt_deg, step);
      break;
    case InputKind::pivot_offset: {
      auto& offset = scenario.platform->pivot_offset_m;
      const double before = length(offset);
      for (double& x : offset) x *= (before + step) / before;
      break;
    }
    case InputKind::inertia_ratio:
    case InputKind::center_of_mass: {
      Body<double> body = scene.body<double>();
      const double I3 = body.I_BP_B(2, 2);
      move_body(body, row.kind, step);
      if (row.kind == InputKind::inertia_ratio) moved.change = (body.I_BP_B(2, 2) - I3) / body.I_BP_B(0, 0);
      set_body(scenario, scene, body);
      break;
    }
  }
  return moved;
}

}  // namespace earthtop
