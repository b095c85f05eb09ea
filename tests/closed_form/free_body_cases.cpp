// SPDX-License-Identifier: GPL-3.0-or-later
#include "closed_form/free_body_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace earthtop::test {

namespace {

using Engine = std::mt19937_64;

double uniform(Engine& g, double low, double high) { return std::uniform_real_distribution<double>(low, high)(g); }
double log_uniform(Engine& g, double low, double high) { return std::pow(10.0, uniform(g, low, high)); }
double either_sign(Engine& g, double x) { return g() & 1 ? x : -x; }

/// Moments in ascending order, and the rates about their axes; `placed` draws the order of the body axes.
struct Drawn {
  double low = 1, middle = 1, high = 1;
  double w_low = 0, w_middle = 0, w_high = 0;
};

Drawn physical_moments(Engine& g) {
  // Second moments of a mass distribution: their sums in pairs are moments of inertia that satisfy the triangle inequality.
  double s[3] = {uniform(g, 0, 1), uniform(g, 0, 1), uniform(g, 0, 1)};
  std::sort(s, s + 3);
  return {s[0] + s[1], s[0] + s[2], s[1] + s[2], 0, 0, 0};
}
void any_rates(Engine& g, Drawn& d) {
  d.w_low = uniform(g, -1, 1), d.w_middle = uniform(g, -1, 1), d.w_high = uniform(g, -1, 1);
}

/// Draws units, attitude, order and directions of the body axes, and a time of either sign, from 10^shortest to 10^longest rad.
FreeBodyCase placed(Engine& g, const Drawn& d, double longest = 3, double shortest = -2) {
  FreeBodyCase c;
  int order[3] = {0, 1, 2};
  std::shuffle(order, order + 3, g);
  const double inertia = std::ldexp(1.0, static_cast<int>(g() % 40) - 20);
  const double rate = std::ldexp(1.0, static_cast<int>(g() % 20) - 10);
  c.moments[order[0]] = d.low * inertia, c.moments[order[1]] = d.middle * inertia, c.moments[order[2]] = d.high * inertia;
  c.w0_NB_B[order[0]] = either_sign(g, d.w_low * rate);
  c.w0_NB_B[order[1]] = either_sign(g, d.w_middle * rate);
  c.w0_NB_B[order[2]] = either_sign(g, d.w_high * rate);
  std::normal_distribution<double> normal;
  do c.q0_NB = {normal(g), {normal(g), normal(g), normal(g)}};
  while (c.q0_NB.squared_norm() < 0.01);
  const double size = norm(c.w0_NB_B);
  c.t_s = either_sign(g, log_uniform(g, shortest, longest)) / (size > 0 ? size : rate);
  return c;
}

FreeBodyCase asymmetric(Engine& g) {
  Drawn d = physical_moments(g);
  any_rates(g, d);
  return placed(g, d, 4);
}
Drawn circling(Engine& g, bool around_largest) {
  Drawn d = physical_moments(g);
  any_rates(g, d);
  const double large = std::sqrt(d.high * (d.high - d.middle)), small = std::sqrt(d.low * (d.middle - d.low));
  if (around_largest)
    d.w_low = uniform(g, -1, 1) * d.w_high * large / small;
  else
    d.w_high = uniform(g, -1, 1) * d.w_low * small / large;
  return d;
}
FreeBodyCase around_largest(Engine& g) { return placed(g, circling(g, true), 4); }
FreeBodyCase around_smallest(Engine& g) { return placed(g, circling(g, false), 4); }

/// A motion at a given relative distance from the separatrix.
FreeBodyCase at_separatrix(Engine& g, double distance, double longest) {
  Drawn d = physical_moments(g);
  any_rates(g, d);
  if (g() % 2) d.w_low *= log_uniform(g, -9, 0);
  d.w_high = d.w_low * std::sqrt(d.low * (d.middle - d.low) / (d.high * (d.high - d.middle))) * (1 + distance);
  return placed(g, d, longest);
}
FreeBodyCase rounded_separatrix(Engine& g) { return at_separatrix(g, 0, 2); }
FreeBodyCase near_separatrix(Engine& g) { return at_separatrix(g, either_sign(g, log_uniform(g, -16, 0)) * 0.999, 2.5); }
FreeBodyCase exact_separatrix(Engine& g) {
  // Here low (middle - low) = high (high - middle) = 6, and the rates about both axes are equal.
  Drawn d;
  d.low = 2, d.middle = 5, d.high = 6;
  d.w_low = uniform(g, -1, 1) * (g() % 2 ? 1 : log_uniform(g, -9, 0));
  d.w_high = d.w_low;
  d.w_middle = g() % 8 ? uniform(g, -1, 1) : 0;
  return placed(g, d, 2.5);
}

FreeBodyCase spherical(Engine& g) {
  Drawn d;
  any_rates(g, d);
  return placed(g, d, 6);
}
FreeBodyCase nearly_spherical(Engine& g) {
  Drawn d = physical_moments(g);
  const double size = log_uniform(g, -16, -2);
  d.low = 1 + size * (d.low - 1), d.middle = 1 + size * (d.middle - 1), d.high = 1 + size * (d.high - 1);
  any_rates(g, d);
  return placed(g, d, 4);
}
Drawn two_equal(Engine& g, double relative) {
  Drawn d = physical_moments(g);
  (g() & 1 ? d.low : d.high) = d.middle;
  if (d.low == d.middle)
    d.middle *= 1 + relative;
  else
    d.middle *= 1 - relative;
  any_rates(g, d);
  if (g() % 4 == 0) d.w_high *= log_uniform(g, -16, 0);
  if (g() % 4 == 0) d.w_low *= log_uniform(g, -16, 0);
  return d;
}
FreeBodyCase symmetric(Engine& g) { return placed(g, two_equal(g, 0), 5); }
FreeBodyCase nearly_symmetric(Engine& g) { return placed(g, two_equal(g, log_uniform(g, -15.9, -2)), 4); }

FreeBodyCase principal_axis(Engine& g) {
  Drawn d = physical_moments(g);
  (g() % 3 == 0 ? d.w_low : g() % 2 ? d.w_middle : d.w_high) = uniform(g, 0.1, 1);
  return placed(g, d, 6);
}
FreeBodyCase near_axis(Engine& g, int axis, double smallest, double longest) {
  Drawn d = physical_moments(g);
  double* w[3] = {&d.w_low, &d.w_middle, &d.w_high};
  for (int i = 0; i < 3; ++i)
    *w[i] = i == axis ? uniform(g, 0.1, 1) : log_uniform(g, smallest, -1) * static_cast<double>(g() % 4 > 0);
  return placed(g, d, longest);
}
FreeBodyCase near_stable_axis(Engine& g) { return near_axis(g, g() & 1 ? 0 : 2, -17, 4); }
FreeBodyCase near_unstable_axis(Engine& g) { return near_axis(g, 1, -17, 2.5); }
FreeBodyCase tiny_seed(Engine& g) { return near_axis(g, static_cast<int>(g() % 3), -150, 3); }

FreeBodyCase at_rest(Engine& g) { return placed(g, physical_moments(g)); }
FreeBodyCase flat(Engine& g) {
  Drawn d;
  d.low = log_uniform(g, -6, 0), d.middle = 1, d.high = d.low + d.middle;
  if (d.low > d.middle) std::swap(d.low, d.middle);
  any_rates(g, d);
  return placed(g, d, 4);
}
FreeBodyCase needle(Engine& g) {
  Drawn d;
  d.low = log_uniform(g, -9, -2), d.middle = 1, d.high = 1 + d.low * (g() % 3 ? uniform(g, 0, 1) : 0);
  any_rates(g, d);
  if (g() % 2) d.w_low *= log_uniform(g, 0, 9);
  if (g() % 4 == 0) d.w_low *= log_uniform(g, -9, 0);
  return placed(g, d, 4);
}
FreeBodyCase long_runs(Engine& g) {  // up to an hour at 1e6 rad/s
  Drawn d = physical_moments(g);
  any_rates(g, d);
  return placed(g, d, 9.6, 5);
}
FreeBodyCase tensor(Engine& g) {
  FreeBodyCase c;
  switch (g() % 7) {
    case 0: c = nearly_symmetric(g); break;
    case 1: c = nearly_spherical(g); break;
    case 2: c = near_separatrix(g); break;
    case 3: c = near_unstable_axis(g); break;
    case 4: c = needle(g); break;
    case 5: c = principal_axis(g); break;
    default: c = asymmetric(g); break;
  }
  std::normal_distribution<double> normal;
  const Mat3<double> R = rotation_matrix(Quaternion<double>{normal(g), {normal(g), normal(g), normal(g)}});
  const Mat3<double> I = turned_tensor<double>(R, Mat3<double>(c.moments.asDiagonal()));
  c.moments = I.diagonal();
  c.w0_NB_B = times<double>(R, c.w0_NB_B);
  c.products = {I(2, 1), I(2, 0), I(1, 0)};
  return c;
}

}  // namespace

const std::vector<FreeBodyGenerator>& free_body_generators() {
  static const std::vector<FreeBodyGenerator> all = {{"asymmetric", asymmetric},
                                                     {"around largest", around_largest},
                                                     {"around smallest", around_smallest},
                                                     {"exact separatrix", exact_separatrix},
                                                     {"rounded separatrix", rounded_separatrix},
                                                     {"near separatrix", near_separatrix},
                                                     {"spherical", spherical},
                                                     {"nearly spherical", nearly_spherical},
                                                     {"symmetric", symmetric},
                                                     {"nearly symmetric", nearly_symmetric},
                                                     {"principal axis", principal_axis},
                                                     {"near stable axis", near_stable_axis},
                                                     {"near unstable axis", near_unstable_axis},
                                                     {"tiny seed", tiny_seed},
                                                     {"at rest", at_rest},
                                                     {"flat", flat},
                                                     {"needle", needle},
                                                     {"long runs", long_runs},
                                                     {"any axes", tensor}};
  return all;
}

namespace {

/// The closed form in 113 bits, with one of the fourteen inputs changed by one ulp (-1: none).
ClosedFormState<float128> wide_state(const FreeBodyCase& c, int changed = -1) {
  const auto input = [&](int index, double x) {
    return float128(x) * (index == changed ? 1 + float128(real::epsilon<double>()) : float128(1));
  };
  const auto vector = [&](int index, const Vec3<double>& v) {
    return Vec3<float128>(input(index, v[0]), input(index + 1, v[1]), input(index + 2, v[2]));
  };
  const Quaternion<float128> q{input(9, c.q0_NB.w), vector(10, c.q0_NB.v)};
  return free_body<float128>(vector(0, c.moments), vector(3, c.products), q, vector(6, c.w0_NB_B)).at(input(13, c.t_s));
}

}  // namespace

Measure measure(const FreeBodyCase& c) {
  const ClosedFormState<double> state = free_body<double>(c).at(c.t_s);
  const ClosedFormState<float128> exact = wide_state(c);
  Measure m = measure_against(state, exact, 14, [c](int input) { return wide_state(c, input); });
  // The angle about L alone, whose rate is 2 T / L. The motion within the body would add to it.
  Mat3<double> I;
  I << c.moments[0], c.products[2], c.products[1], c.products[2], c.moments[1], c.products[0], c.products[1], c.products[0],
      c.moments[2];
  const Vec3<double> L = I * c.w0_NB_B;
  m.phase = norm(L) > 0 ? std::abs(L.dot(c.w0_NB_B) / norm(L) * c.t_s) : 0;
  m.describe = [c] { return to_string(c); };
  return m;
}

std::string to_string(const FreeBodyCase& c) {
  return fmt::format("I=({:a}, {:a}, {:a}; {:a}, {:a}, {:a}) q0=({:a}, {:a}, {:a}, {:a}) w0=({:a}, {:a}, {:a}) t={:a}",
                     c.moments[0], c.moments[1], c.moments[2], c.products[0], c.products[1], c.products[2], c.q0_NB.w,
                     c.q0_NB.v[0], c.q0_NB.v[1], c.q0_NB.v[2], c.w0_NB_B[0], c.w0_NB_B[1], c.w0_NB_B[2], c.t_s);
}

std::vector<Regime> free_body_regimes() { return regimes_of("Free body", free_body_generators()); }

}  // namespace earthtop::test
