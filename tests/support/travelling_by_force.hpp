// SPDX-License-Identifier: GPL-3.0-or-later
/// A laboratory that travels, by brute force in 113 bits. The pivot's place from the Earth's centre and the axes East, North, Up are written
/// down as functions of latitude, longitude and height, turned with the Earth, and differentiated twice; what the pivot feels is gravitation
/// less its acceleration. The body is followed in inertial axes, and the drift is found by subtraction. No transport rate, no Coriolis
/// term, no Eotvos formula and no radius of curvature enters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/extended_integration.hpp"

namespace earthtop::testing {

/// A number with its first and second derivative.
struct Jet {
  float128 value = 0, first = 0, second = 0;
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + 2 * a.first * b.first + a.value * b.second};
  }
  /// f(x), from f and its derivatives at the value.
  Jet through(float128 f, float128 f1, float128 f2) const { return {f, f1 * first, f2 * first * first + f1 * second}; }
};
inline Jet sine(const Jet& x) {
  const SinCos<float128> at = real::sin_cos(x.value);
  return x.through(at.sin, at.cos, -at.sin);
}
inline Jet cosine(const Jet& x) {
  const SinCos<float128> at = real::sin_cos(x.value);
  return x.through(at.cos, -at.sin, -at.cos);
}
inline Jet inverse_root(const Jet& x) {
  const float128 f = 1 / real::sqrt(x.value);
  return x.through(f, -f / (2 * x.value), 3 * f / (4 * x.value * x.value));
}

/// Normal gravity from the closed form of the potential, with the arc tangent [Heiskanen & Moritz, Physical Geodesy, section 2-7].
inline float128 normal_gravity_by_arc_tangent(float128 latitude, float128 height) {
  const float128 a = kEquatorialRadiusWgs84, f = float128(1'000'000'000) / float128(298'257'223'563), b = a * (1 - f);
  const float128 E = real::sqrt(a * a - b * b), GM = kGravitationalConstantWgs84,
                 w = float128(7'292'115) / float128(100'000'000'000);
  const float128 e2 = f * (2 - f), s = real::sin(latitude), c = real::cos(latitude), N = a / real::sqrt(1 - e2 * s * s);
  const float128 p = (N + height) * c, z = (N * (1 - e2) + height) * s;
  // Ellipsoidal coordinates: p = sqrt(u^2 + E^2) cos(beta), z = u sin(beta).
  const float128 r2 = p * p + z * z - E * E, u = real::sqrt((r2 + real::sqrt(r2 * r2 + 4 * E * E * z * z)) / 2);
  const float128 v = real::sqrt(u * u + E * E), sin_b = z / u, cos_b = p / v;
  const auto q = [&](float128 x) { return ((1 + 3 * x * x / (E * E)) * real::atan2(E, x) - 3 * x / E) / 2; };
  const float128 q1 = 3 * (1 + u * u / (E * E)) * (1 - u / E * real::atan2(E, u)) - 1;
  const float128 scale = real::sqrt((u * u + E * E * sin_b * sin_b) / (v * v)), ratio = w * w * a * a / q(b);
  const float128 along_u = -(GM + E * ratio * q1 * (sin_b * sin_b / 2 - float128(1) / 6)) / (v * v) + w * w * u * cos_b * cos_b;
  const float128 along_beta = (ratio * q(u) / v - w * w * v) * sin_b * cos_b;
  return real::sqrt(along_u * along_u + along_beta * along_beta) / scale;
}

/// A place with its derivatives by time.
struct MovingPlace {
  Jet latitude, longitude, height;  ///< rad, rad, m
};
/// A laboratory sees this of inertial space, in its axes.
struct LaboratoryByForce {
  Mat3<float128>
      R_IL;  ///< in axes at rest with their third along the Earth's axis and the Greenwich meridian at t = 0 in the first two
  Vec3<float128> w, alpha;
  Vec3<float128> felt;  ///< acceleration field at the pivot
};

/// Both motions of a scenario on a journey: a rigid body on a pivot at the laboratory's origin, with gravity and viscous friction alone.
class TravellingByForce {
 public:
  /// Both motions in axes of their laboratories, and how far they are apart.
  struct Row {
    double t_s;
    Mat3<float128> R_LB, ref_R_LB;
    float128 axis, attitude;
  };

  explicit TravellingByForce(const Scenario& scenario)
      : s_(scenario), travel_(*scenario.travel), body_(Scene(scenario).body<float128>()) {
    inverse_ = body_.I_BP_B_inverse;
    if (travel_.path == TravelPath::table)
      for (const FiledTable& column : travel_.table) splines_.emplace_back(*column.rows);
    if (travel_.figure == TravelFigure::sphere) a_ = travel_.radius_m, e2_ = 0;
    latitude_ = s_.site.latitude_deg * kDegree, longitude_ = s_.site.longitude_deg * kDegree;
  }

  /// The journey's state: latitude, longitude and course (rad).
  using Way = std::array<float128, 3>;
  Way start() const { return {latitude_, longitude_, travel_.course_deg * kDegree}; }

  /// The derivatives of the place from what the path says of its velocity.   @param rate  of the course, too
  MovingPlace place(const Way& way, float128 t, Way* rate = nullptr) const {
    if (!splines_.empty()) return from_table(t);
    const Given now = given(t);
    // The distances that a radian of latitude and of longitude takes, from the pivot's place by latitude.
    const float128 phi = way[0], s = real::sin(phi), c = real::cos(phi);
    const auto [p, z] = meridian({phi, 1, 0}, {now.height.value, 0, 0});
    const float128 north = real::sqrt(p.first * p.first + z.first * z.first), east = p.value;
    const float128 v_north = now.speed.value * real::cos(way[2]), v_east = now.speed.value * real::sin(way[2]);
    const float128 phi1 = v_north / north, lambda1 = v_east / east;
    const float128 course1 = now.turn_rate + (travel_.path == TravelPath::geodesic ? lambda1 * s : 0);
    if (rate) *rate = {phi1, lambda1, course1};
    const float128 north1 = (p.first * p.second + z.first * z.second) / north * phi1 + now.height.first;
    const float128 east1 = p.first * phi1 + c * now.height.first;
    const float128 v_north1 = now.speed.first * real::cos(way[2]) - v_east * course1,
                   v_east1 = now.speed.first * real::sin(way[2]) + v_north * course1;
    return {{phi, phi1, (v_north1 - phi1 * north1) / north}, {way[1], lambda1, (v_east1 - lambda1 * east1) / east}, now.height};
  }
  MovingPlace place_at_rest() const { return {{latitude_}, {longitude_}, {s_.site.height_m}}; }
  /// Integrates the path alone.
  Way way_at(float128 t_s) const {
    Way way = start();
    float128 from = 0;
    for (const float128 to : stops({static_cast<double>(t_s)})) {
      const auto rate = [&](const std::array<float128, 4>& y) {
        Way slope;
        place({y[0], y[1], y[2]}, y[3], &slope);
        return std::array<float128, 4>{slope[0], slope[1], slope[2], 1};
      };
      const auto y = extrapolated<float128, 4>({way[0], way[1], way[2], from}, to - from, 2, rate);
      way = {y[0], y[1], y[2]}, from = to;
    }
    return way;
  }

  LaboratoryByForce laboratory(const MovingPlace& at, float128 earth_rate, float128 t) const {
    // Turned with the Earth, every longitude grows by Omega t.
    const Jet longitude = at.longitude + Jet{earth_rate * t, earth_rate, 0};
    const Jet s = sine(at.latitude), c = cosine(at.latitude), sl = sine(longitude), cl = cosine(longitude), zero;
    const std::array<std::array<Jet, 3>, 3> axes{
        {{zero - sl, cl, zero}, {zero - s * cl, zero - s * sl, c}, {c * cl, c * sl, s}}};
    Mat3<float128> R, R1, R2;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const Jet& x = axes[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
        R(i, j) = x.value, R1(i, j) = x.first, R2(i, j) = x.second;
      }
    const auto turning = [&](const Mat3<float128>& derivative) {  // of the antisymmetric part, in L
      const Mat3<float128> m = R.transpose() * derivative;
      return Vec3<float128>((m(2, 1) - m(1, 2)) / 2, (m(0, 2) - m(2, 0)) / 2, (m(1, 0) - m(0, 1)) / 2);
    };
    const auto [p, z] = meridian(at.latitude, at.height);
    const Jet x = p * cl, y = p * sl;
    const Vec3<float128> acceleration(x.second, y.second, z.second), outward(x.value, y.value, 0);
    const float128 gamma = travel_.has_normal_gravity
                               ? normal_gravity_by_arc_tangent(at.latitude.value, at.height.value) + s_.gravity_anomaly_m_s2
                               : float128(s_.site.gravity_m_s2);
    // Gravity at rest is gravitation and W^2 times the distance from the axis.
    const Vec3<float128> gravitation = -gamma * R.col(2) - earth_rate * earth_rate * outward;
    return {R, turning(R1), turning(R2), Vec3<float128>(R.transpose() * (gravitation - acceleration))};
  }
  /// The laboratories of the rotating motion and of the reference; what each feels is what `eotvos` says.
  std::array<LaboratoryByForce, 2> both(const MovingPlace& at, float128 t) const {
    const float128 rate = s_.rotation_rate_rad_s;
    const bool at_rest = travel_.reference == TravelReference::at_rest;
    LaboratoryByForce rotating = laboratory(at, rate, t);
    const LaboratoryByForce over_still_earth = laboratory(at, 0, 0);
    LaboratoryByForce reference = at_rest ? laboratory(place_at_rest(), rate, t) : over_still_earth;
    if (travel_.eotvos == TravelEotvos::off) rotating.felt = over_still_earth.felt;
    if (travel_.eotvos == TravelEotvos::both) reference.felt = rotating.felt;
    return {rotating, reference};
  }

  /// @param radians_a_step  of the fastest rate
  std::vector<Row> rows(const std::vector<double>& times_s, double radians_a_step = 0.8) const {
    const double fastest = Scene(s_).fastest_rate_rad_s();
    State y = released();
    std::vector<Row> made{row(y)};
    float128 from = 0;
    std::size_t next = 0;
    while (next < times_s.size() && !(times_s[next] > 0)) ++next;
    for (const float128 to : stops(times_s)) {
      const int steps = std::max(1, static_cast<int>(std::ceil(static_cast<double>(to - from) * fastest / radians_a_step)));
      y = integrated(y, to - from, steps);
      from = to;
      if (next < times_s.size() && to == float128(times_s[next])) made.push_back(row(y)), ++next;
    }
    return made;
  }

 private:
  static constexpr std::size_t kOfMotion = 7;             // quaternion and angular momentum, inertial axes
  using State = std::array<float128, 4 + 2 * kOfMotion>;  // latitude, longitude, course, time, and both motions
  inline static const float128 kDegree = real::pi<float128>() / 180;

  /// The legs give speed, height, and the rate of the turns.
  struct Given {
    Jet speed, height;
    float128 turn_rate = 0;
  };
  Given given(float128 t) const {
    Given now;
    float128 speed = travel_.speed_m_s, height = s_.site.height_m, begin = 0;
    now.speed = {speed}, now.height = {height};
    for (const TravelLeg& leg : travel_.legs) {
      const float128 T = leg.duration_s, x = (t - begin) / T;
      const float128 to = leg.speed_m_s ? float128(*leg.speed_m_s) : speed;
      if (x < 1) {
        const Jet share{x * x * x * (10 - 15 * x + 6 * x * x), 30 * x * x * (1 - x) * (1 - x) / T,
                        60 * x * (1 - x) * (1 - 2 * x) / (T * T)};
        now.speed = Jet{speed} + Jet{to - speed} * share, now.height = Jet{height} + Jet{leg.climb_m} * share;
        now.turn_rate = leg.turn_deg * kDegree * share.first;
        return now;
      }
      speed = to, height += leg.climb_m, begin += T;
      now.speed = {speed}, now.height = {height};
    }
    return now;
  }
  MovingPlace from_table(float128 t) const {
    const auto jet = [&](const AngleSpline<float128>& spline, float128 unit) {
      return Jet{unit * spline.angle(t), unit * spline.angle_rate(t), unit * spline.angle_acceleration(t)};
    };
    return {jet(splines_[0], kDegree), jet(splines_[1], kDegree), jet(splines_[2], 1)};
  }
  /// Distances from the Earth's axis and from the equator's plane.
  std::pair<Jet, Jet> meridian(const Jet& latitude, const Jet& height) const {
    const Jet s = sine(latitude), N = Jet{a_} * inverse_root(Jet{1} - Jet{e2_} * s * s);
    return {(N + height) * cosine(latitude), (Jet{1 - e2_} * N + height) * s};
  }
  /// The times of the rows and the corners of the path up to the last row.
  std::vector<float128> stops(const std::vector<double>& times_s) const {
    std::vector<float128> all;
    const float128 end = times_s.back();
    const auto add = [&](float128 t) {
      if (t > 0 && t < end) all.push_back(t);
    };
    float128 t = 0;
    for (const TravelLeg& leg : travel_.legs) add(t += leg.duration_s);
    if (!splines_.empty())
      for (const double node : travel_.table[0].rows->t_s) add(node);
    for (const double row_s : times_s) add(row_s);
    all.push_back(end);
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  static Quaternion<float128> quaternion_of(const Mat3<float128>& R) {
    // Shepperd's: by the largest component.
    const float128 trace = R.trace();
    std::array<float128, 4> square{1 + trace, 1 - trace + 2 * R(0, 0), 1 - trace + 2 * R(1, 1), 1 - trace + 2 * R(2, 2)};
    const auto most = static_cast<std::size_t>(std::ranges::max_element(square) - square.begin());
    Eigen::Matrix<float128, 4, 1> q;
    if (most == 0) {
      q << square[0], R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
    } else {
      const int i = static_cast<int>(most) - 1, j = (i + 1) % 3, k = (i + 2) % 3;
      q[0] = R(k, j) - R(j, k), q[1 + i] = square[most], q[1 + j] = R(j, i) + R(i, j), q[1 + k] = R(k, i) + R(i, k);
    }
    return Quaternion<float128>{q[0], Vec3<float128>(q[1], q[2], q[3])}.normalized();
  }

  State released() const {
    const Way way = start();
    State y{};
    for (std::size_t i = 0; i < 3; ++i) y[i] = way[i];
    const Release<float128> release = Scene(s_).release<float128>();
    const Mat3<float128> R_LB = rotation_matrix(release.q_LB);
    const auto laboratories = both(place(way, 0), 0);
    // The given rates are the reference's, relative to its laboratory.
    const Vec3<float128> inertial = release.w_XB_B + R_LB.transpose() * laboratories[1].w;
    for (std::size_t k = 0; k < 2; ++k) {
      const LaboratoryByForce& L = laboratories[k];
      const Mat3<float128> R = L.R_IL * R_LB;
      const Vec3<float128> w = s_.release.rates_relative_to == RatesRelativeTo::inertial
                                   ? inertial
                                   : Vec3<float128>(release.w_XB_B + R_LB.transpose() * L.w);
      const Quaternion<float128> q = quaternion_of(R);
      const Vec3<float128> momentum = R * (body_.I_BP_B * w);
      const std::size_t at = 4 + k * kOfMotion;
      y[at] = q.w;
      for (int i = 0; i < 3; ++i)
        y[at + 1 + static_cast<std::size_t>(i)] = q.v[i], y[at + 4 + static_cast<std::size_t>(i)] = momentum[i];
    }
    return y;
  }

  static Quaternion<float128> attitude_in(const State& y, std::size_t k) {
    const std::size_t at = 4 + k * kOfMotion;
    return {y[at], Vec3<float128>(y[at + 1], y[at + 2], y[at + 3])};
  }
  State slope(const State& y) const {
    Way rate{};
    const MovingPlace at = place({y[0], y[1], y[2]}, y[3], &rate);
    const auto laboratories = both(at, y[3]);
    State made{};
    for (std::size_t i = 0; i < 3; ++i) made[i] = rate[i];
    made[3] = 1;
    const float128 friction = s_.effects.applied.viscous_N_m_s;
    for (std::size_t k = 0; k < 2; ++k) {
      const LaboratoryByForce& L = laboratories[k];
      const std::size_t from = 4 + k * kOfMotion;
      const Quaternion<float128> q = attitude_in(y, k);
      const Mat3<float128> R = rotation_matrix(q.normalized());
      const Vec3<float128> momentum(y[from + 4], y[from + 5], y[from + 6]);
      const Vec3<float128> w_B = inverse_ * (R.transpose() * momentum);
      const Vec3<float128> lever = R * (body_.mass * body_.p_PBcm_B);
      const Vec3<float128> torque = lever.cross(Vec3<float128>(L.R_IL * L.felt)) - friction * (R * w_B - L.R_IL * L.w);
      const Quaternion<float128> q1 = q * Quaternion<float128>{float128(0), Vec3<float128>(w_B / 2)};
      made[from] = q1.w;
      for (int i = 0; i < 3; ++i)
        made[from + 1 + static_cast<std::size_t>(i)] = q1.v[i], made[from + 4 + static_cast<std::size_t>(i)] = torque[i];
    }
    return made;
  }
  State integrated(const State& y, float128 length, int steps) const {
    const auto rate = [this](const Numbers<float128, 18>& at) { return Numbers<float128, 18>{slope(at.x)}; };
    Numbers<float128, 18> now{y};
    for (int k = 0; k < steps; ++k)
      now = test::extrapolated_step<float128, Numbers<float128, 18>, decltype(rate), 10>(rate, now, length / steps);
    return now.x;
  }
  Row row(const State& y) const {
    const auto laboratories = both(place({y[0], y[1], y[2]}, y[3]), y[3]);
    Row made{};
    made.t_s = static_cast<double>(y[3]);
    made.R_LB = laboratories[0].R_IL.transpose() * rotation_matrix(attitude_in(y, 0).normalized());
    made.ref_R_LB = laboratories[1].R_IL.transpose() * rotation_matrix(attitude_in(y, 1).normalized());
    made.attitude = angle_of(made.ref_R_LB.transpose() * made.R_LB);
    const Vec3<float128> n = made.R_LB.col(2), m = made.ref_R_LB.col(2);
    made.axis = real::atan2(norm(Vec3<float128>(m.cross(n))), m.dot(n));
    return made;
  }

 public:
  /// The angle of a rotation, by its antisymmetric part.
  static float128 angle_of(const Mat3<float128>& R) {
    const Vec3<float128> sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    return real::atan2(norm(sine), R.trace() - 1);
  }

 private:
  Scenario s_;
  TravelSpec travel_;
  Body<float128> body_;
  Mat3<float128> inverse_;
  std::vector<AngleSpline<float128>> splines_;
  float128 a_ = kEquatorialRadiusWgs84, f_ = float128(1'000'000'000) / float128(298'257'223'563), e2_ = f_ * (2 - f_);
  float128 latitude_ = 0, longitude_ = 0;
};

}  // namespace earthtop::testing
