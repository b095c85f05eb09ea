// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of a Cardan suspension against Lagrange's for mass points: kinetic energy in inertial space, from positions alone.
#include "earthtop/model/gimbal_equations.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

#include "earthtop/model/gimbal_ledger.hpp"

namespace earthtop {
namespace {

using T = float128;
using Angles = std::array<T, 3>;  // outer, inner, of the rotor

struct Point {
  T mass;
  Vec3<T> place;
};

struct Moments {
  Mat3<T> I, S;
  Vec3<T> mass_moment;
};

Moments moments_of(const std::vector<Point>& points) {
  Moments sum{Mat3<T>::Zero(), Mat3<T>::Zero(), Vec3<T>::Zero()};
  for (const auto& [mass, place] : points) {
    sum.S += mass * (place * place.transpose());
    sum.mass_moment += mass * place;
  }
  sum.I = sum.S.trace() * Mat3<T>::Identity() - sum.S;
  return sum;
}

/// A suspension of mass points on a platform that swings, at 0.5 rad/s of the Earth.
class OfPoints {
 public:
  explicit OfPoints(unsigned seed) : random_(seed) {
    const auto plain = [&](double least, double most) { return static_cast<double>(number(least, most)); };
    GimbalsSpec spec;
    spec.axis_tilt_deg = plain(0, 180), spec.axis_azimuth_deg = plain(-180, 180), spec.axis_skew_deg = plain(-30, 30);
    spec.outer = {false, plain(0, 0.2), plain(0, 0.2), 0.3, plain(0, 2), plain(-90, 90)};
    spec.inner = {false, plain(0, 0.2), plain(0, 0.2), 0.2, plain(0, 2), plain(-90, 90)};
    model_.gimbals = make_gimbals<T>(spec, {}, {}, true);
    for (int i = 0; i < 5; ++i) ring_.push_back(point()), body_.push_back(point());
    Vec3<T> axis(number(-1, 1), number(-1, 1), number(0.2, 1)), across(T(1), T(0), T(0));
    axis /= norm(axis);
    across -= axis.dot(across) * axis, across /= norm(across);
    const Vec3<T> third = axis.cross(across), center(number(-0.3, 0.3), number(-0.3, 0.3), number(-0.3, 0.3));
    const T mass = number(0.1, 0.5), radius = number(0.2, 0.6), height = number(0, 0.4);
    rotor_ = {{mass, radius * across}, {mass, -radius * across}, {mass, radius * third},
              {mass, -radius * third}, {mass, height * axis},    {mass, -height * axis}};
    model_.rotor.axis_B = axis_ = axis, center_ = center;
    model_.rotor.axial = T(4) * mass * radius * radius;
    model_.rotor.S_B = moments_of(rotor_).S;
    model_.rotor.viscous = number(0, 0.1);
    const Moments ring = moments_of(ring_);
    model_.gimbals.ring = {ring.I, ring.S, ring.mass_moment};
    std::vector<Point> both = body_;
    for (const Point& p : rotor_) both.push_back({p.mass, Vec3<T>(p.place + center)});
    const Moments body = moments_of(both);
    model_.S_BP_B = body.S, model_.mass_moment_B = body.mass_moment;
    model_.I_BP_B = body.I - model_.rotor.axial * (axis * axis.transpose());
    model_.apparent_gravity_L = Vec3<T>(number(-0.3, 0.3), number(-0.3, 0.3), T(-3));
    model_.epsilon = T(0.5);
    model_.W_IL_L_scaled = Vec3<T>(number(-1, 1), number(-1, 1), number(-1, 1));
    model_.W_IL_L = model_.epsilon * model_.W_IL_L_scaled;
    model_.kind = SceneKind::suspension;
    PrescribedMotion<T>& turn = model_.platform.turn;
    turn.axis = Vec3<T>(number(-1, 1), number(-1, 1), number(-1, 1));
    turn.axis /= norm(turn.axis);
    turn.rate = number(-1, 1), turn.amplitude = number(0, 0.5), turn.frequency = number(0, 0.3);
    q_ = {number(-3, 3), number(-3, 3), number(-3, 3)};
    rate_ = {number(-2, 2), number(-2, 2), number(-5, 5)};
    t_ = number(0, 2);
  }

  /// Where all points are, in inertial axes that are parallel to the laboratory's at t = 0.
  std::vector<Point> places(const Angles& q, const T& t, bool earth = true) const {
    const PrescribedMotion<T>& turn = model_.platform.turn;
    const T W = earth ? norm(model_.W_IL_L) : T(0);
    const Mat3<T> R_NP =
        turn_matrix(Vec3<T>(model_.W_IL_L / norm(model_.W_IL_L)), T(W * t)) * turn_matrix(turn.axis, turn.angle(t));
    const auto about = [](int axis, const T& angle) { return turn_matrix(Vec3<T>(Vec3<T>::Unit(axis)), angle); };
    const T skew = real::atan2(model_.gimbals.skew_sin, model_.gimbals.skew_cos);
    const Mat3<T> R_NA = R_NP * model_.gimbals.R_P0 * about(2, q[0]), R_NB = R_NA * about(0, skew) * about(1, q[1]);
    std::vector<Point> all;
    for (const Point& p : ring_) all.push_back({p.mass, Vec3<T>(R_NA * p.place)});
    for (const Point& p : body_) all.push_back({p.mass, Vec3<T>(R_NB * p.place)});
    for (const Point& p : rotor_) all.push_back({p.mass, Vec3<T>(R_NB * (center_ + turn_matrix(axis_, q[2]) * p.place))});
    return all;
  }
  T kinetic(const Angles& q, const Angles& rate, const T& t, bool earth = true) const {
    const auto at = [&](const T& s) {
      return places({q[0] + s * rate[0], q[1] + s * rate[1], q[2] + s * rate[2]}, t + s, earth);
    };
    const T h = T(1e-6);
    const auto far_before = at(-T(2) * h), before = at(-h), after = at(h), far_after = at(T(2) * h);
    T sum = T(0);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vec3<T> v = (T(8) * (after[i].place - before[i].place) - (far_after[i].place - far_before[i].place)) / (T(12) * h);
      sum += before[i].mass * v.dot(v) / T(2);
    }
    return sum;
  }
  T potential(const Angles& q, const T& t) const {
    const Vec3<T> gravity_N =
        turn_matrix(Vec3<T>(model_.W_IL_L / norm(model_.W_IL_L)), T(norm(model_.W_IL_L) * t)) * model_.apparent_gravity_L;
    T sum = T(0);
    for (const auto& [mass, place] : places(q, t)) sum -= mass * gravity_N.dot(place);
    return sum;
  }
  /// The derivative of a function of one number, to order 4.
  static T derivative(const std::function<T(const T&)>& f) {
    const T h = T(1e-5);
    return (T(8) * (f(h) - f(-h)) - (f(T(2) * h) - f(-T(2) * h))) / (T(12) * h);
  }
  Angles momenta(bool earth = true) const {
    Angles p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = derivative([&](const T& s) {
        Angles rate = rate_;
        rate[i] += s;
        return kinetic(q_, rate, t_, earth);
      });
    return p;
  }
  /// Without friction and springs.
  Angles momentum_rates() const {
    Angles p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = derivative([&](const T& s) {
        Angles q = q_;
        q[i] += s;
        return T(kinetic(q, rate_, t_) - potential(q, t_));
      });
    return p;
  }

  const Model<T>& model() const { return model_; }
  const Angles& q() const { return q_; }
  const Angles& rate() const { return rate_; }
  const T& t() const { return t_; }
  GimbalPose<T, T> pose() const { return {model_.gimbals, real::sin_cos(q_[0]), real::sin_cos(q_[1])}; }

 private:
  T number(double least, double most) { return T(std::uniform_real_distribution<double>(least, most)(random_)); }
  Point point() { return {number(0.1, 0.6), Vec3<T>(number(-1, 1), number(-1, 1), number(-1, 1))}; }

  std::mt19937 random_;
  Model<T> model_;
  std::vector<Point> ring_, body_, rotor_;
  Vec3<T> axis_, center_;
  Angles q_, rate_;
  T t_;
};

// The truncation of the differences is some h^4 = 1e-24 for velocities and 1e-20 for derivatives, of numbers of the size of 10; their
// rounding is 1e-34 / h.
constexpr double kDifferences = 1e-18;

void expect_near(const T& value, const T& reference, const char* what) {
  EXPECT_LE(static_cast<double>(real::abs(T(value - reference))), kDifferences * (1 + std::abs(static_cast<double>(reference))))
      << what << ' ' << static_cast<double>(value) << ' ' << static_cast<double>(reference);
}

TEST(GimbalEquations, MomentaAndTheirRatesAreThoseOfMassPoints) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const OfPoints scene(seed);
    const Model<T>& model = scene.model();
    const auto around = of_rotating(gimbal_surroundings<false>(model, scene.t()));
    const auto& rate = scene.rate();
    const GimbalMomenta<T> p = gimbal_momenta(model, carried_parts(model, scene.t()), scene.pose(), rate[0], rate[1], rate[2],
                                              around.turning, scene.t());
    const Angles of_points = scene.momenta();
    expect_near(p.outer, of_points[0], "outer momentum");
    expect_near(p.inner, of_points[1], "inner momentum");
    expect_near(p.rotor, of_points[2], "momentum of the rotor");

    const GimbalMotion<T> m = gimbal_motion(model, carried_parts(model, scene.t()), scene.pose(), p, around.turning, scene.t());
    expect_near(m.outer_rate, rate[0], "outer rate");
    expect_near(m.inner_rate, rate[1], "inner rate");
    expect_near(m.rotor_rate, rate[2], "rate of the rotor");
    const GimbalMomenta<T> change = earthtop::momentum_rates<false>(model, carried_parts(model, scene.t()), scene.pose(),
                                                                    scene.q()[0], scene.q()[1], m, around);
    const Angles force = scene.momentum_rates();
    expect_near(change.outer - bearing_torque(model.gimbals.outer, scene.q()[0], rate[0]), force[0], "outer torque");
    expect_near(change.inner - bearing_torque(model.gimbals.inner, scene.q()[1], rate[1]), force[1], "inner torque");
    expect_near(change.rotor - bearing_torque(model.rotor, rate[2]), force[2], "torque on the rotor");
  }
}

// The laboratory's momenta are those of velocities relative to it, and their rates those that [F]'s torques give: the inertial ones less
// the rate of what the Earth's turn adds to each momentum, which depends on angles and time alone.
TEST(GimbalEquations, LaboratoryTorquesAccountForTheEarth) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const OfPoints scene(seed);
    const Model<T>& model = scene.model();
    const auto& [q, rate] = std::tie(scene.q(), scene.rate());
    const auto momenta = [&](const T& s, bool laboratory) {
      const GimbalPose<T, T> pose{model.gimbals, real::sin_cos(T(q[0] + s * rate[0])), real::sin_cos(T(q[1] + s * rate[1]))};
      const T t = scene.t() + s;
      const auto inertial = of_rotating(gimbal_surroundings<false>(model, t));
      const Vec3<T> turning = laboratory ? of_rotating(gimbal_surroundings<true>(model, t)).turning : inertial.turning;
      const GimbalMomenta<T> p =
          gimbal_momenta(model, carried_parts(model, scene.t()), pose, rate[0], rate[1], rate[2], turning, t);
      return Angles{p.outer, p.inner, p.rotor};
    };
    const Angles of_points = scene.momenta(false), relative = momenta(T(0), true);
    for (std::size_t i = 0; i < 3; ++i) expect_near(relative[i], of_points[i], "relative momentum");

    const auto rates = [&]<bool kLaboratory>(std::bool_constant<kLaboratory>) {
      const auto around = of_rotating(gimbal_surroundings<kLaboratory>(model, scene.t()));
      const Angles p = momenta(T(0), kLaboratory);
      const GimbalMotion<T> m = gimbal_motion(model, carried_parts(model, scene.t()), scene.pose(),
                                              GimbalMomenta<T>{p[0], p[1], p[2]}, around.turning, scene.t());
      const GimbalMomenta<T> r =
          earthtop::momentum_rates<kLaboratory>(model, carried_parts(model, scene.t()), scene.pose(), q[0], q[1], m, around);
      return Angles{r.outer, r.inner, r.rotor};
    };
    const Angles laboratory = rates(std::true_type()), inertial = rates(std::false_type());
    for (std::size_t i = 0; i < 3; ++i) {
      const T of_earth = OfPoints::derivative([&](const T& s) { return T(momenta(s, false)[i] - momenta(s, true)[i]); });
      expect_near(laboratory[i], T(inertial[i] - of_earth), "rate of a relative momentum");
    }
  }
}

// The ledger solves for the accelerations by Newton and Euler. Its residual holds them against the bearings' own torques.
TEST(GimbalEquations, LedgerCloses) {
  constexpr double kRounding = 1e-30;  // of torques of the size of 10, in 34 digits
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const OfPoints scene(seed);
    const GimbalAngles<T> angles{scene.q()[0], scene.q()[1], scene.rate()[0], scene.rate()[1]};
    for (const auto observer :
         {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
      SCOPED_TRACE(to_string(observer));
      const auto entry = ledger_entry_in_gimbals(observer, scene.model(), scene.t(), angles, scene.rate()[2]);
      EXPECT_LE(static_cast<double>(norm(entry.residual_A)), kRounding);
      EXPECT_LE(static_cast<double>(norm(Vec3<T>(entry.tau_cor_inertia_A + entry.tau_cor_gyroscopic_A - entry.tau_cor_A))),
                kRounding);
    }
  }
}

// The accelerations of the ledger are those of the momenta: with them the momentum about the outer axis changes as the equations say.
TEST(GimbalEquations, LedgerHasTheAccelerationsOfTheMomenta) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const OfPoints scene(seed);
    const Model<T>& model = scene.model();
    const GimbalAngles<T> angles{scene.q()[0], scene.q()[1], scene.rate()[0], scene.rate()[1]};
    const auto entry = ledger_entry_in_gimbals(LedgerObserver::platform, model, scene.t(), angles, scene.rate()[2]);
    const auto around = of_rotating(gimbal_surroundings<false>(model, scene.t()));
    const auto& rate = scene.rate();
    const GimbalMomenta<T> p = gimbal_momenta(model, carried_parts(model, scene.t()), scene.pose(), rate[0], rate[1], rate[2],
                                              around.turning, scene.t());
    const GimbalMotion<T> m = gimbal_motion(model, carried_parts(model, scene.t()), scene.pose(), p, around.turning, scene.t());
    const GimbalMomenta<T> change = earthtop::momentum_rates<false>(model, carried_parts(model, scene.t()), scene.pose(),
                                                                    angles.outer, angles.inner, m, around);
    // In P the outer axis is fixed, and a.L' is what the platform sees: the rest is the momentum of the carrier's own turn.
    const auto seen = [&](const T& s) {
      const auto later = of_rotating(gimbal_surroundings<false>(model, T(scene.t() + s)));
      const GimbalPose<T, T> pose{model.gimbals, real::sin_cos(T(angles.outer + s * rate[0])),
                                  real::sin_cos(T(angles.inner + s * rate[1]))};
      const Vec3<T> still = Vec3<T>::Zero();
      return T(gimbal_momenta(model, carried_parts(model, scene.t()), pose, T(0), T(0), T(0), later.turning, T(0)).outer -
               gimbal_momenta(model, carried_parts(model, scene.t()), pose, T(0), T(0), T(0), still, T(0)).outer);
    };
    const T of_carrier = OfPoints::derivative(seen);
    const Vec3<T> a_P = model.gimbals.R_P0.col(2);
    expect_near(entry.dL_dt_A.dot(a_P), T(change.outer - of_carrier), "rate of the outer momentum");
  }
}

}  // namespace
}  // namespace earthtop
