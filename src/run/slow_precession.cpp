// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/slow_precession.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "earthtop/elementary.hpp"

namespace earthtop {
namespace {

/// cos(tilt), momentum along the axis (kg m^2/s) and azimuth (rad).
struct Slow {
  double u = 0, S = 0, azimuth = 0;
};
using Rates = Slow;

/// The numbers that belong to a tilt and a momentum: the rate of precession, the vertical momentum, the level momentum along the axis's azimuth,
/// and their derivatives at constant S or u.
struct Steady {
  double p, vertical, level, vertical_by_u, vertical_by_S, level_by_u;
};
std::optional<Steady> steady(const SlowTop& top, double u, double S) {
  const double square = S * S - 4 * top.I1 * u * top.mgl, sine2 = 1 - u * u;
  if (!(square > 0) || !(sine2 > 0)) return std::nullopt;
  const double p = 2 * top.mgl / (S + std::copysign(std::sqrt(square), S)), sine = std::sqrt(sine2);
  const double slope = S - 2 * top.I1 * u * p, p_u = top.I1 * p * p / slope, p_S = -p / slope, across = S - top.I1 * p * u;
  return Steady{p,
                top.I1 * p * sine2 + S * u,
                across * sine,
                top.I1 * p_u * sine2 - 2 * top.I1 * p * u + S,
                top.I1 * p_S * sine2 + u,
                -top.I1 * (p + u * p_u) * sine - across * u / sine};
}

std::optional<Rates> rates(const SlowTop& top, const Vec3<double>& W_L, const Slow& at, double t) {
  const std::optional<Steady> now = steady(top, at.u, at.S);
  if (!now) return std::nullopt;
  const double sine = std::sqrt(1 - at.u * at.u), east = real::cos(at.azimuth), north = real::sin(at.azimuth);
  const double azimuth_rate = now->p - W_L[2] - W_L[1] * north * now->level_by_u / now->vertical_by_u;
  const double spin = at.S / top.I3 - (W_L[1] * sine * north + W_L[2] * at.u);
  // The body's first axis points up the slope.
  Vec3<double> torque = friction_torque(top.applied, Vec3<double>(azimuth_rate * sine, 0, spin));
  if (top.applied.given.acts) torque[2] += top.applied.given.at(t)[2];
  const double vertical_rate = W_L[1] * now->level * east + torque[0] * sine + torque[2] * at.u;
  return Rates{(vertical_rate - now->vertical_by_S * torque[2]) / now->vertical_by_u, torque[2], azimuth_rate};
}

Slow moved(const Slow& from, const Rates& rate, double h) {
  return {from.u + h * rate.u, from.S + h * rate.S, from.azimuth + h * rate.azimuth};
}

/// A step of the classical Runge-Kutta method.
std::optional<Slow> stepped(const SlowTop& top, const Vec3<double>& W_L, const Slow& from, double t, double h) {
  std::array<Rates, 4> k;
  Slow at = from;
  for (std::size_t stage = 0; stage < k.size(); ++stage) {
    const std::optional<Rates> rate = rates(top, W_L, at, stage == 0 ? t : stage == 3 ? t + h : t + h / 2);
    if (!rate) return std::nullopt;
    k[stage] = *rate;
    at = moved(from, *rate, stage == 2 ? h : h / 2);
  }
  return moved(moved(moved(moved(from, k[0], h / 6), k[1], h / 3), k[2], h / 3), k[3], h / 6);
}

/// The state without nutation that has these momenta.
std::optional<Slow> without_nutation(const SlowTop& top, double vertical, double S) {
  constexpr int kSteps = 20;
  Slow at{top.cos_tilt, S, top.azimuth_rad};
  for (int i = 0; i < kSteps; ++i) {
    const std::optional<Steady> now = steady(top, at.u, S);
    if (!now) return std::nullopt;
    at.u -= (now->vertical - vertical) / now->vertical_by_u;
  }
  return steady(top, at.u, S) ? std::optional(at) : std::nullopt;
}

}  // namespace

std::optional<SlowPrecession> slow_precession(const SlowTop& top, double duration_s) {
  constexpr double kMostSmall = 0.15, kPhase = 0.2, kEarthPart = 1e-6, kNearVertical = 1e-3;
  constexpr int kFewestSteps = 64, kMostSteps = 4000;
  const double sine = std::sqrt(std::max(0.0, 1 - top.cos_tilt * top.cos_tilt)), Omega = norm(top.W_L);
  if (!(sine > kNearVertical) || !(Omega > 0) || top.mgl == 0) return std::nullopt;
  const Vec3<double> n_L(sine * real::cos(top.azimuth_rad), sine * real::sin(top.azimuth_rad), top.cos_tilt);
  const auto momentum_L = [&](const Vec3<double>& w_L) {
    return Vec3<double>(top.I1 * w_L + (top.I3 - top.I1) * w_L.dot(n_L) * n_L);
  };
  const Vec3<double> released = momentum_L(top.w_L);
  const std::optional<Slow> start = without_nutation(top, released[2], released.dot(n_L));
  if (!start) return std::nullopt;
  const double first_rate = steady(top, start->u, start->S)->p;
  const double shaken = top.applied.given.oscillates ? 2 * std::numbers::pi * top.applied.given.frequency : 0;  // rad/s
  // The drift is linear in the Earth's rate but for terms of its square: at a small part of the precession's rate, it is had without a
  // difference of numbers that are nearly equal.
  const double part = kEarthPart * std::abs(first_rate) / Omega;
  const Vec3<double> W_L = part * top.W_L;
  const Vec3<double> added = top.in_laboratory ? momentum_L(W_L) : Vec3<double>(Vec3<double>::Zero());
  const std::optional<Slow> turning = without_nutation(top, released[2] + added[2], (released + added).dot(n_L));
  if (!turning) return std::nullopt;
  Slow plain = *start, rotating = *turning;
  SlowPrecession found;
  found.first_rad_s = first_rate;
  double t = 0, slowest = std::abs(first_rate), flattest = sine;
  for (int steps = 0; t < duration_s; ++steps) {
    const double p = steady(top, plain.u, plain.S)->p;
    found.smallness = std::max(found.smallness, std::abs(top.tilting * p / plain.S));
    slowest = std::min(slowest, std::abs(p));
    flattest = std::min(flattest, std::sqrt(1 - plain.u * plain.u));
    if (!(found.smallness <= kMostSmall) || !(flattest > kNearVertical) || steps >= kMostSteps) return std::nullopt;
    const double h = std::min({duration_s - t, duration_s / kFewestSteps, kPhase / std::max(std::abs(p), shaken)});
    const std::optional<Slow> next = stepped(top, Vec3<double>::Zero(), plain, t, h), other = stepped(top, W_L, rotating, t, h);
    if (!next || !other || next->S * start->S <= 0) return std::nullopt;
    plain = *next, rotating = *other;
    if (!steady(top, plain.u, plain.S)) return std::nullopt;
    t = h < duration_s - t ? t + h : duration_s;
  }
  found.last_rad_s = steady(top, plain.u, plain.S)->p;
  found.last_spin_rad_s = plain.S / top.I3;
  found.period_s = 2 * std::numbers::pi * top.tilting / std::abs(plain.S);
  found.turned_rad = plain.azimuth - start->azimuth;
  found.drift_rad = (rotating.azimuth - plain.azimuth) / part;
  // Left out are terms of second order in smallness, and in the Earth's rate.
  constexpr double kSecondOrder = 3;
  const double angle = Omega * duration_s, small = found.smallness;
  found.left_out_rad =
      kSecondOrder * (angle * small * small + Omega * (1 + angle) / slowest * (small + Omega / slowest)) / flattest;
  return found;
}

}  // namespace earthtop
