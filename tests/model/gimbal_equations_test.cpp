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

using Wide = float128;
using Angles = std::array<Wide, 3>;  // outer, inner, of the rotor

struct Point {
  Wide mass;
  Vec3<Wide> place;
};

struct Moments {
  Mat3<Wide> I, S;
  Vec3<Wide> mass_moment;
};

Moments moments_of(const std::vector<Point>& points) {
  Moments sum{Mat3<Wide>::Zero(), Mat3<Wide>::Zero(), Vec3<Wide>::Zero()};
  for (const auto& [mass, place] : points) {
    sum.S += mass * (place * place.transpose());
    sum.mass_moment += mass * place;
  }
  sum.I = sum.S.trace() * Mat3<Wide>::Identity() - sum.S;
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
    model_.gimbals = make_gimbals<Wide>(spec, {}, {}, true);
    for (int i = 0; i < 5; ++i) ring_.push_back(point()), body_.push_back(point());
    Vec3<Wide> axis(number(-1, 1), number(-1, 1), number(0.2, 1)), across(Wide(1), Wide(0), Wide(0));
    axis /= norm(axis);
    across -= axis.dot(across) * axis, across /= norm(across);
    const Vec3<Wide> third = axis.cross(across), center(number(-0.3, 0.3), number(-0.3, 0.3), number(-0.3, 0.3));
    const Wide mass = number(0.1, 0.5), radius = number(0.2, 0.6), height = number(0, 0.4);
    rotor_ = {{mass, radius * across}, {mass, -radius * across}, {mass, radius * third},
              {mass, -radius * third}, {mass, height * axis},    {mass, -height * axis}};
    model_.rotor.axis_B = axis_ = axis, center_ = center;
    model_.rotor.axial = Wide(4) * mass * radius * radius;
    model_.rotor.S_B = moments_of(rotor_).S;
    model_.rotor.viscous = number(0, 0.1);
    const Moments ring = moments_of(ring_);
    model_.gimbals.ring = {ring.I, ring.S, ring.mass_moment};
    std::vector<Point> both = body_;
    for (const Point& p : rotor_) both.push_back({p.mass, Vec3<Wide>(p.place + center)});
    const Moments body = moments_of(both);
    model_.S_BP_B = body.S, model_.mass_moment_B = body.mass_moment;
    model_.I_BP_B = body.I - model_.rotor.axial * (axis * axis.transpose());
    model_.apparent_gravity_L = Vec3<Wide>(number(-0.3, 0.3), number(-0.3, 0.3), Wide(-3));
    model_.epsilon = Wide(0.5);
    model_.W_IL_L_scaled = Vec3<Wide>(number(-1, 1), number(-1, 1), number(-1, 1));
    model_.W_IL_L = model_.epsilon * model_.W_IL_L_scaled;
    model_.kind = SceneKind::suspension;
    PrescribedMotion<Wide>& turn = model_.platform.turn;
    turn.axis = Vec3<Wide>(number(-1, 1), number(-1, 1), number(-1, 1));
    turn.axis /= norm(turn.axis);
    turn.rate = number(-1, 1), turn.amplitude = number(0, 0.5), turn.frequency = number(0, 0.3);
    q_ = {number(-3, 3), number(-3, 3), number(-3, 3)};
    rate_ = {number(-2, 2), number(-2, 2), number(-5, 5)};
    t_ = number(0, 2);
  }

  /// Where all points are, in inertial axes that are parallel to the laboratory's at t = 0.
  std::vector<Point> places(const Angles& q, const Wide& t, bool earth = true) const {
    const PrescribedMotion<Wide>& turn = model_.platform.turn;
    const Wide W = earth ? norm(model_.W_IL_L) : Wide(0);
    const Mat3<Wide> R_NP =
        turn_matrix(Vec3<Wide>(model_.W_IL_L / norm(model_.W_IL_L)), Wide(W * t)) * turn_matrix(turn.axis, turn.angle(t));
    const auto about = [](int axis, const Wide& angle) { return turn_matrix(Vec3<Wide>(Vec3<Wide>::Unit(axis)), angle); };
    const Wide skew = real::atan2(model_.gimbals.skew_sin, model_.gimbals.skew_cos);
    const Mat3<Wide> R_NA = R_NP * model_.gimbals.R_P0 * about(2, q[0]), R_NB = R_NA * about(0, skew) * about(1, q[1]);
    std::vector<Point> all;
    for (const Point& p : ring_) all.push_back({p.mass, Vec3<Wide>(R_NA * p.place)});
    for (const Point& p : body_) all.push_back({p.mass, Vec3<Wide>(R_NB * p.place)});
    for (const Point& p : rotor_) all.push_back({p.mass, Vec3<Wide>(R_NB * (center_ + turn_matrix(axis_, q[2]) * p.place))});
    return all;
  }
  Wide kinetic(const Angles& q, const Angles& rate, const Wide& t, bool earth = true) const {
    const auto at = [&](const Wide& s) {
      return places({q[0] + s * rate[0], q[1] + s * rate[1], q[2] + s * rate[2]}, t + s, earth);
    };
    const Wide h = Wide(1e-6);
    const auto far_before = at(-Wide(2) * h), before = at(-h), after = at(h), far_after = at(Wide(2) * h);
    Wide sum = Wide(0);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vec3<Wide> v =
          (Wide(8) * (after[i].place - before[i].place) - (far_after[i].place - far_before[i].place)) / (Wide(12) * h);
      sum += before[i].mass * v.dot(v) / Wide(2);
    }
    return sum;
  }
  Wide potential(const Angles& q, const Wide& t) const {
    const Vec3<Wide> gravity_N =
        turn_matrix(Vec3<Wide>(model_.W_IL_L / norm(model_.W_IL_L)), Wide(norm(model_.W_IL_L) * t)) * model_.apparent_gravity_L;
    Wide sum = Wide(0);
    for (const auto& [mass, place] : places(q, t)) sum -= mass * gravity_N.dot(place);
    return sum;
  }
  /// The derivative of a function of one number, to order 4.
  static Wide derivative(const std::function<Wide(const Wide&)>& f) {
    const Wide h = Wide(1e-5);
    return (Wide(8) * (f(h) - f(-h)) - (f(Wide(2) * h) - f(-Wide(2) * h))) / (Wide(12) * h);
  }
  Angles momenta(bool earth = true) const {
    Angles p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = derivative([&](const Wide& s) {
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
      p[i] = derivative([&](const Wide& s) {
        Angles q = q_;
        q[i] += s;
        return Wide(kinetic(q, rate_, t_) - potential(q, t_));
      });
    return p;
  }

  const Model<Wide>& model() const { return model_; }
  const Angles& q() const { return q_; }
  const Angles& rate() const { return rate_; }
  const Wide& t() const { return t_; }
  GimbalPose<Wide, Wide> pose() const { return {model_.gimbals, real::sin_cos(q_[0]), real::sin_cos(q_[1])}; }

 private:
  Wide number(double least, double most) { return Wide(std::uniform_real_distribution<double>(least, most)(random_)); }
  Point point() { return {number(0.1, 0.6), Vec3<Wide>(number(-1, 1), number(-1, 1), number(-1, 1))}; }

  std::mt19937 random_;
  Model<Wide> model_;
  std::vector<Point> ring_, body_, rotor_;
  Vec3<Wide> axis_, center_;
  Angles q_, rate_;
  Wide t_;
};

// The truncation of the differences is some h^4 = 1e-24 for velocities and 1e-20 for derivatives, of numbers of the size of 10; their
// rounding is 1e-34 / h.
constexpr double kDifferences = 1e-18;

void expect_near(const Wide& value, const Wide& reference, const char* what) {
  EXPECT_LE(static_cast<double>(real::abs(Wide(value - reference))),
            kDifferences * (1 + std::abs(static_cast<double>(reference))))
      << what << ' ' << static_cast<double>(value) << ' ' << static_cast<double>(reference);
}

TEST(GimbalEquations, MomentaAndTheirRatesAreThoseOfMassPoints) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const OfPoints scene(seed);
    const Model<Wide>& model = scene.model();
    const auto around = of_rotating(gimbal_surroundings<false>(model, scene.t()));
    const auto& rate = scene.rate();
    const GimbalMomenta<Wide> p = gimbal_momenta(model, carried_parts(model, scene.t()), scene.pose(), rate[0], rate[1],
                                                 rate[2], around.turning, scene.t());
    const Angles of_points = scene.momenta();
    expect_near(p.outer, of_points[0], "outer momentum");
    expect_near(p.inner, of_points[1], "inner momentum");
    expect_near(p.rotor, of_points[2], "momentum of the rotor");

    const GimbalMotion<Wide> m =
        gimbal_motion(model, carried_parts(model, scene.t()), scene.pose(), p, around.turning, scene.t());
    expect_near(m.outer_rate, rate[0], "outer rate");
    expect_near(m.inner_rate, rate[1], "inner rate");
    expect_near(m.rotor_rate, rate[2], "rate of the rotor");
    const GimbalMomenta<Wide> change = earthtop::momentum_rates<false>(model, carried_parts(model, scene.t()), scene.pose(),
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
    const Model<Wide>& model = scene.model();
    const Angles &q = scene.q(), &rate = scene.rate();
    const auto momenta = [&](const Wide& s, bool laboratory) {
      const GimbalPose<Wide, Wide> pose{model.gimbals, real::sin_cos(Wide(q[0] + s * rate[0])),
                                        real::sin_cos(Wide(q[1] + s * rate[1]))};
      const Wide t = scene.t() + s;
      const auto inertial = of_rotating(gimbal_surroundings<false>(model, t));
      const Vec3<Wide> turning = laboratory ? of_rotating(gimbal_surroundings<true>(model, t)).turning : inertial.turning;
      const GimbalMomenta<Wide> p =
          gimbal_momenta(model, carried_parts(model, scene.t()), pose, rate[0], rate[1], rate[2], turning, t);
      return Angles{p.outer, p.inner, p.rotor};
    };
    const Angles of_points = scene.momenta(false), relative = momenta(Wide(0), true);
    for (std::size_t i = 0; i < 3; ++i) expect_near(relative[i], of_points[i], "relative momentum");

    const auto rates = [&]<bool kLaboratory>(std::bool_constant<kLaboratory>) {
      const auto around = of_rotating(gimbal_surroundings<kLaboratory>(model, scene.t()));
      const Angles p = momenta(Wide(0), kLaboratory);
      const GimbalMotion<Wide> m = gimbal_motion(model, carried_parts(model, scene.t()), scene.pose(),
                                                 GimbalMomenta<Wide>{p[0], p[1], p[2]}, around.turning, scene.t());
      const GimbalMomenta<Wide> r =
          earthtop::momentum_rates<kLaboratory>(model, carried_parts(model, scene.t()), scene.pose(), q[0], q[1], m, around);
      return Angles{r.outer, r.inner, r.rotor};
    };
    const Angles laboratory = rates(std::true_type()), inertial = rates(std::false_type());
    for (std::size_t i = 0; i < 3; ++i) {
      const Wide of_earth =
          OfPoints::derivative([&](const Wide& s) { return Wide(momenta(s, false)[i] - momenta(s, true)[i]); });
      expect_near(laboratory[i], Wide(inertial[i] - of_earth), "rate of a relative momentum");
    }
  }
}

// The attitude, by quaternions, is that of the turns about the outer axis, by the skew, and about the inner axis.
TEST(GimbalEquations, AttitudeIsThatOfTheTurnsAboutBothAxes) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const OfPoints scene(seed);
    const Gimbals<Wide>& gimbals = scene.model().gimbals;
    const Wide outer = scene.q()[0], inner = scene.q()[1], skew = real::atan2(gimbals.skew_sin, gimbals.skew_cos);
    const auto about = [](int axis, const Wide& angle) { return turn_matrix(Vec3<Wide>(Vec3<Wide>::Unit(axis)), angle); };
    const Mat3<Wide> expected = gimbals.R_P0 * about(2, outer) * about(0, skew) * about(1, inner);
    const Mat3<Wide> attitude = rotation_matrix(gimbal_attitude(gimbals, outer, inner));
    for (int i = 0; i < 9; ++i) expect_near(attitude(i / 3, i % 3), expected(i / 3, i % 3), "attitude");
  }
}

// The ledger solves for the accelerations by Newton and Euler. Its residual holds them against the bearings' own torques.
TEST(GimbalEquations, LedgerCloses) {
  constexpr double kRoundingOfTorques = 1e-30;  // of torques of the size of 10, in 34 digits
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const OfPoints scene(seed);
    const GimbalAngles<Wide> angles{scene.q()[0], scene.q()[1], scene.rate()[0], scene.rate()[1]};
    for (const auto observer :
         {LedgerObserver::inertial, LedgerObserver::laboratory, LedgerObserver::platform, LedgerObserver::body}) {
      SCOPED_TRACE(to_string(observer));
      const auto entry = ledger_entry_in_gimbals(observer, scene.model(), scene.t(), angles, scene.rate()[2]);
      EXPECT_LE(static_cast<double>(norm(entry.residual_A)), kRoundingOfTorques);
      EXPECT_LE(static_cast<double>(norm(Vec3<Wide>(entry.tau_cor_inertia_A + entry.tau_cor_gyroscopic_A - entry.tau_cor_A))),
                kRoundingOfTorques);
    }
  }
}

// The accelerations of the ledger are those of the momenta: with them the momentum about the outer axis changes as the equations say.
TEST(GimbalEquations, LedgerHasTheAccelerationsOfTheMomenta) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const OfPoints scene(seed);
    const Model<Wide>& model = scene.model();
    const GimbalAngles<Wide> angles{scene.q()[0], scene.q()[1], scene.rate()[0], scene.rate()[1]};
    const auto entry = ledger_entry_in_gimbals(LedgerObserver::platform, model, scene.t(), angles, scene.rate()[2]);
    const auto around = of_rotating(gimbal_surroundings<false>(model, scene.t()));
    const auto& rate = scene.rate();
    const GimbalMomenta<Wide> p = gimbal_momenta(model, carried_parts(model, scene.t()), scene.pose(), rate[0], rate[1],
                                                 rate[2], around.turning, scene.t());
    const GimbalMotion<Wide> m =
        gimbal_motion(model, carried_parts(model, scene.t()), scene.pose(), p, around.turning, scene.t());
    const GimbalMomenta<Wide> change = earthtop::momentum_rates<false>(model, carried_parts(model, scene.t()), scene.pose(),
                                                                       angles.outer, angles.inner, m, around);
    // In P the outer axis is fixed, and a.L' is what the platform sees: the rest is the momentum of the carrier's own turn.
    const auto seen = [&](const Wide& s) {
      const auto later = of_rotating(gimbal_surroundings<false>(model, Wide(scene.t() + s)));
      const GimbalPose<Wide, Wide> pose{model.gimbals, real::sin_cos(Wide(angles.outer + s * rate[0])),
                                        real::sin_cos(Wide(angles.inner + s * rate[1]))};
      const Vec3<Wide> still = Vec3<Wide>::Zero();
      return Wide(
          gimbal_momenta(model, carried_parts(model, scene.t()), pose, Wide(0), Wide(0), Wide(0), later.turning, Wide(0))
              .outer -
          gimbal_momenta(model, carried_parts(model, scene.t()), pose, Wide(0), Wide(0), Wide(0), still, Wide(0)).outer);
    };
    const Wide of_carrier = OfPoints::derivative(seen);
    const Vec3<Wide> a_P = model.gimbals.R_P0.col(2);
    expect_near(entry.dL_dt_A.dot(a_P), Wide(change.outer - of_carrier), "rate of the outer momentum");
  }
}

}  // namespace
}  // namespace earthtop
