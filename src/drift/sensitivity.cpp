#include "drift/jet.hpp"  // first: the formulas below are compiled for jets
//
#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "drift/measures.ipp"
#include "earthtop/drift/deviation.hpp"
#include "earthtop/drift/sensitivity.hpp"

namespace earthtop {
namespace {

using Jet = real::Jet<kInputs>;
constexpr std::size_t kVariables = 14;  // q and w of the reference; w, y and p of the deviation
constexpr std::size_t kSlots = kInputs + 1;
using State = std::array<double, kVariables * kSlots>;

/// The variables whose errors are measured against one another's size.
struct Group {
  std::size_t first, count;
};
constexpr Group kGroups[] = {{0, 4}, {4, 3}, {7, 4}, {11, 3}};

Jet jet_at(const State& x, std::size_t i) {
  Jet jet = x[i];
  for (std::size_t k = 0; k < kInputs; ++k) jet.d[k] = x[(k + 1) * kVariables + i];
  return jet;
}
void put(const Jet& jet, State& x, std::size_t i) {
  x[i] = jet.value;
  for (std::size_t k = 0; k < kInputs; ++k) x[(k + 1) * kVariables + i] = jet.d[k];
}
Vec3<Jet> vector_at(const State& x, std::size_t i) { return {jet_at(x, i), jet_at(x, i + 1), jet_at(x, i + 2)}; }
void put(const Vec3<Jet>& v, State& x, std::size_t i) {
  for (std::size_t k = 0; k < 3; ++k) put(v[static_cast<int>(k)], x, i + k);
}
Motion<Jet> motion_in(const State& x) { return {{jet_at(x, 0), vector_at(x, 1)}, vector_at(x, 4)}; }
Deviation<Jet> deviation_in(const State& x) { return {jet_at(x, 7), vector_at(x, 8), vector_at(x, 11)}; }
void put(const Motion<Jet>& motion, const Deviation<Jet>& deviation, State& x) {
  put(motion.q.w, x, 0);
  put(motion.q.v, x, 1);
  put(motion.m, x, 4);
  put(deviation.w, x, 7);
  put(deviation.y, x, 8);
  put(deviation.p, x, 11);
}

/// A matrix or vector of the problem with the same member of its derivatives. @param member  from a ProblemDerivative
template <class Derived, class Member>
auto with_derivatives(const Eigen::MatrixBase<Derived>& values, const std::array<ProblemDerivative, kInputs>& inputs,
                      const Member& member) {
  Eigen::Matrix<Jet, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> jets;
  for (int i = 0; i < values.rows(); ++i)
    for (int j = 0; j < values.cols(); ++j) {
      jets(i, j) = values(i, j);
      for (std::size_t k = 0; k < kInputs; ++k) jets(i, j).d[k] = member(inputs[k])(i, j);
    }
  return jets;
}

Model<Jet> jet_model(const Model<double>& model, const std::array<ProblemDerivative, kInputs>& inputs) {
  using D = ProblemDerivative;
  Model<Jet> jets;
  jets.I_BP_B = with_derivatives(model.I_BP_B, inputs, [](const D& d) { return d.I_BP_B; });
  jets.I_BP_B_inverse = with_derivatives(model.I_BP_B_inverse, inputs, [](const D& d) { return d.I_BP_B_inverse; });
  jets.S_BP_B = with_derivatives(model.S_BP_B, inputs, [](const D& d) { return d.S_BP_B; });
  jets.mass_moment_B = with_derivatives(model.mass_moment_B, inputs, [](const D& d) { return d.mass_moment_B; });
  jets.apparent_gravity_L = with_derivatives(model.apparent_gravity_L, inputs, [](const D& d) { return d.apparent_gravity_L; });
  jets.epsilon = model.epsilon;
  jets.W_IL_L_scaled = with_derivatives(model.W_IL_L_scaled, inputs, [](const D& d) { return d.W_IL_L_scaled; });
  jets.W_IL_L = jets.epsilon * jets.W_IL_L_scaled;
  return jets;
}

State initial_state(const MotionProblem<double>& problem, const Model<Jet>& model,
                    const std::array<ProblemDerivative, kInputs>& inputs) {
  const Release<double>& release = problem.release;
  Quaternion<Jet> q;
  q.w = release.q_LB.w;
  for (std::size_t k = 0; k < kInputs; ++k) q.w.d[k] = inputs[k].q_LB.w;
  q.v = with_derivatives(release.q_LB.v, inputs, [](const ProblemDerivative& d) { return d.q_LB.v; });
  const Vec3<Jet> w = with_derivatives(problem.units.rate_from_rad_s(release.w_XB_B), inputs,
                                       [](const ProblemDerivative& d) { return d.w_XB_B; });
  Deviation<Jet> deviation;
  if (release.X == RatesRelativeTo::laboratory)
    deviation.p = times(model.I_BP_B, transposed_times(rotation_matrix(q), model.W_IL_L_scaled));
  State x;
  put({q, w}, deviation, x);
  return x;
}

/// The largest size so far of each group in each slot: what its errors are small against.
class Sizes {
 public:
  void include(const State& x) {
    for (std::size_t slot = 0; slot < kSlots; ++slot)
      for (std::size_t g = 0; g < std::size(kGroups); ++g) largest_[slot][g] = std::max(largest_[slot][g], norm_of(x, slot, g));
  }
  /// The largest error over its size; the sizes are at least a thousandth, in natural units.
  double relative(const State& error) const {
    double worst = 0;
    for (std::size_t slot = 0; slot < kSlots; ++slot)
      for (std::size_t g = 0; g < std::size(kGroups); ++g)
        worst = std::max(worst, norm_of(error, slot, g) / std::max(1e-3, largest_[slot][g]));
    return worst;
  }

 private:
  static double norm_of(const State& x, std::size_t slot, std::size_t group) {
    double square = 0;
    for (std::size_t i = 0; i < kGroups[group].count; ++i) {
      const double xi = x[slot * kVariables + kGroups[group].first + i];
      square += xi * xi;
    }
    return std::sqrt(square);
  }
  std::array<std::array<double, std::size(kGroups)>, kSlots> largest_ = {};
};

Differentiated differentiated(const Jet& jet) { return {jet.value, jet.d}; }

}  // namespace

DriftSensitivity drift_sensitivity(const MotionProblem<double>& problem, const std::array<ProblemDerivative, kInputs>& inputs,
                                   double time_s, double relative_tolerance, const std::atomic<bool>* stop) {
  if (problem.model.kind != SceneKind::plain) throw std::logic_error("drift_sensitivity: the scene is not plain");
  const Model<Jet> model = jet_model(problem.model, inputs);
  DriftSensitivity result;
  const auto system = [&](const State& x, State& dxdt, double) {
    ++result.counters.evaluations;
    const PivotField<Jet> field = pivot_field<SceneKind::plain>(model, Jet());
    const Motion<Jet> reference = motion_in(x);
    put(body_equation<false, SceneKind::plain>(model, reference, field.reference_L),
        body_deviation_equation<SceneKind::plain>(model, reference, deviation_in(x), field), dxdt);
  };
  State x = initial_state(problem, model, inputs), after, error;
  Sizes sizes;
  sizes.include(x);
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
  const double end = problem.units.time_from_s(time_s);
  double t = 0, dt = std::min(end, 0.1 / problem.fastest_rate);
  while (t < end) {
    if (stop != nullptr && *stop) {
      result.status = RunStatus::interrupted;
      return result;
    }
    const bool last = t + dt >= end;
    const double step = last ? end - t : dt;
    stepper.do_step(system, x, t, after, step, error);
    const double used = sizes.relative(error) / relative_tolerance;
    const double factor = std::clamp(0.9 * std::pow(std::max(used, 1e-12), -1.0 / 8), 0.2, 4.0);
    if (!(used <= 1)) {
      ++result.counters.rejected;
      dt = step * (std::isfinite(used) ? std::min(factor, 0.9) : 0.2);
      if (t + dt > t) continue;
      result.status = RunStatus::step_underflow;
      return result;
    }
    ++result.counters.accepted;
    x = after;
    t = last ? end : t + step;
    if (!last) dt = step * factor;
    sizes.include(x);
  }
  const Deviation<Jet> deviation = deviation_in(x);
  DriftState<Jet> state;
  state.ref_q_LB = motion_in(x).q;
  state.e_w = deviation.w;
  state.e_v_scaled = deviation.y;
  state.epsilon = model.epsilon;
  const DriftMeasures<Jet> measures = measure_drift(state);
  result.axis = differentiated(measures.axis);
  result.attitude = differentiated(measures.attitude);
  result.tilt = differentiated(measures.tilt);
  if (measures.azimuth_defined) result.azimuth = differentiated(measures.azimuth);
  return result;
}

}  // namespace earthtop
