// SPDX-License-Identifier: GPL-3.0-or-later
/// Real tops against Boost.Odeint: a top with viscous friction about its pivot, and tops on a table. The peer integrates two motions, with
/// the Earth's rotation and without, by runge_kutta_fehlberg78, and takes the angle between their axes; earthtop integrates reference and
/// deviation as `auto` has it. Both take turns in one program and land on the same 60 times; errors are taken against long double. Prints
/// Markdown: milliseconds of one core at three errors of the drift.
///
/// earthtop-real-tops [ROUNDS]

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/general_contact.hpp"
#include "earthtop/scene/scene.hpp"

namespace {

using namespace earthtop;
using Vector = Vec3<double>;

constexpr std::array kErrors{1e-6, 1e-9, 1e-12};  // rad
constexpr std::size_t kCheckpoints = 60;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// dq/dt of an attitude whose rate is given in the axes that it leads to.
Quaternion<double> turning(const Quaternion<double>& q, const Vector& w) {
  return {-0.5 * w.dot(q.v), Vector(0.5 * (q.w * w + w.cross(q.v)))};
}

/// Motion about a fixed pivot, in body axes, with a viscous torque against the rate relative to the laboratory: q_LB and the inertial rate.
class PivotMotion {
 public:
  using State = std::array<double, 7>;
  PivotMotion(const Scene& scene, bool rotates)
      : model_(scene.model<double>()),
        viscous_(model_.applied.viscous),
        W_L_(rotates ? model_.W_IL_L : Vector(Vector::Zero())) {}

  State start(const Scene& scene) const {
    const Release<double>& release = scene.release<double>();
    const bool inertial = scene.scenario().release.rates_relative_to == RatesRelativeTo::inertial;
    const Vector W_B = transposed_times(rotation_matrix(release.q_LB), W_L_);
    const Vector w = inertial ? release.w_XB_B : Vector(release.w_XB_B + W_B);
    const Quaternion<double>& q = release.q_LB;
    return {q.w, q.v[0], q.v[1], q.v[2], w[0], w[1], w[2]};
  }
  void operator()(const State& x, State& dxdt, double) const {
    const Quaternion<double> q{x[0], Vector(x[1], x[2], x[3])};
    const Mat3<double> R = rotation_matrix(q.normalized());
    const Vector w(x[4], x[5], x[6]), relative = w - transposed_times(R, W_L_);
    const Vector torque = model_.mass_moment_B.cross(transposed_times(R, model_.apparent_gravity_L)) - viscous_ * relative;
    const Vector dw = model_.I_BP_B_inverse * Vector(torque - w.cross(Vector(model_.I_BP_B * w)));
    const Quaternion<double> dq = turning(q, times(R, relative));
    dxdt = {dq.w, dq.v[0], dq.v[1], dq.v[2], dw[0], dw[1], dw[2]};
  }
  static Vector axis(const State& x) {
    return rotation_matrix(Quaternion<double>{x[0], Vector(x[1], x[2], x[3])}.normalized()).col(2);
  }

 private:
  Model<double> model_;
  double viscous_;
  Vector W_L_;
};

/// Motion on a level table, in its axes: attitude, rate relative to the table, slip and position of the tip.
class TableMotion {
 public:
  using State = std::array<double, 13>;
  TableMotion(const Scene& scene, bool rotates) : contact_(scene.problem<double>().table->contact) {
    const Model<double> model = scene.problem<double>().model;
    around_ = {Vector::UnitZ(), model.apparent_gravity_L, rotates ? model.W_IL_L : Vector(Vector::Zero()),
               Mat3<double>::Zero()};
  }
  State start(const Scene& scene) const {
    const DriftProblem<double> problem = scene.problem<double>();
    const Quaternion<double>& q = problem.release.q_LB;
    const Mat3<double> R = rotation_matrix(q);
    const Vector w = times(R, problem.natural_release().w_XB_B), p = problem.table->start.p_O;
    const Vector slip = contact_.law == ContactLaw::rolling
                            ? Vector(Vector::Zero())
                            : slip_at_release(problem.table->start, contact_, w, times(R, contact_.p_OC_B));
    return {q.w, q.v[0], q.v[1], q.v[2], w[0], w[1], w[2], slip[0], slip[1], slip[2], p[0], p[1], p[2]};
  }
  void operator()(const State& x, State& dxdt, double) const {
    const Quaternion<double> q{x[0], Vector(x[1], x[2], x[3])};
    const Mat3<double> R = rotation_matrix(q.normalized());
    const Vector w(x[4], x[5], x[6]);
    const GeneralContactState<double> state{R, times(turned_tensor(R, contact_.I_BC_B), w), Vector(x[7], x[8], x[9]),
                                            Vector(x[10], x[11], x[12])};
    const GeneralContactRates<double> rates = general_rates(contact_, around_, state);
    const Quaternion<double> dq = turning(q, w);
    const Vector &dw = rates.w_dot, &dv = rates.v_P, &dp = rates.p_O;
    const bool slips = contact_.law != ContactLaw::rolling;
    dxdt = {dq.w,  dq.v[0], dq.v[1], dq.v[2], dw[0], dw[1], dw[2], slips ? dv[0] : 0, slips ? dv[1] : 0, slips ? dv[2] : 0,
            dp[0], dp[1],   dp[2]};
  }
  static Vector axis(const State& x) { return PivotMotion::axis({x[0], x[1], x[2], x[3], 0, 0, 0}); }

 private:
  Contact<double> contact_;
  ContactSurroundings<double> around_;
};

/// The axes at the checkpoints. @param times  in the units of the motion
template <class Motion>
std::vector<Vector> axes_by_odeint(const Motion& motion, typename Motion::State x, const std::vector<double>& times,
                                   double tolerance) {
  using namespace boost::numeric::odeint;
  std::vector<Vector> axes;
  auto stepper = make_controlled(tolerance * 1e-2, tolerance, runge_kutta_fehlberg78<typename Motion::State>());
  integrate_times(stepper, std::cref(motion), x, times.begin(), times.end(), times[1] * 1e-4,
                  [&](const typename Motion::State& at, double) { axes.push_back(Motion::axis(at)); });
  return axes;
}
template <class Motion>
std::vector<double> drifts_by_odeint(const Scene& scene, const std::vector<double>& times, double tolerance) {
  const Motion rotating(scene, true), reference(scene, false);
  const auto first = axes_by_odeint(rotating, rotating.start(scene), times, tolerance);
  const auto second = axes_by_odeint(reference, reference.start(scene), times, tolerance);
  std::vector<double> drifts;
  for (std::size_t i = 0; i < first.size(); ++i)
    drifts.push_back(std::atan2(norm(first[i].cross(second[i])), first[i].dot(second[i])));
  return drifts;
}

template <class T>
std::vector<double> drifts_here(const Scene& scene, const std::vector<double>& times_s, const IntegrationOptions& options) {
  DriftProblem<T> problem = scene.problem<T>();
  problem.times_s = times_s;
  std::vector<double> drifts;
  for (const auto& sample : integrate_drift<T>(problem, options).samples)
    drifts.push_back(static_cast<double>(sample.measures.axis));
  return drifts;
}

struct Contender {
  double tolerance;
  std::function<std::vector<double>()> compute;
  double error = 0, seconds = HUGE_VAL;
};

/// The least time of those that reach the error, in ms.
std::string cheapest(const std::vector<Contender>& contenders, double error) {
  double best = HUGE_VAL;
  for (const Contender& contender : contenders)
    if (contender.error <= error) best = std::min(best, contender.seconds);
  return best == HUGE_VAL ? "-" : fmt::format("{:.3g}", 1e3 * best);
}

void compare(const std::string& file, int rounds) {
  const Scene scene(parse_scenario(read_scenario_source(std::string(EARTHTOP_BENCH_SCENARIOS) + "/" + file + ".json")));
  std::vector<double> times_s, times;
  const DriftProblem<double> problem = scene.problem<double>();
  const bool on_table = problem.table.has_value();
  for (std::size_t i = 0; i <= kCheckpoints; ++i) {
    times_s.push_back(scene.scenario().duration_s * static_cast<double>(i) / kCheckpoints);
    times.push_back(on_table ? problem.units.time_from_s(times_s.back()) : times_s.back());
  }
  IntegrationOptions options = scene.choice().options;
  options.relative_tolerance = 1e-17;
  const std::vector<double> exact = drifts_here<float80>(scene, times_s, options);
  std::array<std::vector<Contender>, 2> all;
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12, 1e-13}) {
    options.relative_tolerance = tolerance;
    all[0].push_back({tolerance, [&scene, &times_s, options] { return drifts_here<double>(scene, times_s, options); }});
    all[1].push_back({tolerance, [&scene, &times, tolerance, on_table] {
                        return on_table ? drifts_by_odeint<TableMotion>(scene, times, tolerance)
                                        : drifts_by_odeint<PivotMotion>(scene, times, tolerance);
                      }});
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < all[0].size(); ++i)
      for (auto& side : all) {
        const double begin = processor_seconds();
        const std::vector<double> drifts = side[i].compute();
        side[i].seconds = std::min(side[i].seconds, processor_seconds() - begin);
        side[i].error = drifts.size() == exact.size() ? 0 : HUGE_VAL;
        for (std::size_t k = 0; k < std::min(drifts.size(), exact.size()); ++k)
          side[i].error = std::max(side[i].error, std::abs(drifts[k] - exact[k]));
      }
  fmt::print("| `{}` | {:.3g} |", file, exact.back());
  for (const auto& side : all) {
    std::string cells;
    for (const double error : kErrors) cells += (cells.empty() ? "" : " / ") + cheapest(side, error);
    fmt::print(" {} |", cells);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
  fmt::print("| scene, 60 s | drift at the end (rad) | reference and deviation, here | two motions by rkf78, Boost.Odeint |\n");
  fmt::print("| --- | ---: | ---: | ---: |\n");
  for (const char* file : {"toy-top-viscous", "table-rolling", "table-viscous"}) compare(file, rounds);
}
