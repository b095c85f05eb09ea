// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/long_horizon/kicked_axes.hpp"

#include "integrate/drive_problem.hpp"
#include "integrate/long_horizon.hpp"

namespace earthtop {
namespace {

using Top = TiltedTop<double>;

/// A tilted top with a further torque n x f: f is the moment of a uniform field, plus -k (I3 - I1) (n.u) u for each term k u u^T
/// of a gradient tensor.
class KickedTop : public Top {
 public:
  KickedTop(const DriftProblem<double>& problem, const ReducedTop<double>& top, const Vec3<double>& W_L,
            const std::array<GradientTerm<double>, 2>& gradient)
      : Top(problem.model, top, problem.natural_release(), W_L), excess_(top.I3 - top.I1), gradient_(gradient) {}

  void set_field_moment(const Vec3<double>& moment_L) { field_moment_L_ = moment_L; }

  /// The kick of the top itself and that of the further torque, while the axis is held.
  void kick(double b, TiltedTopState<double>& x) const {
    Top::kick(b, x);
    const Mat3<double> R_LF = rotation_to_laboratory(x);
    Vec3<double> f_L = field_moment_L_;
    for (const GradientTerm<double>& term : gradient_)
      if (term.strength != 0) f_L -= (term.strength * excess_ * R_LF.col(2).dot(term.direction_L)) * term.direction_L;
    push(b, transposed_times(R_LF, f_L), x);
  }

 private:
  double excess_;
  std::array<GradientTerm<double>, 2> gradient_;
  Vec3<double> field_moment_L_ = Vec3<double>::Zero();
};

}  // namespace

std::vector<Vec3<double>> kicked_axes(const DriftProblem<double>& problem, const KickSteps& steps, double earth_share,
                                      const AxisTorque& torque, const Watch& watch) {
  const Vec3<double> W_L = earth_share * problem.model.epsilon * problem.model.W_IL_L_scaled;
  KickedTop top(problem, reduced_top(problem.model), W_L, torque.gradient);
  const LongHorizonPlan<double> plan = plan_from(top, steps, problem.units);
  StepCounters counters;
  LongHorizonWalk<double, KickedTop> walk(top, plan, counters, watch);
  const std::vector<double> times = natural_times(problem);
  std::vector<Vec3<double>> axes;
  axes.reserve(times.size());
  for (std::size_t i = 0; i < times.size() && !watch.asks_to_stop(); ++i) {
    if (i > 0) {
      if (!torque.tide.empty()) {
        const Vec3<double> a_L = torque.tide.acceleration_L((times[i - 1] + times[i]) / 2);
        top.set_field_moment(torque.tide_strength * problem.model.mass_moment_B[2] * a_L);
      }
      walk.advance(times[i] - times[i - 1], 0, [](double, const TiltedTopState<double>&) {});
    }
    const TiltedTopState<double> x = i == 0 ? top.start() : walk.state();
    axes.emplace_back(top.rotation_to_laboratory(x).col(2));
  }
  return axes;
}

}  // namespace earthtop
