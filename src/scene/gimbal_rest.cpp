// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/gimbal_rest.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "earthtop/model/gimbal_equations.hpp"
#include "earthtop/scenario/support.hpp"

namespace earthtop {
namespace {

using Real = float128;
using Pair = std::array<Real, 2>;  // of the outer and the inner axis

/// The function R, whose derivatives are taken by differences: in 34 digits they keep half of them.
class Potential {
 public:
  Potential(const Model<Real>& model, Vec3<Real> turning_P, Real momentum)
      : model_(model), turning_(std::move(turning_P)), momentum_(momentum) {}

  Real operator()(const Pair& q) const {
    const GimbalPose<Real, Real> pose = at(q);
    const Vec3<Real> u_A = pose.into_ring(turning_), u_B = pose.into_body(u_A), g_A = pose.into_ring(model_.apparent_gravity_L);
    const auto& ring = model_.gimbals.ring;
    Real R =
        momentum_ * model_.rotor.axis_B.dot(u_B) + (u_A.dot(times(ring.I, u_A)) + u_B.dot(times(model_.I_BP_B, u_B))) / Real(2);
    R += ring.mass_moment.dot(g_A) + model_.mass_moment_B.dot(pose.into_body(g_A));
    const Bearing<Real>* bearings[] = {&model_.gimbals.outer, &model_.gimbals.inner};
    for (std::size_t i = 0; i < 2; ++i)
      R -= bearings[i]->torsion * (q[i] - bearings[i]->rest) * (q[i] - bearings[i]->rest) / Real(2);
    return R;
  }
  GimbalPose<Real, Real> at(const Pair& q) const { return {model_.gimbals, real::sin_cos(q[0]), real::sin_cos(q[1])}; }
  /// The momentum along an axis of parts at rest on the carrier.
  Real momentum(const Pair& q, std::size_t axis) const {
    const GimbalPose<Real, Real> pose = at(q);
    const Vec3<Real> u_A = pose.into_ring(turning_), u_B = pose.into_body(u_A);
    const Vec3<Real> L_B = times(model_.I_BP_B, u_B) + momentum_ * model_.rotor.axis_B;
    return axis == 1 ? L_B[1] : Real(times(model_.gimbals.ring.I, u_A)[2] + pose.outer_axis_B().dot(L_B));
  }
  template <class F>
  static Real slope(const F& f, Pair q, std::size_t i) {
    constexpr double kStep = 1e-9;
    Pair more = q, less = q;
    more[i] += Real(kStep), less[i] -= Real(kStep);
    return (f(more) - f(less)) / Real(2 * kStep);
  }
  Real gradient(const Pair& q, std::size_t i) const { return slope(*this, q, i); }
  Real curvature(const Pair& q, std::size_t i, std::size_t j) const {
    return slope([&](const Pair& p) { return gradient(p, i); }, q, j);
  }

 private:
  const Model<Real>& model_;
  Vec3<Real> turning_;
  Real momentum_;
};

/// Newton's method from the release. @returns whether it has settled near it
bool settles(const Potential& R, const std::array<bool, 2>& is_free, Pair& q) {
  constexpr double kNear = 0.5, kSettled = 1e-14;
  const Pair start = q;
  for (int i = 0; i < 40; ++i) {
    Pair step{};
    const Real a = R.curvature(q, 0, 0), b = R.curvature(q, 0, 1), c = R.curvature(q, 1, 1);
    const Real ga = R.gradient(q, 0), gb = R.gradient(q, 1);
    if (is_free[0] && is_free[1]) {
      const Real determinant = a * c - b * b;
      if (determinant == Real(0)) return false;
      step = {(c * ga - b * gb) / determinant, (a * gb - b * ga) / determinant};
    } else if (is_free[0]) {
      if (a == Real(0)) return false;
      step[0] = ga / a;
    } else {
      if (c == Real(0)) return false;
      step[1] = gb / c;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      q[k] -= step[k];
      if (!(real::abs(Real(q[k] - start[k])) < Real(kNear))) return false;
    }
    if (real::abs(step[0]) + real::abs(step[1]) < Real(kSettled)) return true;
  }
  return false;
}

std::optional<double> period(const Real& square) {
  if (!(square > Real(0))) return std::nullopt;
  const double rate = static_cast<double>(real::sqrt(square));
  return 2 * std::numbers::pi / rate;
}

}  // namespace

GimbalInertia gimbal_inertia(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  const GimbalAngles<double>& at = model.gimbals.release;
  const GimbalPose<double, double> pose{model.gimbals, real::sin_cos(at.outer), real::sin_cos(at.inner)};
  const Vec3<double> a_B = pose.outer_axis_B(), I_a = times(model.I_BP_B, a_B);
  return {model.gimbals.ring.I(2, 2) + a_B.dot(I_a), model.I_BP_B(1, 1), I_a[1],
          model.gimbals.ring.I(2, 2) + model.I_BP_B(2, 2)};
}

double gimbal_rotor_momentum(const Scene& scene) {
  const Model<double>& model = scene.model<double>();
  if (!model.gimbals.has_rotor) return 0;
  const GimbalAngles<double>& at = model.gimbals.release;
  const GimbalPose<double, double> pose{model.gimbals, real::sin_cos(at.outer), real::sin_cos(at.inner)};
  const PrescribedMotion<double>& turn = model.platform.turn;
  return gimbal_momenta(model, carried_parts(model, 0.0), pose, at.outer_rate, at.inner_rate, model.rotor.spin,
                        Vec3<double>(turn.angle_rate(0) * turn.axis), 0.0)
      .rotor;
}

std::optional<double> gimbal_nutation(const Scene& scene) {
  const Gimbals<double>& gimbals = scene.model<double>().gimbals;
  if (!gimbals.has_rotor || gimbals.outer.locked || gimbals.inner.locked) return std::nullopt;
  const GimbalPose<double, double> pose{gimbals, real::sin_cos(gimbals.release.outer), real::sin_cos(gimbals.release.inner)};
  const GimbalInertia inertia = gimbal_inertia(scene);
  const double determinant = inertia.outer * inertia.inner - inertia.coupling * inertia.coupling;
  // The volume that both axes and the rotor's span: without skew the sine of the angle between a and c.
  const Vec3<double> b(0, 1, 0);
  const double volume = std::abs(scene.model<double>().rotor.axis_B.dot(pose.outer_axis_B().cross(b)));
  return std::abs(gimbal_rotor_momentum(scene)) * volume / std::sqrt(determinant);
}

bool has_magnus_drift(const Scene& scene) {
  const Scenario& scenario = scene.scenario();
  const Model<double>& model = scene.model<double>();
  const Gimbals<double>& gimbals = model.gimbals;
  const auto is_bare = [](const BearingSpec& bearing) {
    return !bearing.locked && bearing.viscous_torque_N_m_s == 0 && bearing.coulomb_torque_N_m == 0 &&
           bearing.torsion_N_m_rad == 0;
  };
  const auto has_products = [](const Mat3<double>& I) { return I(0, 1) != 0 || I(0, 2) != 0 || I(1, 2) != 0; };
  const bool is_balanced = scene.site().gravity_m_s2 == 0 ||
                           (model.mass_moment_B == Vec3<double>::Zero() && gimbals.ring.mass_moment == Vec3<double>::Zero());
  return gimbals.has_rotor && !masses_move(scenario) && !scenario.platform && scenario.effects.plain() && is_balanced &&
         is_bare(scenario.gimbals->outer) && is_bare(scenario.gimbals->inner) && scenario.gimbals->axis_skew_deg == 0 &&
         !has_products(gimbals.ring.I) && !has_products(model.I_BP_B) &&
         model.rotor.axis_B == Vec3<double>(Vec3<double>::UnitZ()) && !model.rotor.driven && !scenario.rotor->has_friction();
}

std::optional<GimbalRest> gimbal_rest(const Scene& scene, Prediction prediction) {
  const Model<Real>& model = scene.model<Real>();
  const auto& platform = scene.scenario().platform;
  if (masses_move(scene.scenario()) || (platform && platform->motion != PlatformMotion::constant)) return std::nullopt;
  const bool rotates = prediction == Prediction::rotating;
  const Vec3<Real> w_LP = model.platform.turn.angle_rate(Real(0)) * model.platform.turn.axis;
  const Vec3<Real> turning = rotates ? Vec3<Real>(w_LP + model.W_IL_L) : w_LP;
  // Gravity and the Earth's rate are steady on a platform only along its axis; the Earth's rate is small.
  const Vec3<Real> tilted = model.apparent_gravity_L.cross(model.platform.turn.axis);
  if (platform && !(norm(tilted) == Real(0))) return std::nullopt;
  const Gimbals<Real>& gimbals = model.gimbals;
  const GimbalAngles<Real>& at = gimbals.release;
  const GimbalPose<Real, Real> pose{gimbals, real::sin_cos(at.outer), real::sin_cos(at.inner)};
  const Real h = gimbals.has_rotor ? gimbal_momenta(model, carried_parts(model, Real(0)), pose, at.outer_rate, at.inner_rate,
                                                    model.rotor.spin, turning, Real(0))
                                         .rotor
                                   : Real(0);
  const Potential R(model, turning, h);
  const std::array<bool, 2> is_free{!gimbals.outer.locked, !gimbals.inner.locked};
  Pair q{at.outer, at.inner};
  if (!settles(R, is_free, q)) return std::nullopt;

  const Vec3<Real> a_B = R.at(q).outer_axis_B(), I_a = times(model.I_BP_B, a_B);
  const Real M11 = gimbals.ring.I(2, 2) + a_B.dot(I_a), M12 = I_a[1], M22 = model.I_BP_B(1, 1);
  const Real K11 = -R.curvature(q, 0, 0), K12 = -R.curvature(q, 0, 1), K22 = -R.curvature(q, 1, 1);
  GimbalRest rest{static_cast<double>(q[0]), static_cast<double>(q[1]), {}, {}};
  if (!is_free[0] || !is_free[1]) {
    rest.slow_period_s = is_free[0] ? period(K11 / M11) : period(K22 / M22);
    return rest;
  }
  const auto momentum = [&](std::size_t axis) { return [&R, axis](const Pair& p) { return R.momentum(p, axis); }; };
  const Real gamma = Potential::slope(momentum(0), q, 1) - Potential::slope(momentum(1), q, 0);
  const Real a = M11 * M22 - M12 * M12, b = M11 * K22 + M22 * K11 - Real(2) * M12 * K12 + gamma * gamma,
             c = K11 * K22 - K12 * K12;
  const Real root = b * b - Real(4) * a * c;
  if (!(root >= Real(0)) || !(b > Real(0))) return rest;
  const Real fast = (b + real::sqrt(root)) / (Real(2) * a);
  rest.fast_period_s = period(fast), rest.slow_period_s = period(c / (a * fast));
  return rest;
}

}  // namespace earthtop
