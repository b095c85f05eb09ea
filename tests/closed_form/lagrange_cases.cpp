// SPDX-License-Identifier: GPL-3.0-or-later
#include "closed_form/lagrange_cases.hpp"

#include <fmt/format.h>

#include <cmath>

namespace earthtop::test {

namespace {

using Engine = std::mt19937_64;

double uniform(Engine& g, double low, double high) { return std::uniform_real_distribution<double>(low, high)(g); }
double log_uniform(Engine& g, double low, double high) { return std::pow(10.0, uniform(g, low, high)); }
double either_sign(Engine& g, double x) { return g() & 1 ? x : -x; }

/// A random body and gravity; `flat` is I3/I1.
LagrangeCase body(Engine& g) {
  LagrangeCase c;
  c.top.I1 = log_uniform(g, -6, 1);
  c.top.I3 = c.top.I1 * (g() % 4 == 0 ? uniform(g, 1, 2) : uniform(g, 0.02, 1));
  c.top.mgl = c.top.I1 * log_uniform(g, -1, 4);
  return c;
}
/// The frequency sqrt(|mgl|/I1) (1/s).
double frequency(const LagrangeCase& c) { return std::sqrt(std::abs(c.top.mgl) / c.top.I1); }
/// The spin below which the upright top falls (rad/s).
double critical_spin(const LagrangeCase& c) { return 2 * frequency(c) * c.top.I1 / c.top.I3; }

/// Sets the start from Euler's angles (z, x, z) and their rates.
void start(LagrangeCase& c, double tilt, double azimuth, double spin_angle, double tilt_rate, double azimuth_rate, double w3) {
  const double cs = std::cos(tilt / 2), sn = std::sin(tilt / 2), plus = (azimuth + spin_angle) / 2;
  const double minus = (azimuth - spin_angle) / 2, across = azimuth_rate * std::sin(tilt);
  c.q0_NB = {cs * std::cos(plus), {sn * std::cos(minus), sn * std::sin(minus), cs * std::sin(plus)}};
  c.w0_NB_B = {tilt_rate * std::cos(spin_angle) + across * std::sin(spin_angle),
               -tilt_rate * std::sin(spin_angle) + across * std::cos(spin_angle), w3};
}
void start_anywhere(Engine& g, LagrangeCase& c, double tilt, double tilt_rate, double azimuth_rate, double w3) {
  start(c, tilt, uniform(g, -3, 3), uniform(g, -3, 3), tilt_rate, azimuth_rate, w3);
}
/// A time of several periods of the small oscillation, of either sign, sometimes very short or long.
double some_time(Engine& g, const LagrangeCase& c, double longest = 3) {
  const double rate = frequency(c) + std::abs(c.w0_NB_B[2]) + c.w0_NB_B.norm();
  return either_sign(g, log_uniform(g, -2, longest)) / (rate > 0 ? rate : 1);
}
double upright(Engine& g) { return uniform(g, 0.05, 3.09); }

LagrangeCase generic(Engine& g) {
  LagrangeCase c = body(g);
  const double f = frequency(c);
  start_anywhere(g, c, upright(g), f * uniform(g, -2, 2), f * uniform(g, -2, 2), f * uniform(g, -6, 6));
  c.t_s = some_time(g, c);
  return c;
}
LagrangeCase fast(Engine& g) {
  LagrangeCase c = body(g);
  const double w3 = either_sign(g, critical_spin(c) * log_uniform(g, 0.5, 4));
  start_anywhere(g, c, upright(g), 0, 0, w3);
  const double rate = std::abs(w3) * log_uniform(g, -6, 0);
  c.w0_NB_B[0] = rate * uniform(g, -1, 1);
  c.w0_NB_B[1] = rate * uniform(g, -1, 1);
  c.t_s = some_time(g, c, 6);
  return c;
}
LagrangeCase cusped(Engine& g) {
  LagrangeCase c = body(g);
  start_anywhere(g, c, upright(g), 0, 0, either_sign(g, critical_spin(c) * log_uniform(g, -2, 3)));
  c.t_s = some_time(g, c, 4);
  return c;
}
LagrangeCase looping(Engine& g) {
  LagrangeCase c = body(g);
  const double w3 = either_sign(g, critical_spin(c) * uniform(g, 1, 10));
  const double slow = c.top.mgl / (c.top.I3 * w3);
  start_anywhere(g, c, upright(g), 0, -slow * uniform(g, 0.1, 2), w3);
  c.t_s = some_time(g, c, 4);
  return c;
}
/// Steady precession, at the rate computed in double.
LagrangeCase steady(Engine& g, bool slow) {
  LagrangeCase c = body(g);
  const double tilt = upright(g), w3 = either_sign(g, critical_spin(c) * (1 + log_uniform(g, -2, 3)));
  const double L = c.top.I3 * w3, root = std::sqrt(std::max(0.0, L * L - 4 * c.top.I1 * c.top.mgl * std::cos(tilt)));
  const double large = L > 0 ? L + root : L - root;
  const double rate = slow ? 2 * c.top.mgl / large : large / (2 * c.top.I1 * std::cos(tilt));
  start_anywhere(g, c, tilt, 0, rate, w3);
  c.t_s = some_time(g, c, 4);
  return c;
}
LagrangeCase slow_steady(Engine& g) { return steady(g, true); }
LagrangeCase fast_steady(Engine& g) { return steady(g, false); }
LagrangeCase nearly_steady(Engine& g) {
  LagrangeCase c = steady(g, g() & 1);
  const double size = log_uniform(g, -15, -2) * c.w0_NB_B.norm();
  c.w0_NB_B[0] += size * uniform(g, -1, 1);
  c.w0_NB_B[1] += size * uniform(g, -1, 1);
  return c;
}
LagrangeCase sleeping(Engine& g) {
  LagrangeCase c = body(g);
  start_anywhere(g, c, 0, 0, 0, either_sign(g, critical_spin(c) * log_uniform(g, -1, 2)));
  c.q0_NB.v[0] = c.q0_NB.v[1] = c.w0_NB_B[0] = c.w0_NB_B[1] = 0;
  c.t_s = some_time(g, c, 4);
  return c;
}
/// A top within 1e-14 ... 0.1 of the upright position, with `f` times the critical spin.
LagrangeCase nearly_upright(Engine& g, double f, double longest) {
  LagrangeCase c = body(g);
  start_anywhere(g, c, log_uniform(g, -14, -1), 0, 0, either_sign(g, critical_spin(c) * f));
  const double rate = g() % 3 ? log_uniform(g, -14, -1) * frequency(c) : 0;
  c.w0_NB_B[0] = rate * uniform(g, -1, 1);
  c.w0_NB_B[1] = rate * uniform(g, -1, 1);
  c.t_s = either_sign(g, log_uniform(g, -2, longest)) / frequency(c);
  return c;
}
LagrangeCase nearly_sleeping(Engine& g) { return nearly_upright(g, uniform(g, 1.01, 5), 3); }
LagrangeCase falling_sleeper(Engine& g) { return nearly_upright(g, uniform(g, 0.02, 0.99), 2.3); }
LagrangeCase critical_sleeper(Engine& g) { return nearly_upright(g, 1 + either_sign(g, log_uniform(g, -16, -2)), 3); }
/// A top within 1e-18 ... 1e-6 of the vertical, near the critical spin and near its single steady rate: the three roots of the
/// nutation's cubic nearly meet.
LagrangeCase critical_upright(Engine& g) {
  LagrangeCase c = body(g);
  const double f = frequency(c), tilt = log_uniform(g, -18, -6);
  const double w3 = critical_spin(c) * (1 + (g() % 4 == 0 ? 0 : either_sign(g, log_uniform(g, -16, -3))));
  const bool backwards = g() & 1;
  const double steady = (1 + (g() % 4 == 0 ? 0 : either_sign(g, log_uniform(g, -16, 0)))) * f;
  start_anywhere(g, c, tilt, 0, backwards ? -steady : steady, backwards ? -w3 : w3);
  if (g() % 3 == 0) {
    const double rate = f * tilt * log_uniform(g, -16, 0);
    c.w0_NB_B[0] += rate * uniform(g, -1, 1);
    c.w0_NB_B[1] += rate * uniform(g, -1, 1);
  }
  c.t_s = either_sign(g, log_uniform(g, -3, 3)) / f;
  if (g() & 1) {  // the same motion with body axes turned by pi about axis 1
    c.top.mgl = -c.top.mgl;
    c.q0_NB = c.q0_NB * Quaternion<double>{0, {1, 0, 0}};
    c.w0_NB_B[1] = -c.w0_NB_B[1];
    c.w0_NB_B[2] = -c.w0_NB_B[2];
  }
  return c;
}
LagrangeCase tiny_upright(Engine& g) {  // tilts and rates down to the least numbers
  LagrangeCase c = nearly_upright(g, log_uniform(g, -1, 1), 3);
  const double size = log_uniform(g, -290, -20);
  c.q0_NB.v[0] = size * uniform(g, -1, 1);
  c.q0_NB.v[1] = size * uniform(g, -1, 1);
  c.w0_NB_B[0] = size * uniform(g, -1, 1);
  c.w0_NB_B[1] = size * uniform(g, -1, 1);
  return c;
}
/// A top on the separatrix of the upright position, within the rounding of double: b = beta and P(1) = 0.
LagrangeCase homoclinic(Engine& g) {
  LagrangeCase c = body(g);
  const double f = frequency(c), w3 = either_sign(g, critical_spin(c) * uniform(g, 0, 0.95));
  const double beta = c.top.I3 * w3 / c.top.I1, low = std::acos(beta * beta / (2 * f * f) - 1);  // lowest tilt
  const double tilt = low * (g() % 5 == 0 ? 1 : log_uniform(g, -3, 0));
  const double azimuth_rate = beta / (1 + std::cos(tilt)), s = 2 * std::sin(tilt / 2);
  const double tilt_rate2 = f * f * s * s - std::pow(azimuth_rate * std::sin(tilt), 2);
  start_anywhere(g, c, tilt, either_sign(g, std::sqrt(std::max(0.0, tilt_rate2))), azimuth_rate, w3);
  c.t_s = either_sign(g, log_uniform(g, -2, 1.7)) / f;
  return c;
}
LagrangeCase nearly_homoclinic(Engine& g) {
  LagrangeCase c = homoclinic(g);
  const double size = log_uniform(g, -15, -1);
  c.w0_NB_B *= 1 + size * uniform(g, -1, 1);
  c.w0_NB_B[0] += frequency(c) * size * uniform(g, -1, 1);
  c.t_s = either_sign(g, log_uniform(g, -2, 2.5)) / frequency(c);
  return c;
}
LagrangeCase hanging(Engine& g) {
  LagrangeCase c = body(g);
  const double pi = 3.141592653589793, f = frequency(c);
  start_anywhere(g, c, pi - log_uniform(g, -14, 0), 0, 0, f * uniform(g, -5, 5) * (g() % 3 != 0));
  const double rate = f * log_uniform(g, -14, 0);
  c.w0_NB_B[0] = rate * uniform(g, -1, 1);
  c.w0_NB_B[1] = rate * uniform(g, -1, 1);
  c.t_s = some_time(g, c, 4);
  return c;
}
LagrangeCase no_gravity(Engine& g) {
  LagrangeCase c = generic(g);
  c.top.mgl = 0;
  c.t_s = some_time(g, c, 4);
  return c;
}
LagrangeCase little_gravity(Engine& g) {
  LagrangeCase c = generic(g);
  const double rate = log_uniform(g, -3, 3);
  c.w0_NB_B *= rate;
  c.top.mgl *= either_sign(g, rate * rate * log_uniform(g, -300, -6));
  c.t_s = some_time(g, c, 4);
  return c;
}
LagrangeCase spherical_pendulum(Engine& g) {
  LagrangeCase c = generic(g);
  c.w0_NB_B[2] = 0;
  return c;
}
/// A pendulum in a plane; `energy` is relative to the upright position, in units of mgl.
LagrangeCase plane(Engine& g, double energy) {
  LagrangeCase c = body(g);
  const double f = frequency(c);
  double tilt = uniform(g, 0.01, 3.13);
  if (1 + energy < std::cos(tilt)) tilt = std::acos(-1 + (2 + energy) * uniform(g, 0, 1));
  const double rate2 = 2 * f * f * (energy + 2 * std::pow(std::sin(tilt / 2), 2));
  const double spin = g() & 1 ? 0 : uniform(g, -3, 3);
  start(c, tilt, uniform(g, -3, 3), spin, 0, 0, 0);
  const double rate = either_sign(g, std::sqrt(std::max(0.0, rate2)));
  c.w0_NB_B = {rate * std::cos(spin), -rate * std::sin(spin), 0};
  c.t_s = either_sign(g, log_uniform(g, -2, 2)) / f;
  return c;
}
LagrangeCase plane_swinging(Engine& g) { return plane(g, -uniform(g, 0.001, 2)); }
LagrangeCase plane_turning(Engine& g) { return plane(g, log_uniform(g, -3, 2)); }
LagrangeCase plane_separatrix(Engine& g) { return plane(g, g() % 3 == 0 ? 0 : either_sign(g, log_uniform(g, -16, -4))); }
LagrangeCase below_pivot(Engine& g) {
  LagrangeCase c = g() & 1 ? generic(g) : fast(g);
  c.top.mgl = -c.top.mgl;
  return c;
}
/// A top that passes the upper or lower vertical at a distance of 1e-16 ... 1e-3 rad, at a time before or after the time of
/// evaluation.
LagrangeCase near_pass(Engine& g, bool upper) {
  LagrangeCase c = body(g);
  const double f = frequency(c), miss = g() % 6 == 0 ? 0 : log_uniform(g, -16, -3);
  const double w3 = f * uniform(g, -6, 6);
  start_anywhere(g, c, upper ? miss : 3.141592653589793 - miss, 0, f * uniform(g, 0.5, 4), w3);
  const double rate = f * uniform(g, 0.3, 4), angle = uniform(g, -3, 3);
  c.w0_NB_B[0] = rate * std::cos(angle);
  c.w0_NB_B[1] = rate * std::sin(angle);
  if (miss == 0) {
    if (upper)
      c.q0_NB.v[0] = c.q0_NB.v[1] = 0;
    else
      c.q0_NB.w = c.q0_NB.v[2] = 0;
  }
  if (g() % 2) {  // start somewhere before or after the pass instead
    const ClosedFormState<double> s = LagrangeTop<double>(c.top, c.q0_NB, c.w0_NB_B).at(uniform(g, -3, 3) / f);
    c.q0_NB = s.q_NB;
    c.w0_NB_B = s.w_NB_B;
  }
  c.t_s = some_time(g, c, 2);
  return c;
}
LagrangeCase upper_pass(Engine& g) { return near_pass(g, true); }
LagrangeCase lower_pass(Engine& g) { return near_pass(g, false); }
LagrangeCase extreme_bodies(Engine& g) {  // needles, discs, spheres
  LagrangeCase c = g() & 1 ? generic(g) : fast(g);
  const int kind = static_cast<int>(g() % 4);
  c.top.I3 = c.top.I1 * (kind == 0 ? log_uniform(g, -12, -2) : kind == 1 ? 2 : 1);
  if (kind == 3) c.top.I3 = std::nextafter(c.top.I1, g() & 1 ? 0 : 1e9);
  return c;
}
LagrangeCase long_runs(Engine& g) {  // up to an hour at 1e6 rad/s
  LagrangeCase c = body(g);
  start_anywhere(g, c, upright(g), 0, 0, either_sign(g, log_uniform(g, 1, 6)));
  c.w0_NB_B[0] = frequency(c) * uniform(g, -1, 1);
  c.w0_NB_B[1] = frequency(c) * uniform(g, -1, 1);
  c.t_s = either_sign(g, log_uniform(g, 1, 3.56));
  return c;
}
LagrangeCase at_rest(Engine& g) {
  LagrangeCase c = body(g);
  start_anywhere(g, c, g() % 2 ? upright(g) : log_uniform(g, -12, -2), 0, 0, 0);
  c.t_s = either_sign(g, log_uniform(g, -2, 2)) / frequency(c);
  return c;
}

/// Zero, or a number of size 1e`low` to 1e`high`, of either sign.
double any_size(Engine& g, double low, double high) { return g() % 8 == 0 ? 0 : either_sign(g, log_uniform(g, low, high)); }
LagrangeCase anything(Engine& g) {
  LagrangeCase c;
  c.top.I1 = log_uniform(g, -6, 1);
  c.top.I3 = c.top.I1 * (g() % 2 ? uniform(g, 0, 2) : log_uniform(g, -8, 0));
  const double from_pole = g() % 4 ? log_uniform(g, -17, 0.49) : 0, scale = log_uniform(g, -3, 3);
  c.top.mgl = c.top.I1 * scale * scale * any_size(g, -12, 4);
  start_anywhere(g, c, g() % 2 ? from_pole : 3.141592653589793 - from_pole, 0, 0, scale * any_size(g, -8, 4));
  if (from_pole == 0) {  // exactly on it
    double* const small = c.q0_NB.w * c.q0_NB.w + c.q0_NB.v[2] * c.q0_NB.v[2] < 0.5 ? &c.q0_NB.w : &c.q0_NB.v[0];
    *small = 0;
    (small == &c.q0_NB.w ? c.q0_NB.v[2] : c.q0_NB.v[1]) = 0;
  }
  c.w0_NB_B[0] = scale * any_size(g, -16, 2);
  c.w0_NB_B[1] = scale * any_size(g, -16, 2);
  c.t_s = some_time(g, c, 3);
  // The time is limited to about twenty doublings of an instability; beyond that, the answer is unknown.
  const double f = frequency(c);
  if (f * std::abs(c.t_s) > 15) c.t_s *= 15 / (f * std::abs(c.t_s));
  return c;
}
/// Steady precession close to either vertical.
LagrangeCase conical(Engine& g) {
  LagrangeCase c = body(g);
  const bool low = g() & 1;
  const double from_pole = log_uniform(g, -12, 0), tilt = low ? 3.141592653589793 - from_pole : from_pole;
  const double w3 = low ? frequency(c) * any_size(g, -3, 2) : either_sign(g, critical_spin(c) * (1 + log_uniform(g, -6, 2)));
  const double L = c.top.I3 * w3, root = std::sqrt(std::max(0.0, L * L - 4 * c.top.I1 * c.top.mgl * std::cos(tilt)));
  const double rate = (L + (g() & 1 ? root : -root)) / (2 * c.top.I1 * std::cos(tilt));
  start_anywhere(g, c, tilt, 0, rate, w3);
  c.t_s = some_time(g, c, 3);
  return c;
}

}  // namespace

const std::vector<LagrangeGenerator>& lagrange_generators() {
  static const std::vector<LagrangeGenerator> all = {{"generic", generic},
                                                     {"fast", fast},
                                                     {"cusped", cusped},
                                                     {"looping", looping},
                                                     {"slow steady", slow_steady},
                                                     {"fast steady", fast_steady},
                                                     {"nearly steady", nearly_steady},
                                                     {"sleeping", sleeping},
                                                     {"nearly sleeping", nearly_sleeping},
                                                     {"falling sleeper", falling_sleeper},
                                                     {"critical sleeper", critical_sleeper},
                                                     {"critical upright", critical_upright},
                                                     {"tiny upright", tiny_upright},
                                                     {"homoclinic", homoclinic},
                                                     {"nearly homoclinic", nearly_homoclinic},
                                                     {"hanging", hanging},
                                                     {"no gravity", no_gravity},
                                                     {"little gravity", little_gravity},
                                                     {"spherical pendulum", spherical_pendulum},
                                                     {"plane swinging", plane_swinging},
                                                     {"plane turning", plane_turning},
                                                     {"plane separatrix", plane_separatrix},
                                                     {"below the pivot", below_pivot},
                                                     {"upper pass", upper_pass},
                                                     {"lower pass", lower_pass},
                                                     {"extreme bodies", extreme_bodies},
                                                     {"long runs", long_runs},
                                                     {"released at rest", at_rest},
                                                     {"conical", conical},
                                                     {"anything", anything}};
  return all;
}

ClosedFormState<float128> wide_state(const LagrangeCase& c, int changed) {
  const auto input = [&](int index, double x) {
    return float128(x) * (index == changed ? 1 + float128(real::epsilon<double>()) : float128(1));
  };
  const SymmetricTop<float128> top{input(0, c.top.I1), input(1, c.top.I3), input(2, c.top.mgl)};
  const Quaternion<float128> q{input(3, c.q0_NB.w), {input(4, c.q0_NB.v[0]), input(5, c.q0_NB.v[1]), input(6, c.q0_NB.v[2])}};
  const Vec3<float128> w{input(7, c.w0_NB_B[0]), input(8, c.w0_NB_B[1]), input(9, c.w0_NB_B[2])};
  return LagrangeTop<float128>(top, q, w).at(input(10, c.t_s));
}

Measure measure(const LagrangeCase& c) {
  const LagrangeTop<double> top(c.top, c.q0_NB, c.w0_NB_B);
  const ClosedFormState<double> state = top.at(c.t_s);
  const ClosedFormState<float128> exact = wide_state(c);
  Measure m = measure_against(state, exact, 11, [c](int input) { return wide_state(c, input); });
  const double t = std::abs(c.t_s), period = top.nutation_period_s();
  m.phase = std::abs(c.w0_NB_B[2]) * t + (std::isfinite(period) ? 2 * 3.141592653589793 * t / period : 0);
  m.describe = [c] { return to_string(c); };
  return m;
}

std::string to_string(const LagrangeCase& c) {
  return fmt::format("I1={:a} I3={:a} mgl={:a} q0=({:a}, {:a}, {:a}, {:a}) w0=({:a}, {:a}, {:a}) t={:a}", c.top.I1, c.top.I3,
                     c.top.mgl, c.q0_NB.w, c.q0_NB.v[0], c.q0_NB.v[1], c.q0_NB.v[2], c.w0_NB_B[0], c.w0_NB_B[1], c.w0_NB_B[2],
                     c.t_s);
}

std::vector<Regime> lagrange_regimes() { return regimes_of("Lagrange", lagrange_generators()); }

}  // namespace earthtop::test
