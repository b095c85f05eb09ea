// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/contact_growth.hpp"

#include <algorithm>

#include "drift/derivatives/contact_tangents.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kFollowed = kContactDisturbances.size();
constexpr double kSettlingPath = 3;    // growth while the axis settles, as if it had gone so far
constexpr double kPointSpacing = 0.1;  // e-foldings from one point of the history to the next

Vec3<double> difference(const Vec3<Paired<double>>& v) { return {v[0].diff, v[1].diff, v[2].diff}; }
Vec3<double> reference(const Vec3<Paired<double>>& v) { return {v[0].ref, v[1].ref, v[2].ref}; }

using Reduced = ContactReducedDrift<double, Observer::laboratory>;
using General = ContactGeneralDrift<double, Observer::laboratory>;

/// Puts a turn of the attitude and a change of the rate, both in the table's axes, into the differences of a pair.
void disturb(const Reduced& drift, const Vec3<double>& turn, const Vec3<double>& rate, Reduced::State& x) {
  using Shape = Reduced::Shape;
  const PairedTop<double> top = drift.equations().top(x, 0);
  const Vec3<double> n = reference(top.state.n), u = reference(top.state.u), a = reference(top.a);
  const Vec3<double> dn = turn.cross(n), da = turn.cross(a);
  // The rate along the axis is a variable of its own, and the rest stays normal to the axis.
  const Vec3<double> du = rate - n * (inner(n, rate) + inner(u, dn));
  store_vector(dn, x, Shape::kHalf + Shape::kN), store_vector(du, x, Shape::kHalf + Shape::kU);
  store_vector(da, x, Shape::kHalf + Shape::kA);
  x[Shape::kHalf + Shape::kSpin] = inner(n, rate);
}
void disturb(const General& drift, const Vec3<double>& turn, const Vec3<double>& rate, General::State& x) {
  using Shape = General::Shape;
  store_vector(Vec3<double>(turn / 2), x, Shape::kHalf + 1);
  const Mat3<double> R = rotation_matrix(General::Equations::reference_attitude(x));
  const Vec3<double> change = times(R, times(drift.equations().contact().I_BC_B, transposed_times(R, rate)));
  store_vector(change, x, Shape::kHalf + Shape::kMomentum);
}

/// Axis and its change, and the change of the spin.
struct Seen {
  Vec3<double> axis, change;
  double spin_change;
};
Seen seen(const Reduced&, const Reduced::State& x, double) {
  using Shape = Reduced::Shape;
  return {load_vector(x, Shape::kN), load_vector(x, Shape::kHalf + Shape::kN), x[Shape::kHalf + Shape::kSpin]};
}
Seen seen(const General& drift, const General::State& x, double t) {
  const ContactDriftState<double> state = drift.contact_state(x, t);
  return {reference(state.axis_L), difference(state.axis_L), state.spin.diff};
}

template <class Drift>
ContactGrowth follow(const DriftProblem<double>& problem, double duration_s, double relative_tolerance, const Watch& watch) {
  using Tangents = ContactTangents<Drift>;
  const Model<double> model = without_earth_rate(problem.model);
  const TableProblem<double>& table = *problem.table;
  const Tangents motion(Drift(model, table.contact, table.start, problem.natural_release()), {kFollowed});
  const Drift& drift = motion.drift();

  const double spin = norm(problem.natural_release().w_XB_B);
  const double rate = spin > 0 ? spin : problem.fastest_rate;
  typename Tangents::State x = motion.initial_state();
  for (std::size_t d = 0; d < kFollowed; ++d) {
    auto pair = Tangents::pair(x, d);
    disturb(drift, kContactDisturbances[d].turn(), kContactDisturbances[d].rate() * rate, pair);
    Tangents::put_change(pair, x, d);
  }
  GroupScales<double, typename Tangents::Shape> scales;
  scales.include(x), scales.include(motion.typical_state());
  taylor::TaylorStepper<double, Tangents> stepper(relative_tolerance, scales);
  auto series = motion.series();
  ContactGrowth growth;
  const double end = problem.units.time_from_s(duration_s);
  const double longest = 1 / problem.fastest_rate;  // the path of the axis is measured from step to step
  stepper.initialize(x, 0);
  double t = 0, path = 0;
  Vec3<double> axis = seen(drift, Tangents::pair(x, 0), 0).axis;
  for (; t < end; ++growth.counters.accepted) {
    if (watch.asks_to_stop() || growth.counters.accepted >= kMostTangentSteps) return growth;
    if (growth.counters.accepted % 64 == 0) watch.reach(t / end);
    stepper.limit_step(std::min(longest, end - t));
    stepper.do_step(series);
    growth.counters.evaluations += stepper.evaluations();
    const double step = stepper.current_time_step();
    x = stepper.current_state();
    if (!(t + step > t) || !all_finite(x)) return growth;
    t = step < end - t ? stepper.current_time() : end;
    scales.include(x);

    double grown = 0;
    for (std::size_t d = 0; d < kFollowed; ++d) {
      const Seen now = seen(drift, Tangents::pair(x, d), t);
      grown = std::max(grown, real::hypot(norm(now.change), now.spin_change / rate));
      if (d > 0) continue;
      path += norm(Vec3<double>(now.axis - axis));
      axis = now.axis;
    }
    growth.largest = std::max(growth.largest, grown);
    growth.largest_ratio = std::max(growth.largest_ratio, grown / (kSettlingPath + path));
    growth.end_s = real::scale(t, problem.units.time_exponent);
    growth.log_last = real::log(grown);
    if (growth.history.empty() || real::abs(growth.log_last - growth.history.back().log_growth) > kPointSpacing)
      growth.history.push_back({growth.end_s, growth.log_last});
    if (!growth.exponential_s && grown > kRegularGrowth * (1 + problem.fastest_rate * t)) growth.exponential_s = growth.end_s;
  }
  growth.completed = true;
  return growth;
}

}  // namespace

std::optional<GrowthSpan> ContactGrowth::beyond(double log_growth) const {
  const auto is_beyond = [&](const GrowthPoint& point) { return point.log_growth >= log_growth; };
  const auto first = std::ranges::find_if(history, is_beyond);
  if (first == history.end()) return std::nullopt;
  const auto after = std::find_if(history.rbegin(), history.rend(), is_beyond).base();
  return GrowthSpan{first->t_s, after == history.end() ? std::nullopt : std::optional(after->t_s)};
}

ContactGrowth contact_growth(const DriftProblem<double>& problem, double duration_s, double relative_tolerance,
                             const Watch& watch) {
  return is_symmetric(problem.table->contact) ? follow<Reduced>(problem, duration_s, relative_tolerance, watch)
                                              : follow<General>(problem, duration_s, relative_tolerance, watch);
}

}  // namespace earthtop
