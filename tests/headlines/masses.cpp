// SPDX-License-Identifier: GPL-3.0-or-later
// Point masses on given paths.
#include "scene.hpp"

namespace headlines {

void add_point_mass(Real mass, const Vec& place, Mat& inertia) {
  const Real square = dot(place, place);
  inertia.a += mass * (Vec{square, 0, 0} - place.x * place);
  inertia.b += mass * (Vec{0, square, 0} - place.y * place);
  inertia.c += mass * (Vec{0, 0, square} - place.z * place);
}

Place MovingMass::place(Real t) const {
  if (times.empty()) {
    const Real w = 2 * pi() * frequency, angle = w * t + phase, s = sinq(angle), c = cosq(angle);
    const Vec out = c * along_cos + s * along_sin, onward = c * along_sin - s * along_cos;
    return {centre + out, w * onward, (-w * w) * out};
  }
  if (t <= times.front()) return {points.front(), {}, {}};
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (t >= times[i]) continue;
    // The share of the way, 10 x^3 - 15 x^4 + 6 x^5, and its derivatives by x.
    const Real length = times[i] - times[i - 1], x = (t - times[i - 1]) / length, rest = 1 - x;
    const Real share = x * x * x * (10 + x * (6 * x - 15)), first = 30 * x * x * rest * rest;
    const Real second = 60 * x * rest * (1 - 2 * x);
    const Vec way = points[i] - points[i - 1];
    return {points[i - 1] + share * way, (first / length) * way, (second / (length * length)) * way};
  }
  return {points.back(), {}, {}};
}

Mat Scene::inertia_at(Real t) const {
  Mat sum = inertia;
  for (const MovingMass& moving : masses) add_point_mass(moving.mass, moving.place(t).at, sum);
  return sum;
}

Vec Scene::mass_moment_at(Real t) const {
  Vec sum = mass_moment;
  for (const MovingMass& moving : masses) sum += moving.mass * moving.place(t).at;
  return sum;
}

Vec Scene::momentum_within(Real t) const {
  Vec sum;
  for (const MovingMass& moving : masses) {
    const Place place = moving.place(t);
    sum += moving.mass * cross(place.at, place.velocity);
  }
  return sum;
}

Real Scene::next_corner(Real t, Real last) const {
  Real next = last;
  for (const MovingMass& moving : masses)
    for (const Real corner : moving.times)
      if (corner > t && corner < next) next = corner;
  if (travel)
    for (const Leg& leg : travel->legs)
      if (leg.start > t && leg.start < next) next = leg.start;
  return next;
}

}  // namespace headlines
