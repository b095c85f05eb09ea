// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/run/contact_explanation.hpp"

#include <algorithm>
#include <cmath>

#include "drift/table/contact_integrals.hpp"
#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/general_contact.hpp"
#include "run/contact_report.hpp"
#include "scene/touchdown.hpp"

namespace earthtop {
namespace {

constexpr int kLooks = 200;           // at which sizes are taken
constexpr double kLongest_s = 30;     // of computing time
constexpr double kTolerance = 1e-10;  // of the integration: a few digits suffice

/// The forces on the rotating motion and their torques about the centre of mass, at one time, in natural units.
class Forces {
 public:
  enum Name : std::size_t { weight, normal, friction, coriolis, centrifugal, gradient, tide, kCount };
  struct Size {
    double force = 0, torque = 0;
  };

  explicit Forces(const DriftProblem<double>& problem)
      : problem_(problem),
        z_(rotation_matrix(problem.table->start.q_LH).col(2)),
        R_LH_(rotation_matrix(problem.table->start.q_LH)) {}

  std::array<Size, kCount> at(const DriftSample<double>& sample) const {
    const Contact<double>& c = problem_.table->contact;
    const Model<double>& model = problem_.model;
    const ContactDriftState<double>& contact = *sample.contact;
    const auto rotating = [](const Vec3<Paired<double>>& v) { return motion_of(v, &Paired<double>::rot); };
    const Mat3<double> R_LB = rotation_matrix(sample.state.q_LB.normalized());
    const Vec3<double> w = R_LB * problem_.units.rate_from_rad_s(sample.state.w_LB_B), W = model.W_IL_L;
    const Vec3<double> r_c = R_LB * c.p_OC_B, s = -(c.tip_radius * z_ + r_c);
    const Vec3<double> p_C = rotating(contact.tip_L) - s;
    const Vec3<double> v_C = rotating(contact.slip_L) - w.cross(s);
    const Vec3<double> push = contact.reaction.normal_force.rot * z_, drag = rotating(contact.reaction.friction);
    const Mat3<double> S_BC = turned_tensor(R_LB, c.S_BC_B);
    std::array<Size, kCount> sizes;
    sizes[weight] = {c.mass * norm(model.apparent_gravity_L), 0};
    sizes[normal] = {norm(push), norm(Vec3<double>(s.cross(push)))};
    sizes[friction] = {norm(drag), norm(Vec3<double>(s.cross(drag) + rotating(contact.reaction.moment)))};
    sizes[coriolis] = {2 * c.mass * norm(Vec3<double>(W.cross(v_C))), norm(coriolis_torque(W, velocity_moment(S_BC, w)))};
    sizes[centrifugal] = {c.mass * norm(Vec3<double>(W.cross(Vec3<double>(W.cross(p_C))))), norm(centrifugal_torque(W, S_BC))};
    if (c.has_gradient) {
      const Mat3<double> field = turned_tensor(R_LH_, c.gradient_H);
      sizes[gradient] = {c.mass * norm(times(field, p_C)), norm(gradient_torque(field, S_BC))};
    }
    if (!model.tide.empty())
      sizes[tide] = {c.mass * norm(model.tide.acceleration_L(problem_.units.time_from_s(sample.state.t_s))), 0};
    return sizes;
  }

 private:
  const DriftProblem<double>& problem_;
  Vec3<double> z_;
  Mat3<double> R_LH_;
};

std::vector<ContactForceSize> force_sizes(const Scene& scene, const DriftProblem<double>& problem,
                                          const std::vector<DriftSample<double>>& samples) {
  const EffectsSpec& effects = scene.scenario().effects;
  const Contact<double>& c = problem.table->contact;
  const bool rubs = c.law != ContactLaw::frictionless || has_moment(c);
  struct Listed {
    Forces::Name which;
    std::string_view name;
    bool listed, modelled;
  };
  const Listed list[] = {{Forces::weight, "weight", true, true},
                         {Forces::normal, "normal_force", true, true},
                         {Forces::friction, "friction", rubs, true},
                         {Forces::coriolis, "coriolis", true, effects.coriolis},
                         {Forces::centrifugal, "centrifugal", true, effects.centrifugal},
                         {Forces::gradient, "gravity_gradient", c.has_gradient, true},
                         {Forces::tide, "tide", !problem.model.tide.empty(), true}};
  const Forces forces(problem);
  const int newtons = problem.units.mass_exponent - 2 * problem.units.time_exponent;  // lengths are metres in both units
  std::vector<ContactForceSize> sizes;
  for (const Listed& one : list)
    if (one.listed) sizes.push_back({one.name, one.modelled});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto now = forces.at(samples[i]);
    std::size_t k = 0;
    for (const Listed& one : list) {
      if (!one.listed) continue;
      const double force = real::scale(now[one.which].force, newtons), torque = real::scale(now[one.which].torque, newtons);
      ContactForceSize& size = sizes[k++];
      if (i == 0) size.force_release_N = force, size.torque_release_N_m = torque;
      size.force_largest_N = std::max(size.force_largest_N, force);
      size.torque_largest_N_m = std::max(size.torque_largest_N_m, torque);
    }
  }
  return sizes;
}

/// The scene in double precision, with as few rows as sizes need.
Scene as_looked_at(const Scene& scene) {
  Scenario scenario = scene.scenario();
  scenario.precision = Precision::bits53;
  scenario.output_step_s = scenario.duration_s / kLooks;
  return resolve(std::move(scenario));
}

/// The distance of the two contact points (m).
double tip_drift_m(const DriftSample<double>& sample) {
  return sample.state.epsilon * norm(motion_of(sample.contact->tip_L, &Paired<double>::diff));
}

}  // namespace

ContactExplanation explain_contact(const Scene& scene, const Watch& watch) {
  const Scene looked_at = as_looked_at(scene);
  DriftProblem<double> problem = looked_at.problem_without_rows<double>();
  const Contact<double>& contact = problem.table->contact;
  IntegrationOptions options = looked_at.choice().options;
  options.relative_tolerance = std::max(options.relative_tolerance, kTolerance);
  options.observer = Observer::laboratory;
  const double duration_s = scene.scenario().duration_s, cost_s = looked_at.cost(options).seconds;
  const double followed_s = duration_s * std::min(1.0, kLongest_s / std::max(cost_s, kLongest_s));
  problem.times_s.clear();
  for (int i = 0; i <= kLooks; ++i) problem.times_s.push_back(i == kLooks ? followed_s : followed_s * i / kLooks);
  const DriftTrajectory<double> drift = integrate_drift(problem, options, watch.part(0, 0.5));

  ContactExplanation explained;
  if (drift.samples.empty()) return explained;
  const DriftSample<double>& last = drift.samples.back();
  explained.followed_s = last.state.t_s;
  explained.drift_axis_rad = last.measures.axis;
  explained.drift_tip_m = tip_drift_m(last);
  explained.forces = force_sizes(scene, problem, drift.samples);
  const bool exact = contact.law == ContactLaw::coulomb && contact.slip_floor == 0;
  if (const double rate = scene.touchdown().relaxation_rate_per_s(); rate > 0 && std::isfinite(rate))
    explained.slip_relaxation_1_s = rate;
  if (contact.law != ContactLaw::frictionless) {
    explained.largest_friction_ratio = 0;
    for (const DriftSample<double>& sample : drift.samples) {
      const ContactReaction<Paired<double>>& reaction = sample.contact->reaction;
      explained.largest_friction_ratio =
          std::max(*explained.largest_friction_ratio,
                   norm(motion_of(reaction.friction, &Paired<double>::rot)) / reaction.normal_force.rot);
    }
  }

  double before_s = HUGE_VAL;
  for (const ContactEvent& event : drift.contact_events) {
    if (ends_run(event.kind) && !explained.ended_at_s)
      explained.ended_by = type_of(event.kind).words, explained.ended_at_s = event.t_s;
    // Exact dry friction has no derivative where the slip stops.
    if (ends_run(event.kind) || (event.kind == ContactEventKind::slip_stopped && exact))
      before_s = std::min(before_s, event.t_s);
  }
  const auto at = std::find_if(drift.samples.rbegin(), drift.samples.rend(),
                               [&](const DriftSample<double>& sample) { return sample.state.t_s < before_s; });
  if (at == drift.samples.rend() || watch.asks_to_stop()) return explained;
  explained.inputs_at_s = at->state.t_s;
  const double axis_rad = at->measures.axis, tip_m = tip_drift_m(*at);
  for (const PredictionChange& change : prediction_changes(problem, explained.inputs_at_s, watch.part(0.5, 1))) {
    ContactInputNeed need{change.input, change.step, change.axis_rad, change.tip_m, std::nullopt, std::nullopt};
    // A change that is rounding of what does not change moves nothing.
    constexpr double kNothing = 1e-14;
    if (change.axis_rad > kNothing) need.hides_axis = axis_rad / change.axis_rad;
    if (change.tip_m > 0) need.hides_tip = tip_m / change.tip_m;
    explained.inputs.push_back(need);
  }
  return explained;
}

}  // namespace earthtop
