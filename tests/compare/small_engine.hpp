// SPDX-License-Identifier: GPL-3.0-or-later
/// Another program, as its author would write it in a day: a rigid body on a pivot, by fourth-order Runge-Kutta steps in inertial
/// angular rates, with mistakes that can be made in it. It shares no code with the library.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace earthtop::testing {

struct SmallEngine {
  using V = Eigen::Vector3d;
  using Q = Eigen::Quaterniond;

  // The scenario, SI units and degrees; x East, y North, z Up.
  double mass = 0.1, gravity = 9.80665, latitude_deg = 45, earth_rate = 7.292115e-5;
  V center{0, 0, 0.03}, moments{1.2e-4, 1.2e-4, 4e-5};
  bool moments_about_center = false;
  double tilt_deg = 20, azimuth_deg = 90, spin = 200;
  double across = 0;  // rate about body axis 1 at the release
  // Mistakes.
  bool coriolis = true, rates_are_inertial = false, latitude_in_radians = false, azimuth_from_east = false;

  struct State {
    double t = 0;
    Q q;  // body to laboratory
    V w;  // relative to the laboratory, along body axes
  };

  V earth() const {
    const double latitude = latitude_in_radians ? latitude_deg : latitude_deg * std::numbers::pi / 180;
    return earth_rate * V(0, std::cos(latitude), std::sin(latitude));
  }
  Eigen::Matrix3d inertia() const {
    Eigen::Matrix3d I = moments.asDiagonal();
    if (moments_about_center) I += mass * (center.squaredNorm() * Eigen::Matrix3d::Identity() - center * center.transpose());
    return I;
  }
  State start() const {
    const double degree = std::numbers::pi / 180, azimuth = azimuth_from_east ? azimuth_deg : 90 - azimuth_deg;
    State s;
    s.q = Q(Eigen::AngleAxisd(azimuth * degree, V::UnitZ()) * Eigen::AngleAxisd(tilt_deg * degree, V::UnitY()));
    s.w = V(across, 0, spin);
    if (rates_are_inertial) s.w -= s.q.conjugate() * earth();
    return s;
  }

  struct Slope {
    Eigen::Vector4d q;
    V w;
  };
  Slope slope(const Eigen::Vector4d& q4, const V& w, const Eigen::Matrix3d& I, const Eigen::Matrix3d& inverse) const {
    const Q q = Q(q4[0], q4[1], q4[2], q4[3]).normalized();
    const V earth_B = q.conjugate() * earth();
    const V weight = mass * center.cross(q.conjugate() * V(0, 0, -gravity));
    V change;
    if (coriolis) {
      // Euler's equation for the inertial rate u = w + Omega; Omega turns backwards in the body.
      const V u = w + earth_B;
      change = inverse * (weight - u.cross(I * u)) + w.cross(earth_B);
    } else {
      change = inverse * (weight - w.cross(I * w) - earth_B.cross(I * earth_B));
    }
    const Q rate = Q(0, w.x(), w.y(), w.z());
    const Q p = Q(q4[0], q4[1], q4[2], q4[3]) * rate;
    return {0.5 * Eigen::Vector4d(p.w(), p.x(), p.y(), p.z()), change};
  }

  /// Rows each `step` until `duration`, by `inner` steps between two of them.
  std::vector<State> run(double duration, double step, int inner) const {
    const Eigen::Matrix3d I = inertia(), inverse = I.inverse();
    State s = start();
    Eigen::Vector4d q(s.q.w(), s.q.x(), s.q.y(), s.q.z());
    V w = s.w;
    std::vector<State> rows = {s};
    const int count = static_cast<int>(std::lround(duration / step));
    const double h = step / inner;
    for (int row = 1; row <= count; ++row) {
      for (int i = 0; i < inner; ++i) {
        const Slope a = slope(q, w, I, inverse), b = slope(q + 0.5 * h * a.q, w + 0.5 * h * a.w, I, inverse),
                    c = slope(q + 0.5 * h * b.q, w + 0.5 * h * b.w, I, inverse),
                    d = slope(q + h * c.q, w + h * c.w, I, inverse);
        q += h / 6 * (a.q + 2 * b.q + 2 * c.q + d.q);
        w += h / 6 * (a.w + 2 * b.w + 2 * c.w + d.w);
        q.normalize();
      }
      rows.push_back({row * step, Q(q[0], q[1], q[2], q[3]), w});
    }
    return rows;
  }

  /// What a file tells: attitudes q0 to q3 and rates wx, wy, wz; attitudes alone; or the axis alone, x, y, z. Beside the time t.
  enum class Told { attitudes_and_rates, attitudes, axes };

  static std::string csv(const std::vector<State>& rows, int digits = 17, Told told = Told::attitudes_and_rates) {
    std::ostringstream text;
    text.precision(digits);
    text << (told == Told::axes ? "t,x,y,z\n" : told == Told::attitudes ? "t,q0,q1,q2,q3\n" : "t,q0,q1,q2,q3,wx,wy,wz\n");
    for (const State& s : rows) {
      const V axis = s.q * V::UnitZ();
      text << s.t;
      if (told == Told::axes)
        text << ',' << axis.x() << ',' << axis.y() << ',' << axis.z();
      else
        text << ',' << s.q.w() << ',' << s.q.x() << ',' << s.q.y() << ',' << s.q.z();
      if (told == Told::attitudes_and_rates) text << ',' << s.w.x() << ',' << s.w.y() << ',' << s.w.z();
      text << '\n';
    }
    return text.str();
  }
};

}  // namespace earthtop::testing
