// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/contact_tangents.hpp"  // must come first: the formulas included below are compiled for jets
//
#include <algorithm>

#include "drift/derivatives/contact_growth.hpp"
#include "drift/derivatives/tangent_steps.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kFollowed = kContactDisturbances.size();
constexpr double kSettlingPath = 3;    // growth while the axis settles, as if it had gone so far
constexpr double kPointSpacing = 0.1;  // e-foldings from one point of the history to the next

Vec3<double> values_at(const Vec3<Jet>& v) { return {v[0].value, v[1].value, v[2].value}; }
Vec3<double> change_of(const Vec3<Jet>& v, std::size_t d) { return {v[0].d[d], v[1].d[d], v[2].d[d]}; }

/// Disturbs a motion by a turn of the attitude and a change of the rate, both in the table's axes.
template <class Motion>
void disturb(const Contact<double>& contact, const Vec3<double>& turn, const Vec3<double>& rate, std::size_t d,
             typename Motion::Values& x) {
  using Shape = typename Motion::Shape;
  const auto put = [&](const Vec3<double>& change, std::size_t at) {
    for (std::size_t i = 0; i < 3; ++i) x[at + i].d[d] = change[static_cast<int>(i)];
  };
  if constexpr (std::is_same_v<typename Motion::System, ContactReducedJets>) {
    const Vec3<double> n = values_at(load_vector(x, Shape::kN)), u = values_at(load_vector(x, Shape::kU)), dn = turn.cross(n);
    // The rate along the axis is a variable of its own, and the rest stays normal to the axis.
    put(dn, Shape::kN), put(turn.cross(values_at(load_vector(x, Shape::kA))), Shape::kA);
    put(rate - n * (inner(n, rate) + inner(u, dn)), Shape::kU);
    x[Shape::kSpin].d[d] = inner(n, rate);
  } else {
    const Quaternion<Jet> q = load_quaternion(x, 0);
    const Quaternion<double> q_HB{q.w.value, values_at(q.v)};
    const Quaternion<double> turned = Quaternion<double>{0, Vec3<double>(turn / 2)} * q_HB;
    x[0].d[d] = turned.w;
    put(turned.v, 1);
    // The momentum turns along.
    const Mat3<double> R = rotation_matrix(q_HB);
    put(times(R, times(contact.I_BC_B, transposed_times(R, rate))) + turn.cross(values_at(load_vector(x, Shape::kMomentum))),
        Shape::kMomentum);
  }
}

/// The rate about body axis 3.
template <class Motion>
Jet spin_of(const Motion& motion, const typename Motion::Values& x) {
  using Shape = typename Motion::Shape;
  if constexpr (std::is_same_v<typename Motion::System, ContactReducedJets>) {
    return x[Shape::kSpin];
  } else {
    const Vec3<Jet> momentum_B = transposed_times(rotation_matrix(load_quaternion(x, 0)), load_vector(x, Shape::kMomentum));
    return times(motion.system().equations().contact().I_BC_B_inverse, momentum_B)[2];
  }
}

template <class System>
ContactGrowth follow(const DriftProblem<double>& problem, double duration_s, double relative_tolerance, const Watch& watch) {
  using Motion = ContactTangents<System, OnTable::reference>;
  using Tangents = JetTangents<Motion>;
  using State = typename Tangents::State;
  const Motion motion(problem, {}, kFollowed);
  const double spin = norm(problem.natural_release().w_XB_B);
  const double rate = spin > 0 ? spin : problem.fastest_rate;
  auto start = motion.initial_state();
  for (std::size_t d = 0; d < kFollowed; ++d)
    disturb<Motion>(problem.table->contact, kContactDisturbances[d].turn(), kContactDisturbances[d].rate() * rate, d, start);
  State x = Tangents::packed(start);
  TangentSteps<Tangents> steps(typename Tangents::Series([&](const State& at, double t) { return motion.record(at, t); }), x,
                               relative_tolerance);
  steps.include(Tangents::packed(motion.typical_state()));
  ContactGrowth growth;
  // The path of the axis is measured from step to step.
  const TangentLimits limits{.end = problem.units.time_from_s(duration_s), .longest = 1 / problem.fastest_rate};
  double path = 0;
  Vec3<double> axis = values_at(reference_axis<System>(start));
  const RunStatus status = follow_tangents(steps, x, limits, growth.counters, watch, [&](const State& now, double t) {
    const auto jets = Tangents::unpacked(now);
    const Vec3<Jet> seen = reference_axis<System>(jets);
    const Jet spin_seen = spin_of(motion, jets);
    double grown = 0;
    for (std::size_t d = 0; d < kFollowed; ++d)
      grown = std::max(grown, real::hypot(norm(change_of(seen, d)), spin_seen.d[d] / rate));
    path += norm(Vec3<double>(values_at(seen) - axis));
    axis = values_at(seen);
    growth.largest = std::max(growth.largest, grown);
    growth.largest_ratio = std::max(growth.largest_ratio, grown / (kSettlingPath + path));
    growth.end_s = real::scale(t, problem.units.time_exponent);
    growth.log_last = real::log(grown);
    if (growth.history.empty() || real::abs(growth.log_last - growth.history.back().log_growth) > kPointSpacing)
      growth.history.push_back({growth.end_s, growth.log_last});
    if (!growth.exponential_s && grown > kRegularGrowth * (1 + problem.fastest_rate * t)) growth.exponential_s = growth.end_s;
  });
  growth.completed = status == RunStatus::completed;
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
  return is_symmetric(problem.table->contact) ? follow<ContactReducedJets>(problem, duration_s, relative_tolerance, watch)
                                              : follow<ContactGeneralJets>(problem, duration_s, relative_tolerance, watch);
}

}  // namespace earthtop
