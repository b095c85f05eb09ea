// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/input_derivatives.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "scene/parts.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kNamed = kInputNames.size();
enum Input : std::size_t { latitude, gravity, spin, tilt, rotation_rate, inertia_ratio, center_of_mass };

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
constexpr double kStep = 0x1p-20;  // step as a share of an input's scale: central differences are good to 1e-12

/// The numbers that the equations of motion use, in float128.
struct Numbers {
  Model<float128> model;
  Release<float128> release;
};

/// The inputs that belong to the scene itself, not to its body.
struct Given {
  Site site;
  double rotation_rate_rad_s;
  ReleaseSpec release;

  explicit Given(const Scene& scene)
      : site(scene.site()), rotation_rate_rad_s(scene.rotation_rate_rad_s()), release(scene.scenario().release) {}
  double& spin_rad_s() {
    return release.angular_velocity_body_rad_s ? (*release.angular_velocity_body_rad_s)[2] : release.spin_rad_s;
  }
};

std::array<double, kNamed> values_of(const Scene& scene) {
  const Body<double>& body = scene.body<double>();
  const Vec3<double> n_L = rotation_matrix(scene.release<double>().q_LB).col(2);
  Given given(scene);
  std::array<double, kNamed> values;
  values[latitude] = given.site.latitude_deg;
  values[gravity] = given.site.gravity_m_s2;
  values[spin] = given.spin_rad_s();
  values[tilt] = given.release.quaternion_LB ? kDegreesPerRadian * real::atan2(real::hypot(n_L[0], n_L[1]), n_L[2])
                                             : given.release.tilt_deg;
  values[rotation_rate] = given.rotation_rate_rad_s;
  values[inertia_ratio] = body.I_BP_B(2, 2) / body.I_BP_B(0, 0);
  values[center_of_mass] = norm(body.p_PBcm_B);
  return values;
}

std::array<double, kNamed> scales_of(const Scene& scene, const std::array<double, kNamed>& values) {
  std::array<double, kNamed> scales;
  for (std::size_t i = 0; i < kNamed; ++i) scales[i] = std::abs(values[i]);
  scales[latitude] = scales[tilt] = kDegreesPerRadian;
  if (scales[gravity] == 0) scales[gravity] = 1;
  if (scales[spin] == 0) scales[spin] = scene.fastest_rate_rad_s();
  if (scales[center_of_mass] == 0)
    scales[center_of_mass] = std::sqrt(scene.body<double>().I_BP_B(2, 2) / scene.scenario().body.mass_kg);
  return scales;
}

/// Returns the attitude tilted further from the vertical by `angle` (rad).
std::array<double, 4> leant(const std::array<double, 4>& q_LB, double angle) {
  const Quaternion<double> q{q_LB[0], Vec3<double>(q_LB[1], q_LB[2], q_LB[3])};
  const Mat3<double> R_LB = rotation_matrix(q);
  Vec3<double> axis_L(-R_LB(1, 2), R_LB(0, 2), 0);
  if (norm(axis_L) == 0) axis_L = R_LB.col(1);  // a vertical axis leans toward body axis 1
  const Quaternion<double> turned = Rotation<double>::about(Vec3<double>(axis_L / norm(axis_L)), angle).quaternion() * q;
  return {turned.w, turned.v[0], turned.v[1], turned.v[2]};
}

/// Moves one input by `step`, in its unit. @returns the change actually made, after rounding
double move(Given& given, std::size_t input, double step) {
  if (input == tilt && given.release.quaternion_LB) {
    given.release.quaternion_LB = leant(*given.release.quaternion_LB, step / kDegreesPerRadian);
    return step;
  }
  double* const numbers[] = {&given.site.latitude_deg, &given.site.gravity_m_s2, &given.spin_rad_s(), &given.release.tilt_deg,
                             &given.rotation_rate_rad_s};
  const double before = *numbers[input];
  *numbers[input] += step;
  return *numbers[input] - before;
}

/// Changes the body's ratio I3/I1 or the distance of its centre of mass; its other numbers about the pivot stay unchanged.
void move(Body<float128>& body, std::size_t input, float128 step) {
  if (input == center_of_mass) {
    const float128 l = norm(body.p_PBcm_B);
    if (l > float128(0))
      body.p_PBcm_B *= (l + step) / l;
    else
      body.p_PBcm_B[2] += step;
    return;
  }
  body.I_BP_B(2, 2) += step * body.I_BP_B(0, 0);
  body.I_BP_B_inverse = body.I_BP_B.inverse();
  body.S_BP_B = body.I_BP_B.trace() / float128(2) * Mat3<float128>::Identity() - body.I_BP_B;
}

Numbers numbers_at(const Scene& scene, std::size_t input, double step, float128& moved) {
  Body<float128> body = scene.body<float128>();
  Given given(scene);
  moved = float128(step);
  if (input < inertia_ratio)
    moved = float128(move(given, input, step));
  else
    move(body, input, moved);
  return {make_model<float128>(body, given.site, given.rotation_rate_rad_s, {}, nullptr, scene.units()),
          make_release<float128>(given.release, body, float128(given.site.gravity_m_s2))};
}

template <int rows, int columns>
Eigen::Matrix<double, rows, columns> quotient(const Eigen::Matrix<float128, rows, columns>& high,
                                              const Eigen::Matrix<float128, rows, columns>& low, float128 step) {
  Eigen::Matrix<double, rows, columns> q;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) q(i, j) = static_cast<double>((high(i, j) - low(i, j)) / step);
  return q;
}

ProblemDerivative difference(const Numbers& high, const Numbers& low, float128 step, float128 epsilon,
                             const NaturalUnits& units) {
  const Model<float128>&a = high.model, &b = low.model;
  ProblemDerivative d;
  d.I_BP_B = quotient(a.I_BP_B, b.I_BP_B, step);
  d.I_BP_B_inverse = quotient(a.I_BP_B_inverse, b.I_BP_B_inverse, step);
  d.S_BP_B = quotient(a.S_BP_B, b.S_BP_B, step);
  d.mass_moment_B = quotient(a.mass_moment_B, b.mass_moment_B, step);
  d.apparent_gravity_L = quotient(a.apparent_gravity_L, b.apparent_gravity_L, step);
  d.W_IL_L_scaled = quotient<3, 1>(a.W_IL_L / epsilon, b.W_IL_L / epsilon, step);
  d.q_LB.w = static_cast<double>((high.release.q_LB.w - low.release.q_LB.w) / step);
  d.q_LB.v = quotient(high.release.q_LB.v, low.release.q_LB.v, step);
  d.w_XB_B = units.rate_from_rad_s(quotient(high.release.w_XB_B, low.release.w_XB_B, step));
  return d;
}

}  // namespace

InputDerivatives input_derivatives(const Scene& scene) {
  InputDerivatives derivatives;
  derivatives.values = values_of(scene);
  derivatives.scales = scales_of(scene, derivatives.values);
  const NaturalUnits& units = scene.units();
  const float128 epsilon = model_of<float128>(scene, units).epsilon;
  for (std::size_t i = 0; i < kNamed; ++i) {
    const double step = kStep * derivatives.scales[i];
    float128 up = 0, down = 0;
    const Numbers high = numbers_at(scene, i, step, up), low = numbers_at(scene, i, -step, down);
    derivatives.by_scaled_input.push_back(difference(high, low, (up - down) / float128(derivatives.scales[i]), epsilon, units));
  }
  return derivatives;
}

std::optional<std::string> sensitivity_refusal(const Scene& scene, double time_s) {
  constexpr double kAffordablePhase = 2e6;  // rad, some minutes of computing; a minute of a toy top has 1.5e4 rad
  if (scene.scenario().contact) return "they are those of a top on a fixed pivot";
  if (scene.scenario().effects.applied.coulomb_N_m != 0) return "dry friction has no derivative where a motion comes to rest";
  if (scene.rotation_rate_rad_s() == 0) return "the Earth does not turn: there is no drift";
  if (time_s == 0) return "no row of the drift is reliable";
  const double damping_rate = scene.pace().damping / scene.scenario().duration_s;
  const double phase = std::max(scene.fastest_rate_rad_s(), damping_rate) * time_s;
  if (phase > kAffordablePhase)
    return fmt::format("{:.1e} rad of the fastest rate would take minutes; at most {:.0e} are done", phase, kAffordablePhase);
  return std::nullopt;
}

double sensitivity_seconds(const Scene& scene, double time_s, double relative_tolerance, std::size_t inputs) {
  // Time of a right-hand side with the variations of four inputs, over that of one for both motions and their deviation, as
  // measured on a toy top, on a body with three different moments and on a gyrocompass.
  constexpr double kAgainstOne = 4;
  const std::size_t groups = (inputs + kInputsAtOnce - 1) / kInputsAtOnce;
  return double(groups) * kAgainstOne * general_evaluation_seconds(scene) *
         variational_work(scene.pace(), time_s, relative_tolerance).evaluations;
}

}  // namespace earthtop
