// SPDX-License-Identifier: GPL-3.0-or-later
/// The spinning top in its laboratory, as the numbers that the equations of motion need: everything is decided and computed in
/// advance.
#pragma once

#include <memory>
#include <type_traits>

#include "earthtop/frames/journey.hpp"
#include "earthtop/frames/tide.hpp"
#include "earthtop/members.hpp"
#include "earthtop/model/applied_torques.hpp"
#include "earthtop/model/body.hpp"
#include "earthtop/model/gimbals.hpp"
#include "earthtop/model/moving_masses.hpp"
#include "earthtop/model/platform.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/model/rotor.hpp"
#include "earthtop/model/torques.hpp"

namespace earthtop {

/// The kinds of scenes, chosen once and compiled separately for speed. `plain`: all non-inertial torques act and the pivot is
/// at rest in the laboratory. `full`: each torque has a weight, a platform may carry the pivot, and further torques may be
/// applied. `gyrostat`: as `full`, and a rotor turns in the body, or masses move in it. Without a rotor it is a driven one without a
/// moment, whose rate is 0. `suspension`: a Cardan suspension holds the body.
enum class SceneKind { plain, full, gyrostat, suspension };

/// The weight of each of the torques of [F] (torques.hpp): 1, or 0 if the scene leaves it out.
template <class T>
struct TorqueWeights {
  T coriolis = T(1);
  T transverse = T(1);
  T centrifugal = T(1);
  EARTHTOP_MEMBERS(coriolis, transverse, centrifugal)

  bool all_act() const { return coriolis == T(1) && transverse == T(1) && centrifugal == T(1); }
  TorqueWeights complement() const { return {T(1) - coriolis, T(1) - transverse, T(1) - centrifugal}; }
};

/// Body, gravity and Earth rate. The Earth's rate is W = epsilon * W_scaled with epsilon = min(|Omega|, 1 rad per unit of
/// time): deviations divided by epsilon keep an ordinary magnitude for every Earth rate down to 1e-300 rad/s.
template <class T>
struct Model {
  /// The first four are those at release, and change where masses move (ModelInTime).
  Mat3<T> I_BP_B;          ///< inertia about the pivot; without the axial moment of a rotor that is not driven (rotor.hpp)
  Mat3<T> I_BP_B_inverse;  ///< its inverse
  Mat3<T> S_BP_B;          ///< second moment about the pivot
  Vec3<T> mass_moment_B;   ///< m r_cm
  Vec3<T> apparent_gravity_L;
  T epsilon = T(1);
  Vec3<T> W_IL_L_scaled;  ///< W / epsilon
  Vec3<T> W_IL_L;         ///< the Earth's rate
  TorqueWeights<T> weights;
  Platform<T> platform;
  AppliedTorques<T> applied;
  TideSeries<T> tide;  ///< tide of the Moon and the Sun, added to apparent gravity
  Rotor<T> rotor;
  MovingMasses<T> masses;  ///< that move in the body
  Gimbals<T> gimbals;
  SceneKind kind = SceneKind::plain;
  Journey<T> journey;  ///< of the laboratory; where there is one, the axes L of the other members are the axes A of journey.hpp
  EARTHTOP_MEMBERS(I_BP_B, I_BP_B_inverse, S_BP_B, mass_moment_B, apparent_gravity_L, epsilon, W_IL_L_scaled, W_IL_L, weights,
                   platform, applied, tide, rotor, masses, gimbals, kind, journey)
};

/// Sets the stiffness of an unequal support that is given by the periods of a pendulum, from the weight of the model's body.
template <class T>
void put_support(Model<T>& model, const AppliedTorquesSpec& spec) {
  if (spec.unequal_support && spec.unequal_support->periods_s)
    model.applied.support =
        support_of_periods<T>(*spec.unequal_support, T(model.mass_moment_B[2] * norm(model.apparent_gravity_L)));
}

/// A model whose tensors of the body are those at a time, where masses move in it. It keeps the last time that it was asked for, so that a
/// copy belongs to one thread.
template <class T>
class ModelInTime {
 public:
  /// @param model  must live as long
  explicit ModelInTime(const Model<T>& model) : model_(model) {
    if (model.masses.any()) now_ = std::make_shared<Now>(Now{model, model.masses.at_release, T(0), false});
  }
  const Model<T>& at(const T& t) const {
    if (!now_) return model_;
    move_to(t);
    return now_->model;
  }
  /// The sums over the moving masses; null where there are none.
  const MassSums<T>* masses_at(const T& t) const {
    if (!now_) return nullptr;
    move_to(t);
    return &now_->sums;
  }

 private:
  struct Now {
    Model<T> model;
    MassSums<T> sums;
    T t;
    bool is_set;
  };
  void move_to(const T& t) const {
    Now& now = *now_;
    if (now.is_set && now.t == t) return;
    now.t = t, now.is_set = true;
    now.sums = model_.masses.sums(t);
    const MassSums<T>& release = model_.masses.at_release;
    const Mat3<T> more = now.sums.second_moment - release.second_moment;
    now.model.S_BP_B = model_.S_BP_B + more;
    now.model.I_BP_B = model_.I_BP_B + inertia_of(more);
    now.model.I_BP_B_inverse = inverse_by_cofactors(now.model.I_BP_B);
    now.model.mass_moment_B = model_.mass_moment_B + (now.sums.mass_moment - release.mass_moment);
  }

  const Model<T>& model_;
  std::shared_ptr<Now> now_;
};
/// A model of a body in which nothing moves.
template <class T>
class ModelAtRest {
 public:
  explicit ModelAtRest(const Model<T>& model) : model_(model) {}
  const Model<T>& at(const T&) const { return model_; }

 private:
  const Model<T>& model_;
};
template <SceneKind K, class T>
using ModelOfKind = std::conditional_t<K == SceneKind::gyrostat, ModelInTime<T>, ModelAtRest<T>>;

/// Units of the model: masses in 2^mass_exponent kg, times in 2^time_exponent s. Powers of two change no digit. They bring all
/// rates and moments near 1, so that one tolerance suits all components.
struct NaturalUnits {
  int mass_exponent = 0;
  int time_exponent = 0;
  template <class T>
  T time_from_s(T t) const {
    return real::scale(t, -time_exponent);
  }
  template <class T>
  T rate_from_rad_s(T w) const {
    return real::scale(w, time_exponent);
  }
  template <class T>
  T rate_to_rad_s(T w) const {
    return real::scale(w, -time_exponent);
  }
  template <class T>
  Vec3<T> rate_to_rad_s(const Vec3<T>& w) const {
    return {rate_to_rad_s(w[0]), rate_to_rad_s(w[1]), rate_to_rad_s(w[2])};
  }
  template <class T>
  Vec3<T> rate_from_rad_s(const Vec3<T>& w) const {
    return {rate_from_rad_s(w[0]), rate_from_rad_s(w[1]), rate_from_rad_s(w[2])};
  }
  template <class T>
  NaturalRelease<T> release_from_rad_s(const Release<T>& release) const {
    return {release.q_LB, rate_from_rad_s(release.w_XB_B), release.X};
  }
};

/// Units in which the largest pivot moment and the fastest rate of the scene (spin, pendulum, Earth or platform) lie in [1/2,
/// 1); the unit of time is at most 2^300 s.
NaturalUnits natural_units(const Body<double>& body, const Release<double>& release, double gravity_m_s2,
                           double earth_rate_rad_s, const Platform<double>* platform);

/// @param earth_rate_rad_s  Omega, any finite value   @param platform  null for a pivot at rest in the laboratory
template <class T>
Model<T> make_model(const Body<T>& body, const Site& site, double earth_rate_rad_s, const TorqueWeights<T>& weights,
                    const Platform<T>* platform, const NaturalUnits& units = {});
extern template Model<double> make_model(const Body<double>&, const Site&, double, const TorqueWeights<double>&,
                                         const Platform<double>*, const NaturalUnits&);
extern template Model<float80> make_model(const Body<float80>&, const Site&, double, const TorqueWeights<float80>&,
                                          const Platform<float80>*, const NaturalUnits&);
extern template Model<float128> make_model(const Body<float128>&, const Site&, double, const TorqueWeights<float128>&,
                                           const Platform<float128>*, const NaturalUnits&);

/// The acceleration field at the pivot, in L axes: apparent gravity and tide minus the acceleration of the pivot.
template <class T>
struct PivotField {
  Vec3<T> rotating_L;           ///< on the rotating Earth
  Vec3<T> reference_L;          ///< in the non-rotating prediction
  Vec3<T> difference_L_scaled;  ///< (rotating - reference) / epsilon, computed without subtracting the two
};

/// The same on a journey (carrier.hpp).
template <class T>
PivotField<T> field_on_journey(const Model<T>& model, const T& t);

template <SceneKind K, class T>
PivotField<T> pivot_field(const Model<T>& model, T t) {
  if constexpr (K == SceneKind::plain) {
    return {model.apparent_gravity_L, model.apparent_gravity_L, Vec3<T>::Zero()};
  } else {
    if (!model.journey.empty()) return field_on_journey(model, t);
    const PivotAcceleration<T> a = pivot_acceleration(model.platform, model.W_IL_L, model.W_IL_L_scaled, t);
    Vec3<T> reference_L = model.apparent_gravity_L - a.of_platform_L;
    if (!model.tide.empty()) reference_L += model.tide.acceleration_L(t);
    return {reference_L - model.epsilon * a.of_earth_rate_L, reference_L, -a.of_earth_rate_L};
  }
}

/// The inertia of body and rotor together, also where the model's own tensor leaves a free rotor's axial moment out (rotor.hpp).
template <class T>
Mat3<T> inertia_of_all(const Model<T>& model) {
  const bool has_rotor = model.kind == SceneKind::gyrostat || model.kind == SceneKind::suspension;
  if (!has_rotor || model.rotor.driven) return model.I_BP_B;
  return model.I_BP_B + model.rotor.axial * (model.rotor.axis_B * model.rotor.axis_B.transpose());
}

/// Returns the model of the same body on an Earth that stands still, as the non-rotating prediction has it.
template <class T>
Model<T> without_earth_rate(Model<T> model) {
  model.epsilon = T(0);
  model.W_IL_L = model.W_IL_L_scaled = Vec3<T>::Zero();
  return model;
}

/// The Coriolis and centrifugal torques of [F] (torques.hpp) in the laboratory, with their weights, in the axes A that all
/// arguments share. They are linear in W_A_scaled: with W_A_scaled = W_A the result is the torque, with W_A / epsilon it is the
/// torque over epsilon. There is no transverse torque because the Earth rotates uniformly: the laboratory has no angular
/// acceleration.
/// @param velocity_moment_A  of all parts, relative to the laboratory   @param S_BP_A  their second moment about the pivot
template <SceneKind K, class T>
Vec3<T> laboratory_torque(const TorqueWeights<T>& weights, const Vec3<T>& W_A, const Vec3<T>& W_A_scaled,
                          const Mat3<T>& velocity_moment_A, const Mat3<T>& S_BP_A) {
  const Vec3<T> cor = coriolis_torque(W_A_scaled, velocity_moment_A);
  const Vec3<T> cent = centrifugal_torque(W_A, W_A_scaled, S_BP_A);
  if constexpr (K == SceneKind::plain)
    return cor + cent;
  else
    return weights.coriolis * cor + weights.centrifugal * cent;
}
/// The same of a rigid body.
/// @param w_LB_A  the body's rate relative to the laboratory
template <SceneKind K, class T>
Vec3<T> laboratory_torque(const TorqueWeights<T>& weights, const Vec3<T>& W_A, const Vec3<T>& W_A_scaled, const Vec3<T>& w_LB_A,
                          const Mat3<T>& S_BP_A) {
  return laboratory_torque<K>(weights, W_A, W_A_scaled, velocity_moment(S_BP_A, w_LB_A), S_BP_A);
}

}  // namespace earthtop

#include "earthtop/model/carrier.hpp"  // needs the model, and is needed where pivot_field is called
