// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/input_derivatives.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "drift/derivatives/problem_derivative.hpp"
#include "scene/moved_input.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

constexpr double kStep = 0x1p-20;  // step as a share of an input's scale: central differences are good to 1e-12

/// The numbers that the equations of motion use, in float128.
struct Numbers {
  Model<float128> model;
  Release<float128> release;
  std::optional<TableProblem<float128>> table{};
  Mat3<double> gradient_L = Mat3<double>::Zero();
};

Numbers numbers_at(const Scene& scene, std::size_t input, double step, float128& change) {
  const InputKind kind = kInputs[input].kind;
  change = float128(step);
  const bool is_body = kind == InputKind::inertia_ratio || kind == InputKind::center_of_mass;
  if (is_body && !scene.scenario().rotor && scene.scenario().moving_masses.empty()) {
    Body<float128> body = scene.body<float128>();
    move_body(body, kind, change);
    const ReleaseSpec& release = scene.scenario().release;
    const auto& contact = scene.scenario().contact;
    Numbers numbers{make_model<float128>(body, scene.site(), scene.rotation_rate_rad_s(), {}, nullptr, scene.units()),
                    contact ? make_release_on_table<float128>(release, *contact, body, scene.site())
                            : make_release<float128>(release, body, float128(scene.site().gravity_m_s2))};
    if (contact) numbers.table = in_units(table_of(scene, body), scene.units());
    put_support(numbers.model, scene.scenario().effects.applied);
    return numbers;
  }
  MovedScenario moved = with_moved_input(scene, input, step);
  change = float128(moved.change);
  moved.scenario.effects.tide.reset();  // its own dependence on the latitude is left out: 1e-7 of gravity's
  const Scene at = resolve(std::move(moved.scenario));
  Numbers numbers{model_of<float128>(at, scene.units()), at.release<float128>()};
  if (at.scenario().contact) numbers.table = in_units(at.table<float128>(), scene.units());
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

/// The change of the applied torques' coefficients.
AppliedTorques<double> difference(const AppliedTorques<float128>& high, const AppliedTorques<float128>& low,
                                  const Mat3<double>& gradient_L, float128 step) {
  AppliedTorques<double> d;
  d.any = !gradient_L.isZero(0);
  using Gradient = std::array<GradientTerm<float128>, 2>;
  for_each_coefficient(
      [&](float128 a, float128 b, double& quotient_made) {
        quotient_made = quotient(a, b, step);
        d.any = d.any || quotient_made != 0;
      },
      [&](const Gradient&, const Gradient&, std::array<GradientTerm<double>, 2>& terms) {
        if (!gradient_L.isZero(0)) terms = gradient_terms(gradient_L);
      },
      high, low, d);  // an input changes numbers alone
  d.given.acts = high.given.acts, d.given.in_laboratory = high.given.in_laboratory;
  return d;
}

ProblemDerivative difference(const Numbers& high, const Numbers& low, float128 step, float128 epsilon,
                             const NaturalUnits& units) {
  const Model<float128>&a = high.model, &b = low.model;
  Mat3<double> gradient_L = (high.gradient_L - low.gradient_L) / static_cast<double>(step);
  for (double& k : gradient_L.reshaped()) k = real::scale(k, 2 * units.time_exponent);
  ProblemDerivative d;
  const auto divide = ByKind{
      [step](auto& derivative, const auto& in_high, const auto& in_low) { derivative = quotient(in_high, in_low, step); },
      [&](AppliedTorques<double>& derivative, const AppliedTorques<float128>& in_high, const AppliedTorques<float128>& in_low) {
        derivative = difference(in_high, in_low, gradient_L, step);
      },
      [](TideSeries<double>&, const TideSeries<float128>&, const TideSeries<float128>&) {}};
  for_each_derivative(divide, d, a, b);
  d.W_IL_L_scaled = quotient<3, 1>(a.W_IL_L / epsilon, b.W_IL_L / epsilon, step);
  d.q_LB.w = quotient(high.release.q_LB.w, low.release.q_LB.w, step);
  d.q_LB.v = quotient(high.release.q_LB.v, low.release.q_LB.v, step);
  d.w_XB_B = units.rate_from_rad_s(quotient(high.release.w_XB_B, low.release.w_XB_B, step));
  if (high.table) {
    const auto divide_numbers = [step](double& derivative, float128 in_high, float128 in_low) {
      derivative = quotient(in_high, in_low, step);
    };
    for_each_number(divide_numbers, d.table.contact, high.table->contact, low.table->contact);
    for_each_number(divide_numbers, d.table.start, high.table->start, low.table->start);
  }
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
