// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of fourier_drift, for each scalar.
#pragma once

#include <optional>
#include <stdexcept>

#include "drift/drift_at_any_time.hpp"
#include "drift/fourier_drift.hpp"
#include "drift/spinless_pair_system.hpp"
#include "integrate/fourier/fourier_top.hpp"
#include "integrate/natural_times.hpp"

namespace earthtop {
namespace {

template <class T>
class FourierPair {
 public:
  FourierPair(const DriftProblem<T>& problem, TorusAxes axes, std::size_t fineness)
      : epsilon_(problem.model.epsilon),
        w3_(problem.natural_release().w_XB_B[2]),
        top_(problem.model, problem.natural_release(), axes, fineness) {}

  const FourierTop<T>& top() const { return top_; }
  T radian_time() const { return T(1) / top_.fast_rate(); }
  double longest_step() const { return static_cast<double>(top_.longest_step()); }
  double watch_step() const { return static_cast<double>(std::min(top_.longest_step(), T(T(1) / top_.slow_rate()))); }

  /// The quaternions of the pair are continuous: nothing has to be followed to a time.
  void advance(double) {}
  DriftState<double> followed_state(double t) {
    const SpinlessPair<T>& pair = at(T(t));
    DriftState<double> state;
    state.epsilon = static_cast<double>(epsilon_);
    state.ref_q_LB = converted<double>(pair.ref_q_LF);
    state.e_w = static_cast<double>(pair.e_w);
    state.e_v_scaled = converted<double>(pair.y);
    return state;
  }
  DriftState<T> state(T t) { return with_spin(at(t), epsilon_, w3_, t); }
  std::shared_ptr<const RotorState<T>> rotor(T, const DriftState<T>&) const { return nullptr; }
  T attitude_error(T t) {
    deviation_error_ = top_.deviation_error(t);
    return attitude_error_ = top_.attitude_error();
  }
  T drift_error(T attitude_drift) const { return T(2) * attitude_error_ * attitude_drift + deviation_error_; }

 private:
  const SpinlessPair<T>& at(T t) {
    if (!(t == seen_)) seen_ = t, pair_ = top_.at(t);
    return pair_;
  }

  T epsilon_, w3_;
  FourierTop<T> top_;
  T seen_ = T(-1);
  SpinlessPair<T> pair_;
  T attitude_error_ = T(0), deviation_error_ = T(0);
};

}  // namespace

template <class T>
DriftTrajectory<T> fourier_drift(const DriftProblem<T>& problem, const IntegrationOptions& options, const Watch& watch) {
  if (reduced_top(problem.model).axis != 2) throw std::logic_error("fourier: the top is not symmetric about body axis 3");
  std::optional<FourierPair<T>> pair;
  const auto is_refused = [&](TorusAxes axes, std::size_t fineness) {
    pair.emplace(problem, axes, fineness);
    return !pair->top().refusal().empty();
  };
  // A check takes other axes on a finer grid, or only a finer grid where those do not suit.
  const bool is_checked = options.observer != Observer::laboratory &&
                          (!is_refused(TorusAxes::laboratory, 2) || !is_refused(TorusAxes::effective_vertical, 2));
  if (!is_checked && is_refused(TorusAxes::effective_vertical, 1)) {
    DriftTrajectory<T> none;
    none.status = RunStatus::not_converged;
    return none;
  }
  return drift_at_any_time(*pair, problem, natural_times(problem), options, watch);
}

}  // namespace earthtop
