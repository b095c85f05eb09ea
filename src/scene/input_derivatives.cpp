// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/input_derivatives.hpp"

#include <array>
#include <cmath>

#include "scene/moved_input.hpp"
#include "scene/parts.hpp"

namespace earthtop {
namespace {

constexpr double kStep = 0x1p-20;  // step as a share of an input's scale: central differences are good to 1e-12

/// The numbers that the equations of motion use, in float128.
struct Numbers {
  Model<float128> model;
  Release<float128> release;
  Mat3<double> gradient_L = Mat3<double>::Zero();
};

Numbers numbers_at(const Scene& scene, std::size_t input, double step, float128& change) {
  const InputKind kind = kInputs[input].kind;
  change = float128(step);
  if (kind == InputKind::inertia_ratio || kind == InputKind::center_of_mass) {
    Body<float128> body = scene.body<float128>();
    move_body(body, kind, change);
    return {make_model<float128>(body, scene.site(), scene.rotation_rate_rad_s(), {}, nullptr, scene.units()),
            make_release<float128>(scene.scenario().release, body, float128(scene.site().gravity_m_s2))};
  }
  MovedScenario moved = with_moved_input(scene, input, step);
  change = float128(moved.change);
  moved.scenario.effects.tide.reset();  // its own dependence on the latitude is left out: 1e-7 of gravity's
  const Scene at = resolve(std::move(moved.scenario));
  Numbers numbers{model_of<float128>(at, scene.units()), at.release<float128>()};
  if (const auto& gradient = at.scenario().effects.applied.gravity_gradient)
    numbers.gradient_L = gradient_L(*gradient, at.site());
  return numbers;
}

double quotient(float128 high, float128 low, float128 step) { return static_cast<double>((high - low) / step); }

template <int rows, int columns>
Eigen::Matrix<double, rows, columns> quotient(const Eigen::Matrix<float128, rows, columns>& high,
                                              const Eigen::Matrix<float128, rows, columns>& low, float128 step) {
  Eigen::Matrix<double, rows, columns> q;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) q(i, j) = quotient(high(i, j), low(i, j), step);
  return q;
}

PlatformDerivative difference(const Platform<float128>& high, const Platform<float128>& low, float128 step) {
  PlatformDerivative d;
  const PrescribedMotion<float128>&a = high.turn, &b = low.turn;
  d.rate = quotient(a.rate, b.rate, step), d.acceleration = quotient(a.acceleration, b.acceleration, step);
  d.amplitude = quotient(a.amplitude, b.amplitude, step), d.frequency = quotient(a.frequency, b.frequency, step);
  d.phase = quotient(a.phase, b.phase, step);
  d.pivot_offset_P = quotient(high.pivot_offset_P, low.pivot_offset_P, step);
  return d;
}

/// The change of the applied torques, each of which is proportional to its coefficient.
AppliedTorques<double> difference(const AppliedTorques<float128>& high, const AppliedTorques<float128>& low,
                                  const Mat3<double>& gradient_L, float128 step) {
  AppliedTorques<double> d;
  d.viscous = quotient(high.viscous, low.viscous, step), d.quadratic = quotient(high.quadratic, low.quadratic, step);
  d.coulomb = quotient(high.coulomb, low.coulomb, step);
  d.disc_laminar = quotient(high.disc_laminar, low.disc_laminar, step);
  d.disc_turbulent = quotient(high.disc_turbulent, low.disc_turbulent, step);
  d.gimbal_damping = quotient(high.gimbal_damping, low.gimbal_damping, step);
  if (!gradient_L.isZero(0)) d.gradient = gradient_terms(gradient_L);
  d.any = d.friction() || d.gimbal_damping != 0 || !gradient_L.isZero(0);
  return d;
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
  d.q_LB.w = quotient(high.release.q_LB.w, low.release.q_LB.w, step);
  d.q_LB.v = quotient(high.release.q_LB.v, low.release.q_LB.v, step);
  d.w_XB_B = units.rate_from_rad_s(quotient(high.release.w_XB_B, low.release.w_XB_B, step));
  d.platform = difference(a.platform, b.platform, step);
  Mat3<double> gradient_L = (high.gradient_L - low.gradient_L) / static_cast<double>(step);
  for (double& k : gradient_L.reshaped()) k = real::scale(k, 2 * units.time_exponent);
  d.applied = difference(a.applied, b.applied, gradient_L, step);
  return d;
}

}  // namespace

InputDerivatives input_derivatives(const Scene& scene) {
  InputDerivatives derivatives;
  derivatives.inputs = inputs_of(scene.scenario());
  const NaturalUnits& units = scene.units();
  const float128 epsilon = model_of<float128>(scene, units).epsilon;
  for (const std::size_t input : derivatives.inputs) {
    const double scale = scale_of_input(scene, input), step = kStep * scale;
    derivatives.values.push_back(value_of_input(scene, input));
    derivatives.scales.push_back(scale);
    float128 up = 0, down = 0;
    const Numbers high = numbers_at(scene, input, step, up), low = numbers_at(scene, input, -step, down);
    derivatives.by_scaled_input.push_back(difference(high, low, (up - down) / float128(scale), epsilon, units));
  }
  return derivatives;
}

}  // namespace earthtop
