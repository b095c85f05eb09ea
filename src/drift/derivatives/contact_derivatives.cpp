// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift/derivatives/contact_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drift/derivatives/contact_tangents.hpp"
#include "drift/table/contact_stop_integration.hpp"
#include "integrate/taylor/stabilised_taylor.hpp"
#include "integrate/taylor/taylor_stepper.hpp"

namespace earthtop {
namespace {

/// A step's tolerance where its last terms are weighted, as a share of what the last of all terms is held to otherwise.
constexpr double kStabilisedShare = 1e-3;

/// Whether slip relaxes so fast, compared with the motion, that steps would be kept short by it.
bool is_stiff(const DriftProblem<double>& problem) {
  constexpr double kFast = 5;  // times the motion's fastest rate; plain steps of low order are stable up to as much
  const Contact<double>& c = problem.table->contact;
  double slow_slip = 0;  // below which friction is in proportion to slip
  if (c.law == ContactLaw::coulomb) slow_slip = c.slip_floor;
  if (c.law == ContactLaw::contensou) slow_slip = c.slip_of_spin * c.patch_radius * norm(problem.natural_release().w_XB_B);
  const double arm = c.tip_radius + std::abs(c.height_of_center), across = std::min(c.I1, c.I3);
  const double most = c.coefficient * norm(problem.model.apparent_gravity_L) * (1 + c.mass * arm * arm / across);
  return slow_slip > 0 && most > kFast * problem.fastest_rate * slow_slip;
}

/// Follows a motion with its derivatives to a time.   @param take  called with (x, t, longest): takes one step, and returns how long it is
/// @returns whether it came there
template <class State, class Scales, class TakeStep>
bool follow(State& x, double end, Scales& scales, StepCounters& counters, const Watch& watch, const TakeStep& take) {
  for (double t = 0; t < end; ++counters.accepted) {
    if (watch.asks_to_stop() || counters.accepted >= kMostTangentSteps) return false;
    if (counters.accepted % 64 == 0) watch.reach(t / end);
    const double step = take(x, t, end - t);
    if (!(t + step > t) || !all_finite(x)) return false;
    t = step < end - t ? t + step : end;
    scales.include(x);
  }
  return true;
}

template <class Drift>
ContactDerivatives derivatives(const DriftProblem<double>& problem, std::span<const ContactChange<double>> changes, double at_s,
                               double relative_tolerance, const Watch& watch) {
  const Model<double> model = without_earth_rate(problem.model);
  if (changes.size() > kMostContactChanges) throw std::logic_error("too many changes of a motion on a table");
  ContactChanges all{changes.size()};
  std::ranges::copy(changes, all.of_inputs.begin());
  using Tangents = ContactTangents<Drift>;
  const Tangents motion(Drift(model, problem.table->contact, problem.table->start, problem.natural_release()), all);

  typename Tangents::State x = motion.initial_state();
  GroupScales<double, typename Tangents::Shape> scales;
  scales.include(x), scales.include(motion.typical_state());
  auto series = motion.series();
  ContactDerivatives found;
  const double end = problem.units.time_from_s(at_s);
  if (is_stiff(problem)) {
    taylor::StabilisedTaylor<Tangents> stepper(relative_tolerance * kStabilisedShare, scales);
    const auto take = [&](auto& state, double t, double longest) {
      found.counters.evaluations += taylor::kStabilisedDegree;
      return stepper.step(series, state, t, longest);
    };
    found.completed = follow(x, end, scales, found.counters, watch, take);
  } else {
    taylor::TaylorStepper<double, Tangents> stepper(relative_tolerance, scales);
    stepper.initialize(x, 0);
    const auto take = [&](auto& state, double, double longest) {
      stepper.limit_step(longest);
      stepper.do_step(series);
      found.counters.evaluations += stepper.evaluations();
      state = stepper.current_state();
      return stepper.current_time_step();
    };
    found.completed = follow(x, end, scales, found.counters, watch, take);
  }
  if (!found.completed) return found;
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const ContactDriftState<double> state = motion.contact_state(x, c, end);
    const auto change = [](const Vec3<Paired<double>>& v) { return Vec3<double>(v[0].diff, v[1].diff, v[2].diff); };
    found.each.push_back({change(state.axis_L), change(state.tip_L)});
  }
  return found;
}

/// Whether the top rolls from its release on, as under exact dry friction without a slip.
bool rolls_from_release(const DriftProblem<double>& problem) {
  const TableProblem<double>& table = *problem.table;
  return has_exact_coulomb(table.contact) && !slips_at_release(ContactReducedDrift<double, Observer::laboratory>(
                                                 problem.model, table.contact, table.start, problem.natural_release()));
}

}  // namespace

ContactDerivatives contact_derivatives(const DriftProblem<double>& problem, std::span<const ContactChange<double>> changes,
                                       double at_s, double relative_tolerance, const Watch& watch) {
  if (changes.empty()) return {true, {}, {}};
  if (rolls_from_release(problem)) {
    DriftProblem<double> rolling = problem;
    rolling.table->contact.law = ContactLaw::rolling;
    return contact_derivatives(rolling, changes, at_s, relative_tolerance, watch);
  }
  return is_symmetric(problem.table->contact)
             ? derivatives<ContactReducedDrift<double, Observer::laboratory>>(problem, changes, at_s, relative_tolerance, watch)
             : derivatives<ContactGeneralDrift<double, Observer::laboratory>>(problem, changes, at_s, relative_tolerance,
                                                                              watch);
}

}  // namespace earthtop
