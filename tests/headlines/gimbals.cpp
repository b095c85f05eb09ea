// SPDX-License-Identifier: GPL-3.0-or-later
// The top in a Cardan suspension, by its two angular accelerations (d'Alembert): the torque that every part would need for its
// acceleration, along the axes about which the bearings let it turn, equals the torque that acts there. All vectors are in the axes P
// of the laboratory or the platform.
#include "motion.hpp"

namespace headlines {
namespace {

Mat into(const Mat& R, const Mat& tensor) { return R * tensor * transposed(R); }

/// Rate and acceleration of a driven rotor relative to the body.
std::array<Real, 2> driven(const Rotor& rotor, Real t) {
  const Real w = 2 * pi() * rotor.frequency, angle = w * t + rotor.phase;
  return {rotor.spin + rotor.acceleration * t + rotor.amplitude * sinq(angle),
          rotor.acceleration + rotor.amplitude * w * cosq(angle)};
}

}  // namespace

Quat Motion::q_PB() const {
  const Gimbals& gimbals = *scene_->gimbals;
  return gimbals.q_P0 * turn({0, 0, 1}, state_.outer_angle) * gimbals.q_skew * turn({0, 1, 0}, state_.inner_angle);
}

Motion::Posture Motion::posture(Real t, const State& state) const {
  const Gimbals& gimbals = *scene_->gimbals;
  const Quat q_PA = gimbals.q_P0 * turn({0, 0, 1}, state.outer_angle);
  Posture at;
  at.R_PA = matrix(q_PA), at.R_PB = matrix(q_PA * gimbals.q_skew * turn({0, 1, 0}, state.inner_angle));
  at.a = at.R_PA * Vec{0, 0, 1}, at.b = at.R_PB * Vec{0, 1, 0};
  const auto [angle, rate, acceleration] = platform_turn(t);
  const Vec axis = scene_->platform ? scene_->platform->axis : Vec{};
  at.earth = turned(axis, -angle, rate_ * scene_->celestial_axis);
  // In P the Earth's rate turns backwards.
  at.carrier = at.earth + rate * axis, at.carrier_rate = acceleration * axis - cross(rate * axis, at.earth);
  if (travels_) {
    const Travelling way = travelling(*scene_, rate_, t, state);
    const Mat R_LI = transposed(matrix(way.q_IL));
    at.earth = at.carrier = R_LI * way.w_I, at.carrier_rate = R_LI * way.alpha_I;
  }
  at.w_A = at.carrier + state.outer_rate * at.a, at.w_B = at.w_A + state.inner_rate * at.b;
  return at;
}

Vec Motion::falling_P(Real t, const State& state) const {
  if (travels_) {
    const Travelling way = travelling(*scene_, rate_, t, state);
    return transposed(matrix(way.q_IL)) * way.falling_I;
  }
  const Vec falling_L = turned(scene_->celestial_axis, -rate_ * t, falling_I(t, state));
  return scene_->platform ? turned(scene_->platform->axis, -platform_turn(t)[0], falling_L) : falling_L;
}

void Motion::release_in_gimbals() {
  const Gimbals& gimbals = *scene_->gimbals;
  state_.outer_angle = gimbals.outer_angle, state_.inner_angle = gimbals.inner_angle;
  state_.outer_rate = gimbals.outer_rate, state_.inner_rate = gimbals.inner_rate;
  // The rates of the prediction; for equal rates in space each axis gives up by how much faster its own laboratory turns.
  const Posture given = posture(0, state_);
  const Vec faster = given.earth - reference_rate_L();
  if (scene_->inertial_rates) {
    if (!gimbals.outer.locked) state_.outer_rate -= dot(faster, given.a);
    if (!gimbals.inner.locked)
      state_.inner_rate += (gimbals.outer_rate - state_.outer_rate) * dot(given.a, given.b) - dot(faster, given.b);
  }
  if (!scene_->rotor) return;
  const Rotor& rotor = *scene_->rotor;
  const Vec w_B = scene_->inertial_rates ? given.w_B - faster : given.w_B;
  state_.rotor_momentum = rotor.axial * (dot(given.R_PB * rotor.axis, w_B) + rotor.spin);
}

State Motion::slope_in_gimbals(Real t, const State& state) const {
  const Gimbals& gimbals = *scene_->gimbals;
  const Posture at = posture(t, state);
  const Vec &a = at.a, &b = at.b;
  const Mat ring = into(at.R_PA, gimbals.ring_inertia);
  Mat body = into(at.R_PB, scene_->inertia);
  State slope{{0, {}}, {}, {}, {}};
  slope.outer_angle = state.outer_rate, slope.inner_angle = state.inner_rate;
  if (travels_) {
    const Travelling way = travelling(*scene_, rate_, t, state);
    slope.latitude = way.latitude_rate, slope.longitude = way.longitude_rate, slope.course = way.course_rate;
  }
  Vec spin, spin_rate;  // momentum of the rotor within the body, and its time derivative in body axes
  if (scene_->rotor) {
    const Rotor& rotor = *scene_->rotor;
    const Vec c = at.R_PB * rotor.axis;
    if (rotor.driven) {
      const auto [rate, acceleration] = driven(rotor, t);
      body.a += rotor.axial * c.x * c, body.b += rotor.axial * c.y * c, body.c += rotor.axial * c.z * c;
      spin = rotor.axial * rate * c, spin_rate = rotor.axial * acceleration * c;
      slope.rotor_angle = rate;
    } else {
      slope.rotor_angle = state.rotor_momentum / rotor.axial - dot(at.w_B, c);
      slope.rotor_momentum = rotor.bearing.torque(0, slope.rotor_angle);
      spin = state.rotor_momentum * c, spin_rate = slope.rotor_momentum * c;
    }
  }
  // Accelerations of both gimbals but for those of the angles, and the torques that they need.
  const Vec acceleration_A = at.carrier_rate + state.outer_rate * cross(at.carrier, a);
  const Vec acceleration_B = acceleration_A + state.inner_rate * cross(at.w_A, b);
  const Vec need_A = ring * acceleration_A + cross(at.w_A, ring * at.w_A);
  const Vec need_B = body * acceleration_B + cross(at.w_B, body * at.w_B + spin) + spin_rate;
  const Vec G = falling_P(t, state);
  Vec on_A = cross(at.R_PA * gimbals.ring_mass_moment, G) - need_A;
  Vec on_B = cross(at.R_PB * scene_->mass_moment, G) - need_B;
  Real m_aa = dot(a, ring * a) + dot(a, body * a), m_ab = dot(a, body * b), m_bb = dot(b, body * b);
  // Each mass on its path needs the force m (acceleration - G); of the acceleration all but the angles' own is known.
  for (const MovingMass& mass : scene_->masses) {
    const Place place = mass.place(t);
    const Mat& R = mass.on_ring ? at.R_PA : at.R_PB;
    const Vec &w = mass.on_ring ? at.w_A : at.w_B, r = R * place.at;
    const Vec turning = cross(mass.on_ring ? acceleration_A : acceleration_B, r) + cross(w, cross(w, r));
    const Vec acceleration = turning + 2 * cross(w, R * place.velocity) + R * place.acceleration;
    (mass.on_ring ? on_A : on_B) += mass.mass * cross(r, G - acceleration);
    const Vec by_a = cross(a, r), by_b = mass.on_ring ? Vec{} : cross(b, r);
    m_aa += mass.mass * dot(by_a, by_a), m_ab += mass.mass * dot(by_a, by_b), m_bb += mass.mass * dot(by_b, by_b);
  }
  const Real f_a = gimbals.outer.torque(state.outer_angle, state.outer_rate) + dot(a, on_A + on_B);
  const Real f_b = gimbals.inner.torque(state.inner_angle, state.inner_rate) + dot(b, on_B);
  if (gimbals.inner.locked) {
    slope.outer_rate = f_a / m_aa;
  } else if (gimbals.outer.locked) {
    slope.inner_rate = f_b / m_bb;
  } else {
    const Real determinant = m_aa * m_bb - m_ab * m_ab;
    slope.outer_rate = (m_bb * f_a - m_ab * f_b) / determinant;
    slope.inner_rate = (m_aa * f_b - m_ab * f_a) / determinant;
  }
  return slope;
}

}  // namespace headlines
