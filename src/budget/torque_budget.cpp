// SPDX-License-Identifier: GPL-3.0-or-later
#include "budget/torque_budget.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "budget/drift_scene.hpp"
#include "budget/effects.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/gimbal_ledger.hpp"
#include "earthtop/model/gyrostat.hpp"
#include "earthtop/model/laboratory_now.hpp"
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
  Size coriolis, inside, transport, transverse, centrifugal, bearing;
};

Sizes sizes_of(const Scene& scene, const DriftTrajectory<double>& drift) {
  const Model<double>& model = scene.model<double>();
  const auto& spec = scene.scenario().rotor;
  const Rotor<double> rotor = spec ? make_rotor<double>(*spec) : model.rotor;
  const ModelInTime<double> in_time(model);
  Sizes sizes;
  for (const DriftSample<double>& sample : drift.samples) {
    const bool is_release = &sample == &drift.samples.front();
    const double rate = sample.rotor ? sample.rotor->rate : 0, t_s = sample.state.t_s;
    const LaboratoryNow<double> now(model, t_s);
    const auto in_body = [&](const Vec3<double>& u_L) -> Vec3<double> {
      return transposed_times(rotation_matrix(sample.state.q_LB), u_L);
    };
    const Vec3<double> w_IL_B = in_body(now.w_IL_L);
    sizes.bearing.include(std::abs(bearing_torque(rotor, rate)), is_release);
    if (sample.gimbals) {
      const GimbalState<double>& g = *sample.gimbals;
      const LedgerEntry<double> seen =
          ledger_entry_in_gimbals(LedgerObserver::laboratory, model, t_s,
                                  GimbalAngles<double>{g.outer.rot, g.inner.rot, g.outer_rate.rot, g.inner_rate.rot}, rate);
      sizes.coriolis.include(norm(seen.tau_cor_A), is_release);
      sizes.inside.include(norm(seen.tau_cor_gyroscopic_A), is_release);
      sizes.transport.include(norm(seen.tau_cor_transport_A), is_release);
      sizes.transverse.include(norm(seen.tau_trans_A), is_release);
      sizes.centrifugal.include(norm(seen.tau_cent_A), is_release);
      continue;
    }
    const Mat3<double>& S_BP_B = in_time.at(t_s).S_BP_B;
    Mat3<double> inside = spin_velocity_moment(rotor, rate);
    if (const MassSums<double>* masses = in_time.masses_at(t_s)) inside += masses->velocity_moment;
    const Mat3<double> of_body = velocity_moment(S_BP_B, sample.state.w_LB_B);
    const Mat3<double> of_both = of_body + inside;
    sizes.coriolis.include(norm(coriolis_torque(w_IL_B, of_both)), is_release);
    sizes.inside.include(norm(coriolis_torque(w_IL_B, inside)), is_release);
    sizes.transport.include(norm(coriolis_torque(in_body(now.w_EL_L), of_both)), is_release);
    sizes.transverse.include(norm(transverse_torque(in_body(now.alpha_IL_L), S_BP_B)), is_release);
    sizes.centrifugal.include(norm(centrifugal_torque(w_IL_B, S_BP_B)), is_release);
  }
  return sizes;
}

void give(const Size& size, EffectEntry& entry) {
  entry.torque_release_N_m = size.at_release, entry.torque_largest_N_m = size.largest;
}

/// Whether an effect makes the two motions differ: what the Earth's rotation does, or what the journey does if the reference stays.
bool is_in_difference(const Effect& effect, const std::optional<TravelSpec>& travel) {
  if (!travel || travel->reference == TravelReference::same_path)
    return effect.name == kCoriolis || effect.name == kCentrifugal ||
           (effect.name == kEotvos && travel->eotvos == TravelEotvos::rotating);
  return effect.name == kEotvos || effect.name == kBallistic || effect.name == kTransport;
}

EffectEntry entry_of(const Effect& effect, const Sizes& sizes, const Scene& scene) {
  EffectEntry entry = unsized_entry(effect, scene);
  const auto& rotor = scene.scenario().rotor;
  const auto& travel = scene.scenario().travel;
  const bool is_driven = !rotor || rotor->drive != RotorDrive::none;
  const bool has_parts = scene.support().has_moving_parts();
  entry.in_difference = entry.in_difference || is_in_difference(effect, travel);
  if (effect.name == kCoriolis) {
    give(sizes.coriolis, entry);
    entry.reason = travel ? "of the rate at which the laboratory turns in space" : "an effect of the Earth's rotation";
    if (has_parts)
      entry.reason += fmt::format("; on {} alone it is {:.2e} N m at most",
                                  scene.support().has_gimbals     ? "the momentum that the laboratory sees"
                                  : masses_move(scene.scenario()) ? "what moves in the body"
                                                                  : "the rotor's turn in the body",
                                  sizes.inside.largest);
  } else if (effect.name == kCentrifugal) {
    give(sizes.centrifugal, entry);
    entry.reason = travel ? "of second order in that rate; the first-order part of the Earth's is in apparent gravity"
                          : "of second order in the Earth's rate; the first-order part is in apparent gravity";
  } else if (effect.name == kTransverse && travel) {
    give(sizes.transverse, entry);
    entry.reason = "the rate at which the laboratory turns in space changes as it travels";
  } else if (effect.name == kTransport) {
    give(sizes.transport, entry);
    entry.reason += ": its share of the Coriolis torque";
  } else if (effect.name == kRotorBearing && !is_driven) {
    give(sizes.bearing, entry);
  } else if (entry.reason.empty()) {
    entry.reason = fmt::format("{}; sized only {}", entry.modelled ? "as given" : "left out",
                               has_parts ? "for a rigid body" : "against the same journey on an Earth that stands still");
  }
  return entry;
}

/// How long the motion is followed (s): to its end, up to a limit of cost.
double followed_s(const Scene& scene) {
  const double duration_s = scene.scenario().duration_s, seconds = drift_scene(scene).costs()[0].seconds;
  return duration_s * std::min(1.0, kAffordableDrift_s / seconds);
}

}  // namespace

double torque_budget_seconds(const Scene& scene) { return std::min(kAffordableDrift_s, drift_scene(scene).costs()[0].seconds); }

Budget torque_budget(const Scene& scene, const Watch& watch) {
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
  budget.earth_drift_rad =
      completed ? later * watched_drift(drift.samples.back().state).angle : std::numeric_limits<double>::quiet_NaN();
  const Sizes sizes = sizes_of(followed, drift);
  for (const Effect& effect : all_effects())
    if (effect.is_in_budget(scene)) budget.effects.push_back(entry_of(effect, sizes, scene));
  budget.inputs_unavailable =
      !scene.support().has_moving_parts() ? "how well they must be known is found by runs: give /report/sensitivities true"
      : scene.support().has_gimbals
          ? "how well they must be known is not computed for a body in gimbals; run the scenario with each of them changed"
      : masses_move(scene.scenario())
          ? "how well they must be known is not computed with masses that move in the body; run the scenario with each of "
            "them changed"
          : "how well they must be known is not computed with a rotor in the body; run the scenario with each of them changed";
  if (!scene.support().no_effect_sizes.empty()) budget.warnings.emplace_back(scene.support().no_effect_sizes);
  return budget;
}

}  // namespace earthtop
