// SPDX-License-Identifier: GPL-3.0-or-later
/// A model over the scalar that records operations: the same numbers, and functions of time that bring their Taylor
/// coefficients. It has to be included before any header of the model.
#pragma once

#include "integrate/taylor/recorded.hpp"
#include "integrate/taylor/recorded_pair.hpp"
//
#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/frames/tide.hpp"

namespace earthtop {

/// A table of angles: the coefficients are those of the cubic piece at the time asked for. Steps have to end where pieces do.
template <class T>
class AngleSpline<real::Recorded<T>> {
 public:
  using Scalar = real::Recorded<T>;
  explicit AngleSpline(std::shared_ptr<const AngleSpline<T>> table) : table_(std::move(table)) {}

  Scalar angle(const Scalar& t) const { return derivative(t, 0); }
  Scalar angle_rate(const Scalar& t) const { return derivative(t, 1); }
  Scalar angle_acceleration(const Scalar& t) const { return derivative(t, 2); }
  bool is_zero() const { return table_->is_zero(); }

 private:
  Scalar derivative(const Scalar& t, int order) const {
    taylor::GivenFunction<T> function;
    function.components = 1;
    function.expand = [table = table_, order](T at, std::span<std::array<T, 3>> rows) {
      std::array<T, 4> c = table->cubic(at);
      for (int i = 0; i < order; ++i) c = {c[1], T(2) * c[2], T(3) * c[3], T(0)};
      for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = {k < 4 ? c[k] : T(0), T(0), T(0)};
    };
    return {*t.recording(), t.recording()->given(std::move(function), t.value())[0]};
  }
  std::shared_ptr<const AngleSpline<T>> table_;
};

/// The tide.
template <class T>
class TideSeries<real::Recorded<T>> {
 public:
  using Scalar = real::Recorded<T>;
  TideSeries() = default;
  explicit TideSeries(TideSeries<T> tide) : tide_(std::move(tide)) {}

  bool empty() const { return tide_.empty(); }
  Vec3<Scalar> acceleration_L(const Scalar& t) const {
    taylor::GivenFunction<T> function;
    function.components = 3;
    function.expand = [tide = tide_](T at, std::span<std::array<T, 3>> rows) { tide.expand(at, rows); };
    const std::array<int, 3> places = t.recording()->given(std::move(function), t.value());
    return {Scalar(*t.recording(), places[0]), Scalar(*t.recording(), places[1]), Scalar(*t.recording(), places[2])};
  }

 private:
  TideSeries<T> tide_;
};

namespace recorded_model_detail {
template <class T>
Vec3<real::Recorded<T>> recorded(const Vec3<T>& v) {
  return {v[0], v[1], v[2]};
}
template <class T>
Mat3<real::Recorded<T>> recorded(const Mat3<T>& m) {
  Mat3<real::Recorded<T>> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = m(i, j);
  return r;
}
}  // namespace recorded_model_detail

}  // namespace earthtop

// The formulas of the model follow, now that the functions above are known to them.
#include "earthtop/model/model.hpp"

namespace earthtop {

template <class T>
Model<real::Recorded<T>> recorded_model(const Model<T>& model) {
  using recorded_model_detail::recorded;
  using R = real::Recorded<T>;
  Model<R> r;
  r.I_BP_B = recorded(model.I_BP_B), r.I_BP_B_inverse = recorded(model.I_BP_B_inverse), r.S_BP_B = recorded(model.S_BP_B);
  r.mass_moment_B = recorded(model.mass_moment_B), r.apparent_gravity_L = recorded(model.apparent_gravity_L);
  r.epsilon = model.epsilon;
  r.W_IL_L_scaled = recorded(model.W_IL_L_scaled), r.W_IL_L = recorded(model.W_IL_L);
  r.weights = {model.weights.coriolis, model.weights.transverse, model.weights.centrifugal};
  const PrescribedMotion<T>& turn = model.platform.turn;
  r.platform.turn = {recorded(turn.axis), turn.angle0,    turn.rate,  turn.acceleration,
                     turn.amplitude,      turn.frequency, turn.phase, nullptr};
  if (turn.table) r.platform.turn.table = std::make_shared<const AngleSpline<R>>(turn.table);
  r.platform.pivot_offset_P = recorded(model.platform.pivot_offset_P);
  const AppliedTorques<T>& applied = model.applied;
  r.applied.any = applied.any;
  r.applied.viscous = applied.viscous, r.applied.quadratic = applied.quadratic, r.applied.coulomb = applied.coulomb;
  r.applied.disc_laminar = applied.disc_laminar, r.applied.disc_turbulent = applied.disc_turbulent;
  for (std::size_t i = 0; i < applied.gradient.size(); ++i)
    r.applied.gradient[i] = {applied.gradient[i].strength, recorded(applied.gradient[i].direction_L)};
  r.applied.level_axis = applied.level_axis, r.applied.gimbal_damping = applied.gimbal_damping;
  r.tide = TideSeries<R>(model.tide);
  r.kind = model.kind;
  return r;
}

}  // namespace earthtop
