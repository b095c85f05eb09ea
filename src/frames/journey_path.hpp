// SPDX-License-Identifier: GPL-3.0-or-later
/// The way of a travelling laboratory as power series in time: all paths are one differential equation for latitude, longitude and course.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/frames/degrees.hpp"
#include "earthtop/frames/travel_spec.hpp"
#include "frames/earth_figure.hpp"
#include "frames/power_series.hpp"

namespace earthtop {

/// Where the laboratory is, and how it is going to move: series in the time since an instant.
template <class T>
struct WayFrom {
  PowerSeries<T> latitude, longitude, height;  ///< less those at the release (rad, m)
  PowerSeries<T> course;                       ///< less that at the start (rad)
  PowerSeries<T> speed;                        ///< horizontal (m/s)
  PowerSeries<T> sin_latitude, cos_latitude;
  PowerSeries<T> meridian_radius, prime_radius;  ///< M + h, N + h (m)
  PowerSeries<T> east, north, up;                ///< velocity (m/s)
};

template <class T>
class JourneyPath {
 public:
  using Series = PowerSeries<T>;
  struct Place {
    T latitude = T(0), longitude = T(0), height = T(0), course = T(0);  ///< less those at the start
  };

  JourneyPath(const TravelSpec& spec, double latitude_deg, double height_m)
      : spec_(spec),
        figure_(spec),
        height_m_(height_m),
        at_start_(sin_cos_degrees(T(latitude_deg))),
        course_at_start_(sin_cos_degrees(T(spec.course_deg))) {
    if (spec.path == TravelPath::table) {
      for (std::size_t i = 0; i < 3; ++i) splines_.emplace_back(*spec.table[i].rows);
      for (const double t : spec.table[0].rows->t_s)
        if (t > 0) corners_.push_back(T(t));
      return;
    }
    Leg leg{T(0), T(0), T(spec.speed_m_s), T(spec.speed_m_s), T(0), T(0), T(0), T(0)};
    for (const TravelLeg& given : spec.legs) {
      leg.duration = T(given.duration_s);
      leg.speed_before = leg.speed_after;
      if (given.speed_m_s) leg.speed_after = T(*given.speed_m_s);
      leg.turned_before += leg.turn, leg.climbed_before += leg.climb;
      leg.turn = T(given.turn_deg) * real::pi<T>() / T(180), leg.climb = T(given.climb_m);
      legs_.push_back(leg);
      leg.start += leg.duration;
      corners_.push_back(leg.start);
    }
    leg.speed_before = leg.speed_after;
    leg.turned_before += leg.turn, leg.climbed_before += leg.climb;
    leg.duration = leg.turn = leg.climb = T(0);
    legs_.push_back(leg);
  }

  /// The times at which a leg ends, or a piece of the table.
  const std::vector<T>& corners() const { return corners_; }
  /// The sine and cosine of the latitude at the release.
  const SinCos<T>& at_start() const { return at_start_; }

  /// @param place  at the time t   @param is_before_corner  whether t, which may be a corner, belongs to the part that starts there
  WayFrom<T> from(const T& t, const Place& place) const {
    return spec_.path == TravelPath::table ? from_table(t) : from_legs(t, place);
  }

  /// The largest speed, horizontal or vertical, at no time exceeded (m/s).
  T largest_speed() const {
    T largest = T(0);
    for (const Leg& leg : legs_) {
      const T climbing = leg.duration > T(0) ? T(15) / T(8) * real::abs(leg.climb) / leg.duration : T(0);
      for (const T& speed : {leg.speed_before, leg.speed_after, climbing}) largest = std::max(largest, speed);
    }
    if (splines_.empty()) return largest;
    const T radian = real::pi<T>() / T(180), radius = T(figure_.largest_radius() + height_m_);
    return radian * radius * (splines_[0].largest_rate() + splines_[1].largest_rate()) + splines_[2].largest_rate();
  }

 private:
  struct Leg {
    T start, duration, speed_before, speed_after, turned_before, turn, climbed_before, climb;
  };

  /// x^3 (10 - 15 x + 6 x^2) in the time since t.
  static Series share(const Leg& leg, const T& t) {
    Series x((t - leg.start) / leg.duration);
    x[1] = T(1) / leg.duration;
    return x * x * x * (Series(T(10)) - Series(T(15)) * x + Series(T(6)) * x * x);
  }
  const Leg& leg_at(const T& t) const {
    std::size_t i = 0;
    while (i + 1 < legs_.size() && !(t < legs_[i + 1].start)) ++i;
    return legs_[i];
  }

  /// Puts in all that follows from latitude and height.
  void complete_place(WayFrom<T>& way) const {
    const SinCos<Series> turned = sin_cos(way.latitude);
    way.sin_latitude = Series(at_start_.sin) * turned.cos + Series(at_start_.cos) * turned.sin;
    way.cos_latitude = Series(at_start_.cos) * turned.cos - Series(at_start_.sin) * turned.sin;
    const Series h = Series(T(height_m_)) + way.height;
    figure_.radii(way.sin_latitude, way.meridian_radius, way.prime_radius);
    way.meridian_radius = way.meridian_radius + h, way.prime_radius = way.prime_radius + h;
  }

  WayFrom<T> from_legs(const T& t, const Place& place) const {
    const Leg& leg = leg_at(t);
    const bool changes = leg.duration > T(0);
    const Series done = changes ? share(leg, t) : Series(T(0));
    const Series turn_rate = derivative(Series(leg.turn) * done);
    WayFrom<T> way;
    way.speed = Series(leg.speed_before) + Series(leg.speed_after - leg.speed_before) * done;
    way.height = Series(leg.climbed_before) + Series(leg.climb) * done;
    way.latitude = Series(place.latitude), way.longitude = Series(place.longitude), way.course = Series(place.course);
    // Each turn gives the next term of all three.
    for (int terms = 1; terms <= Series::kMost; ++terms) {
      way.latitude.terms = way.longitude.terms = way.course.terms = terms;
      complete_place(way);
      const SinCos<Series> turned = sin_cos(way.course);
      way.north = way.speed * (Series(course_at_start_.cos) * turned.cos - Series(course_at_start_.sin) * turned.sin);
      way.east = way.speed * (Series(course_at_start_.sin) * turned.cos + Series(course_at_start_.cos) * turned.sin);
      if (terms == Series::kMost) break;
      const Series longitude_rate = way.east / (way.prime_radius * way.cos_latitude);
      Series course_rate = turn_rate;
      if (spec_.path == TravelPath::geodesic) course_rate = course_rate + longitude_rate * way.sin_latitude;
      way.latitude = integral(way.north / way.meridian_radius, place.latitude);
      way.longitude = integral(longitude_rate, place.longitude);
      way.course = integral(course_rate, place.course);
    }
    way.up = derivative(way.height);
    return way;
  }

  WayFrom<T> from_table(const T& t) const {
    WayFrom<T> way;
    const auto part = [&](std::size_t i, const T& unit) {
      const std::array<T, 4> cubic = splines_[i].cubic(t);
      Series s(unit * (cubic[0] - splines_[i].angle(T(0))));
      for (int k = 1; k < 4; ++k) s[k] = unit * cubic[static_cast<std::size_t>(k)];
      return s;
    };
    const T radian = real::pi<T>() / T(180);
    way.latitude = part(0, radian), way.longitude = part(1, radian), way.height = part(2, T(1));
    complete_place(way);
    way.north = way.meridian_radius * derivative(way.latitude);
    way.east = way.prime_radius * way.cos_latitude * derivative(way.longitude);
    way.up = derivative(way.height);
    return way;
  }

  const TravelSpec& spec_;
  EarthFigure<T> figure_;
  double height_m_;
  SinCos<T> at_start_, course_at_start_;
  std::vector<Leg> legs_;
  std::vector<AngleSpline<T>> splines_;
  std::vector<T> corners_;
};

}  // namespace earthtop
