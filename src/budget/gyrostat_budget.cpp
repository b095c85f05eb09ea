// SPDX-License-Identifier: GPL-3.0-or-later
#include "budget/gyrostat_budget.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "budget/drift_scene.hpp"
#include "budget/effects.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/gyrostat.hpp"
#include "earthtop/scenario/support.hpp"

namespace earthtop {
namespace {

/// A torque (N m) along the motion on the rotating Earth.
struct Size {
  double at_release = 0, largest = 0;
  void include(double torque, bool is_release) {
    if (is_release) at_release = torque;
    largest = std::max(largest, torque);
  }
};
struct Sizes {
  Size coriolis, inside, centrifugal, bearing;
};

Sizes sizes_of(const Scene& scene, const DriftTrajectory<double>& drift) {
  const Model<double>& model = scene.model<double>();
  const auto& spec = scene.scenario().rotor;
  const Rotor<double> rotor = spec ? make_rotor<double>(*spec) : model.rotor;
  const ModelInTime<double> in_time(model);
  Sizes sizes;
  for (const DriftSample<double>& sample : drift.samples) {
    const bool is_release = &sample == &drift.samples.front();
    const Vec3<double> W_B = transposed_times(rotation_matrix(sample.state.q_LB), model.W_IL_L);
    const double rate = sample.rotor ? sample.rotor->rate : 0, t_s = sample.state.t_s;
    const Mat3<double>& S_BP_B = in_time.at(t_s).S_BP_B;
    Mat3<double> inside = spin_velocity_moment(rotor, rate);
    if (const MassSums<double>* masses = in_time.masses_at(t_s)) inside += masses->velocity_moment;
    const Mat3<double> of_body = velocity_moment(S_BP_B, sample.state.w_LB_B);
    sizes.coriolis.include(norm(coriolis_torque(W_B, Mat3<double>(of_body + inside))), is_release);
    sizes.inside.include(norm(coriolis_torque(W_B, inside)), is_release);
    sizes.centrifugal.include(norm(centrifugal_torque(W_B, S_BP_B)), is_release);
    sizes.bearing.include(std::abs(bearing_torque(rotor, rate)), is_release);
  }
  return sizes;
}

void give(const Size& size, EffectEntry& entry) {
  entry.torque_release_N_m = size.at_release, entry.torque_largest_N_m = size.largest;
}

EffectEntry entry_of(const Effect& effect, const Sizes& sizes, const Scene& scene) {
  EffectEntry entry = unsized_entry(effect, scene);
  const auto& rotor = scene.scenario().rotor;
  const bool is_driven = !rotor || rotor->drive != RotorDrive::none;
  if (effect.name == kCoriolis) {
    give(sizes.coriolis, entry);
    entry.in_difference = true;
    entry.reason = fmt::format("an effect of the Earth's rotation; on {} alone it is {:.2e} N m at most",
                               masses_move(scene.scenario()) ? "what moves in the body" : "the rotor's turn in the body",
                               sizes.inside.largest);
  } else if (effect.name == kCentrifugal) {
    give(sizes.centrifugal, entry);
    entry.in_difference = true;
    entry.reason = "of second order in the Earth's rate; the first-order part is in apparent gravity";
  } else if (effect.name == kRotorBearing && !is_driven) {
    give(sizes.bearing, entry);
  } else if (entry.reason.empty()) {
    entry.reason = fmt::format("{}; sized only for a rigid body", entry.modelled ? "as given" : "left out");
  }
  return entry;
}

/// How long the motion is followed (s): to its end, up to a limit of cost.
double followed_s(const Scene& scene) {
  const double duration_s = scene.scenario().duration_s, seconds = drift_scene(scene).costs()[0].seconds;
  return duration_s * std::min(1.0, kAffordableDrift_s / seconds);
}

}  // namespace

double gyrostat_budget_seconds(const Scene& scene) {
  return std::min(kAffordableDrift_s, drift_scene(scene).costs()[0].seconds);
}

Budget gyrostat_budget(const Scene& scene, const Watch& watch) {
  constexpr int kTimes = 4000;  // at which torques are looked at
  const Scene followed = drift_scene(scene);
  DriftProblem<double> problem = followed.problem_without_rows<double>();
  Budget budget;
  budget.followed_s = followed_s(scene);
  problem.times_s.clear();
  for (int i = 0; i <= kTimes; ++i) problem.times_s.push_back(budget.followed_s * i / kTimes);
  const DriftTrajectory<double> drift = integrate_drift(problem, followed.choice().options, watch);
  const bool completed = drift.status == RunStatus::completed && !drift.samples.empty();
  const double later = scene.scenario().duration_s / budget.followed_s;
  budget.earth_drift_rad = completed ? later * drift.samples.back().measures.axis : std::numeric_limits<double>::quiet_NaN();
  const Sizes sizes = sizes_of(followed, drift);
  for (const Effect& effect : all_effects())
    if (effect.is_in_budget(scene)) budget.effects.push_back(entry_of(effect, sizes, scene));
  budget.inputs_unavailable =
      masses_move(scene.scenario())
          ? "how well they must be known is not computed with masses that move in the body; run the scenario with each of "
            "them changed"
          : "how well they must be known is not computed with a rotor in the body; run the scenario with each of them changed";
  budget.warnings.emplace_back(scene.support().no_effect_sizes);
  return budget;
}

}  // namespace earthtop
