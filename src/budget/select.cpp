// "auto": what a scene needs at the accuracy asked for, found by an estimate that errs to the safe side, and by the variational
// equations where the estimate cannot tell.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "earthtop/budget/budget.hpp"
#include "earthtop/frames/earth_orientation.hpp"
#include "scenario/problem.hpp"

namespace earthtop {
namespace {

constexpr double kShare = 0.1;            // of the accuracy asked for: what is left out may cost so much, each
constexpr double kSafety = 3;             // of a first-order size
constexpr double kTide_m_s2 = 2e-6;       // more than Moon and Sun ever add
constexpr double kPole = 3e-6;            // rad; more than the secular pole is away
constexpr double kAffordablePhase = 1e5;  // rad

struct Option {
  std::string_view name;
  double estimate_rad = HUGE_VAL;  ///< of the change of the drift; without end where none is safe
};

bool has_gradient(const Scenario& s) { return s.effects.applied.gravity_gradient.has_value(); }
bool has_pole(const Scenario& s) { return s.site.pole.x_arcsec != 0 || s.site.pole.y_arcsec != 0; }

void switch_on(Scenario& scenario, std::string_view name) {
  if (name == "gravity_gradient") scenario.effects.applied.gravity_gradient = GravityGradientSpec{GradientField::normal, 0};
  if (name == "tide") scenario.effects.tide = TideSpec{};
  if (name == "polar_motion") scenario.site.pole = secular_pole(julian_epoch_year(*parse_utc(*scenario.start_utc)));
}

/// The drift, and by how much a torque of both predictions displaces the axis in each, to the safe side: for symmetric tops on
/// a pivot at rest, whose axis moves under a torque no faster than torque over momentum.
struct SimpleSizes {
  double drift_rad, displacement_per_N_m;
};
std::optional<SimpleSizes> simple_sizes(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  if (scenario.platform || scenario.effects.applied.any() || symmetry_axis(body) != 2) return std::nullopt;
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const double I1 = body.I_BP_B(0, 0), momentum = std::abs(body.I_BP_B(2, 2) * release.w_XB_B[2]);
  const double mgl = std::abs(body.mass * scenario.site.gravity_m_s2 * body.p_PBcm_B[2]);
  // Asleep or fast: twice the critical spin. Slower ones may fall, and where they are differs with everything.
  if (momentum * momentum < 16 * I1 * mgl) return std::nullopt;
  if (momentum == 0) return std::nullopt;
  const double earth_angle = std::abs(scenario.rotation_rate_rad_s) * scenario.duration_s;
  return SimpleSizes{std::min(kSafety * earth_angle, 3.2), kSafety * scenario.duration_s / momentum};
}

std::vector<Option> options_of(const Scenario& scenario) {
  std::vector<Option> options;
  const auto sizes = simple_sizes(scenario);
  const auto body = make_body<double>(scenario.body);
  const auto add = [&](std::string_view name, double torque_N_m, double share) {
    Option option{name, HUGE_VAL};
    if (sizes) option.estimate_rad = sizes->drift_rad * (kSafety * torque_N_m * sizes->displacement_per_N_m + share);
    options.push_back(option);
  };
  const Vec3<double> moments = body.I_BP_B.diagonal();
  if (!has_gradient(scenario)) add("gravity_gradient", 2.4e-6 * (moments.maxCoeff() - moments.minCoeff()), 0);
  if (!scenario.start_utc) return options;
  if (!scenario.effects.tide) add("tide", body.mass * norm(body.p_PBcm_B) * kTide_m_s2, 0);
  if (!has_pole(scenario)) add("polar_motion", 0, kPole);
  return options;
}

}  // namespace

Selection select_effects(Scenario& scenario, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  Selection selection;
  selection.accuracy_rad = scenario.accuracy_rad.value_or(0);
  std::vector<Option> options = options_of(scenario);
  const double allowed = kShare * selection.accuracy_rad;
  const bool told = std::all_of(options.begin(), options.end(), [&](const Option& o) { return o.estimate_rad <= allowed; });
  const bool affordable = fastest_rate_rad_s(scenario) * scenario.duration_s <= kAffordablePhase;
  if (told) {
    selection.how = "an estimate from torque, momentum and time, to the safe side";
  } else if (affordable) {
    selection.how = "first variations of both motions";
    const Budget budget = effect_budget(scenario, BudgetScope::selectable, stop);
    for (Option& option : options)
      for (const EffectEntry& entry : budget.effects)
        if (entry.name == option.name && std::isfinite(entry.drift_rad.value_or(HUGE_VAL)))
          option.estimate_rad = std::min(option.estimate_rad, kSafety * *entry.drift_rad);
  } else {
    selection.how = "what an estimate does not exclude is taken: the motion is too long to be followed for a choice";
  }
  for (const Option& option : options) {
    if (option.estimate_rad <= allowed) {
      selection.left_out.emplace_back(option.name);
      selection.left_out_drift_rad += option.estimate_rad;
    } else {
      switch_on(scenario, option.name);
      selection.switched_on.emplace_back(option.name);
    }
  }
  selection.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return selection;
}

}  // namespace earthtop
