// "auto": what a scene needs at the accuracy asked for.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "earthtop/budget/budget.hpp"
#include "earthtop/drift/growth.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "earthtop/model/applied_motion.hpp"
#include "scenario/problem.hpp"

namespace earthtop {
namespace {

constexpr double kTolerance = 1e-6;
constexpr double kFollowedPhase = 1e7;  // rad: half a minute; later displacements are taken in proportion to the time
constexpr double kShare = 0.2;          // of the accuracy asked for: what each effect left out may cost of it
// An effect of both predictions changes their difference by no more than its displacement of each times the drift itself, times
// a number of order 1 (over 300 random scenes this one was enough); one of the Earth's rate by its share of the drift.
constexpr double kSafety = 5;
constexpr double kPole = 3e-6;  // rad; more than the secular pole is away

struct Option {
  std::string_view name;
  double change_rad;  ///< of the drift, to the safe side; without end where nothing is known
};

bool has_gradient(const Scenario& s) { return s.effects.applied.gravity_gradient.has_value(); }
bool has_pole(const Scenario& s) { return s.site.pole.x_arcsec != 0 || s.site.pole.y_arcsec != 0; }

void switch_on(Scenario& scenario, std::string_view name) {
  if (name == "gravity_gradient") scenario.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  if (name == "tide") scenario.effects.tide = TideSpec{};
  if (name == "polar_motion") scenario.site.pole = secular_pole(julian_epoch_year(*parse_utc(*scenario.start_utc)));
}

/// How far the gradient, the tide and the Earth's rotation displace the axis of the non-rotating motion.
struct Displacements {
  double gradient_rad, tide_rad, earth_rad;
};

Displacements displacements(const Scenario& scenario, const std::atomic<bool>* stop) {
  const auto problem = make_problem<double>(scenario);
  const Model<double>& model = problem.model;
  const double time_s = std::min(scenario.duration_s, kFollowedPhase / fastest_rate_rad_s(scenario));
  const double later = scenario.duration_s / time_s;

  AppliedTorquesSpec spec;
  spec.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  AppliedTorques<double> gradient =
      make_applied_torques<double>(spec, scenario.site, 0, problem.units.mass_exponent, problem.units.time_exponent);
  const double strength = std::max(std::abs(gradient.gradient[0].strength), std::abs(gradient.gradient[1].strength));
  for (auto& term : gradient.gradient) term.strength /= strength;
  // About an hour of it shows its size; the largest component stands for all of it.
  const double tide_SI = scenario.start_utc ? norm(tidal_acceleration_L(scenario.site, *parse_utc(*scenario.start_utc))) : 0;
  const double tide = real::scale(std::max(tide_SI, 1e-6), 2 * problem.units.time_exponent);

  const auto seen = [](const Motion<double>& m, const Vec3<double>& u_L) {
    return transposed_times(rotation_matrix(m.q), u_L);
  };
  std::array<Forcing, kForcings> forcings;
  forcings[0].torque_B = [&](double, const Motion<double>& m) {
    Vec3<double> torque = Vec3<double>::Zero();
    for (const auto& term : gradient.gradient) torque += gravity_gradient_torque(term, model.I_BP_B, seen(m, term.direction_L));
    return torque;
  };
  const Vec3<double> level_L = Vec3<double>(1, 1, 0) / std::sqrt(2.0);
  forcings[1].torque_B = [&, level_L](double, const Motion<double>& m) {
    return field_torque(model.mass_moment_B, Vec3<double>(seen(m, level_L)));
  };
  const double rate = norm(model.W_IL_L);
  const Vec3<double> W_L = rate > 0 ? Vec3<double>(model.W_IL_L / rate) : Vec3<double>(Vec3<double>::Zero());
  forcings[2].lag_B = [&, W_L](double, const Motion<double>& m) { return seen(m, W_L); };
  if (problem.release.X == RatesRelativeTo::laboratory)
    forcings[2].dw_at_release_B = transposed_times(rotation_matrix(problem.release.q_LB), W_L);
  const ForcedDisplacements displaced = forced_displacements(problem, forcings, time_s, kTolerance, stop);
  const auto grown = [&](std::size_t i, double size) {
    return displaced.completed ? later * size * displaced.largest_rad[i] : HUGE_VAL;
  };
  return {grown(0, strength), grown(1, tide), grown(2, rate)};
}

std::vector<Option> options_of(const Scenario& scenario, const std::atomic<bool>* stop) {
  const Displacements d = displacements(scenario, stop);
  const double drift_rad = std::min(d.earth_rad, 3.2);
  std::vector<Option> options;
  if (!has_gradient(scenario)) options.push_back({"gravity_gradient", kSafety * d.gradient_rad * drift_rad});
  if (!scenario.start_utc) return options;
  if (!scenario.effects.tide) options.push_back({"tide", kSafety * d.tide_rad * drift_rad});
  if (!has_pole(scenario)) options.push_back({"polar_motion", kPole * d.earth_rad});
  return options;
}

}  // namespace

Selection select_effects(Scenario& scenario, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  Selection selection;
  selection.accuracy_rad = scenario.accuracy_rad.value_or(0);
  for (const Option& option : options_of(scenario, stop)) {
    if (option.change_rad <= kShare * selection.accuracy_rad) {
      selection.left_out.emplace_back(option.name);
      selection.left_out_drift_rad += option.change_rad;
    } else {
      switch_on(scenario, option.name);
      selection.switched_on.emplace_back(option.name);
    }
  }
  selection.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return selection;
}

}  // namespace earthtop
