// SPDX-License-Identifier: GPL-3.0-or-later
// The laboratory on its journey, by brute force: its place from the Earth's centre and its axes, as functions of latitude, longitude and
// height, turn with the Earth and are differentiated twice. Neither its inertial rate nor what the pivot feels has a formula here.
#include "jet.hpp"
#include "motion.hpp"

namespace headlines {
namespace {

Jet inverse_root(const Jet& a) {
  const Real r = 1 / sqrtq(a.value), r3 = r * r * r;
  return {r, -a.first * r3 / 2, -a.second * r3 / 2 + 3 * a.first * a.first * r3 * r * r / 4};
}
Jet quotient(const Jet& a, const Jet& b) {
  const Real v = 1 / b.value;
  return a * Jet{v, -b.first * v * v, (2 * b.first * b.first * v - b.second) * v * v};
}
Jet plain(Real x) { return {x, 0, 0}; }

const Leg& leg_at(const Travel& travel, Real t) {
  std::size_t i = 0;
  while (i + 1 < travel.legs.size() && t >= travel.legs[i + 1].start) ++i;
  return travel.legs[i];
}

/// The sine and the cosine of an angle at the start plus a change.
struct JetSinCos {
  Jet sin, cos;
};
JetSinCos turned_by(const SinCos& start, const Jet& change) {
  const Jet s = sine(change), c = cosine(change);
  return {plain(start.sin) * c + plain(start.cos) * s, plain(start.cos) * c - plain(start.sin) * s};
}

/// The radii of curvature N and M, from the sine of the latitude.
struct Radii {
  Jet prime, meridian;
};
Radii radii(const Travel& travel, const Jet& sin_latitude) {
  const Jet root = inverse_root(plain(1) - plain(travel.e2) * sin_latitude * sin_latitude);
  const Jet prime = plain(travel.radius) * root;
  return {prime, prime * plain(1 - travel.e2) * root * root};
}

}  // namespace

Travelling travelling(const Scene& scene, Real rate, Real t, const State& state) {
  const Travel& travel = *scene.travel;
  const Leg& leg = leg_at(travel, t);
  Jet done = plain(0);
  Real third = 0;  // derivative of the share
  if (leg.duration > 0) {
    const Jet x{(t - leg.start) / leg.duration, 1 / leg.duration, 0};
    done = x * x * x * (plain(10) - plain(15) * x + plain(6) * x * x);
    third = done.second;
  }
  const Jet speed = plain(leg.speed_before) + plain(leg.speed_after - leg.speed_before) * done;
  const Jet height = plain(travel.height + leg.climbed_before) + plain(leg.climb) * done;
  // First the rates, then once more with them: the second time gives their derivatives.
  Jet latitude = plain(state.latitude), longitude = plain(state.longitude), course = plain(state.course);
  for (int pass = 0; pass < 2; ++pass) {
    const JetSinCos phi = turned_by(travel.latitude, latitude), c = turned_by(travel.course, course);
    const Radii r = radii(travel, phi.sin);
    const Jet north = quotient(speed * c.cos, r.meridian + height);
    const Jet east = quotient(speed * c.sin, (r.prime + height) * phi.cos);
    Jet turning{leg.turn * done.first, leg.turn * third, 0};
    if (travel.geodesic) turning = turning + east * phi.sin;
    latitude.first = north.value, longitude.first = east.value, course.first = turning.value;
    if (pass == 1) latitude.second = north.first, longitude.second = east.first, course.second = turning.first;
  }

  const JetSinCos phi = turned_by(travel.latitude, latitude);
  const Radii r = radii(travel, phi.sin);
  const Jet turned_earth = longitude + Jet{rate * t, rate, 0};
  const Jet s = sine(turned_earth), c = cosine(turned_earth), zero = plain(0);
  // In axes with the Earth's axis as the third, in which the start has longitude 0.
  const Jet out = (r.prime + height) * phi.cos;
  const JetVec place{out * c, out * s, (r.prime * plain(1 - travel.e2) + height) * phi.sin};
  const JetVec axes[3] = {
      {zero - s, c, zero}, {zero - phi.sin * c, zero - phi.sin * s, phi.cos}, {phi.cos * c, phi.cos * s, phi.sin}};
  const auto value = [](const JetVec& v) { return Vec{v.x.value, v.y.value, v.z.value}; };
  const auto first = [](const JetVec& v) { return Vec{v.x.first, v.y.first, v.z.first}; };
  const auto second = [](const JetVec& v) { return Vec{v.x.second, v.y.second, v.z.second}; };
  Vec w, alpha;
  for (const JetVec& e : axes) w += Real(0.5) * cross(value(e), first(e)), alpha += Real(0.5) * cross(value(e), second(e));
  const Vec W{0, 0, rate};
  const Vec falling = -scene.gravity * value(axes[2]) + cross(W, cross(W, value(place))) - second(place);
  // Into East, North and Up of the start.
  const SinCos& at = travel.latitude;
  const Mat into{{0, 1, 0}, {-at.sin, 0, at.cos}, {at.cos, 0, at.sin}};
  const Vec up{0, 0, 1}, to_east{1, 0, 0};
  const Real colatitude = atan2q(at.cos, at.sin);
  const Quat q_IL = turn(to_east, -colatitude) * turn(up, turned_earth.value) * turn(to_east, colatitude - state.latitude);
  return {q_IL, into * w, into * alpha, into * falling, latitude.first, longitude.first, course.first};
}

}  // namespace headlines
