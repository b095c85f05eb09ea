// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/table_strata.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace earthtop::testing {
namespace {

bool happens(Random& random, double probability) { return random.uniform(0, 1) < probability; }

/// A place, a matching rule and a direction of the lean; gravity gradient and tide sometimes.
Scenario table_site(Random& random) {
  Scenario s;
  s.site = random_site(random);
  if (happens(random, 0.1)) s.rotation_rate_rad_s = random.sign() * random.log_uniform(1e-9, 1e-2);
  s.release.azimuth_deg = random.uniform(-180, 180);
  s.release.spin_angle_deg = random.uniform(-180, 180);
  s.release.rates_relative_to = random.coin() ? RatesRelativeTo::laboratory : RatesRelativeTo::inertial;
  constexpr std::array kFields{GradientField::radial, GradientField::normal, GradientField::given};
  if (happens(random, 0.25))
    s.effects.applied.gravity_gradient = GravityGradientSpec{kFields[static_cast<std::size_t>(random.uniform(0, 3))], 1.5e-6};
  if (s.effects.applied.gravity_gradient && s.effects.applied.gravity_gradient->field != GradientField::given)
    s.effects.applied.gravity_gradient->gm_over_r3_s2 = 0;
  if (happens(random, 0.15)) {
    s.effects.tide.emplace();
    s.effects.tide->given = true;
    s.effects.tide->amplitude_m_s2 = {random.uniform(-1e-5, 1e-5), random.uniform(-1e-5, 1e-5), 1e-6};
    s.effects.tide->frequency_hz = random.log_uniform(0.01, 10), s.effects.tide->phase_deg = 30;
  }
  return s;
}

/// The part of a contact that every law needs.
ContactSpec table(Random& random, double tip_radius_m) {
  ContactSpec contact{.tip_radius_m = tip_radius_m};
  constexpr std::array kStarts{ContactStart::tip_at_rest, ContactStart::rolling, ContactStart::center_of_mass_at_rest,
                               ContactStart::tip_velocity};
  contact.start = kStarts[static_cast<std::size_t>(random.uniform(0, 4))];
  if (contact.start == ContactStart::tip_velocity)
    contact.tip_velocity_m_s = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)};
  if (happens(random, 0.2)) {
    contact.table_tilt_deg = random.log_uniform(1e-3, 3);
    contact.table_tilt_azimuth_deg = random.uniform(-180, 180);
  }
  if (happens(random, 0.2)) contact.spinning_friction_m = random.log_uniform(1e-6, 1e-3);
  if (happens(random, 0.2)) contact.rolling_resistance_m = random.log_uniform(1e-7, 1e-4);
  if (contact.spinning_friction_m + contact.rolling_resistance_m > 0) contact.regularisation_rad_s = random.log_uniform(1, 10);
  return contact;
}

void set_body(Scenario& s, double mass, double height_of_center, const std::array<double, 3>& moments) {
  s.body.mass_kg = mass;
  s.body.center_of_mass_m = {0, 0, height_of_center};
  set_principal(s.body, moments[0], moments[1], moments[2]);
  s.body.inertia_about = InertiaAbout::center_of_mass;
}

/// A top that stands, from a little above its critical spin to far above it.
Scenario toy(Random& random, bool symmetric) {
  Scenario s = table_site(random);
  const double mass = random.log_uniform(0.01, 1), l = random.log_uniform(0.01, 0.06);
  const double I1 = mass * l * l * random.log_uniform(0.15, 1.5), I3 = I1 * random.uniform(0.4, 1.7);
  set_body(s, mass, l, {I1, I1, I3});
  if (!symmetric) {
    const double I2 = I1 * random.uniform(0.85, 1.15);
    set_body(s, mass, l, {I1, I2, std::min(I3, 0.95 * (I1 + I2))});
    if (random.coin()) s.body.center_of_mass_m[0] = 0.03 * l;
  }
  const double r = happens(random, 0.25) ? 0 : l * random.log_uniform(0.02, 0.6);
  s.contact = table(random, r);
  const double critical = 2 * std::sqrt((I1 + mass * l * l) * mass * 9.8 * (l + r)) / I3;
  s.release.tilt_deg = happens(random, 0.15) ? 0.1 * random.uniform(0, 1) : random.uniform(2, 40);
  s.release.spin_rad_s = random.sign() * critical * random.log_uniform(symmetric ? 1.1 : 1.5, 5);
  return s;
}

/// A tippe top, mostly one that turns over.
Scenario tippe(Random& random, bool symmetric) {
  Scenario s = table_site(random);
  const double mass = random.log_uniform(0.005, 0.05), R = random.log_uniform(0.01, 0.03), alpha = random.uniform(0.1, 0.35);
  const double I1 = random.uniform(0.3, 0.45) * mass * R * R, I3 = I1 * random.uniform(1 - 0.5 * alpha, 1 + 0.5 * alpha);
  set_body(s, mass, -alpha * R, {I1, symmetric ? I1 : 1.05 * I1, I3});
  s.contact = table(random, R);
  // Rauch-Wojciechowski and Rutstam's threshold of Jellett's integral, for a top that spins about its axis.
  const double threshold =
      std::sqrt(mass * 9.8 * R * R * R * I3 * alpha) * (1 + alpha) * (1 + alpha) / std::sqrt(1 + alpha - I1 / I3);
  s.release.tilt_deg = random.uniform(2, 15);
  s.release.spin_rad_s = random.sign() * threshold / (I3 * R * (1 - alpha)) * random.uniform(0.9, 3);
  return s;
}

/// A ball with its centre of mass in its centre, which rolls or slides.
Scenario ball(Random& random) {
  Scenario s = table_site(random);
  const double mass = random.log_uniform(0.01, 1), R = random.log_uniform(0.005, 0.05);
  const double I = random.uniform(0.35, 0.6) * mass * R * R;
  set_body(s, mass, 0, {I, I, I * random.uniform(0.8, 1.2)});
  s.contact = table(random, R);
  s.release.tilt_deg = random.uniform(0, 30);
  s.release.spin_rad_s = random.sign() * random.log_uniform(20, 300);
  return s;
}

Scenario on_table(Random& random, ContactLaw law, bool symmetric_only = false) {
  const double which = random.uniform(0, 1);
  const bool symmetric = symmetric_only || !happens(random, 0.3);
  Scenario s = which < 0.65 ? toy(random, symmetric) : which < 0.93 ? tippe(random, symmetric) : ball(random);
  s.contact->law = law;
  return s;
}

Scenario frictionless(Random& random) { return on_table(random, ContactLaw::frictionless); }
Scenario viscous(Random& random) {
  Scenario s = on_table(random, ContactLaw::viscous);
  s.contact->sliding_viscosity_N_s_m = s.body.mass_kg * random.log_uniform(0.03, 30);
  return s;
}
Scenario viscous_load(Random& random) {
  Scenario s = on_table(random, ContactLaw::viscous_load);
  s.contact->sliding_viscosity_s_m = random.log_uniform(0.01, 3);
  return s;
}
Scenario smooth_coulomb(Random& random) {
  Scenario s = on_table(random, ContactLaw::coulomb);
  s.contact->friction_coefficient = random.log_uniform(0.03, 0.5),
  s.contact->regularisation_m_s = random.log_uniform(1e-3, 5e-2);
  return s;
}
Scenario exact_coulomb(Random& random) {
  Scenario s = on_table(random, ContactLaw::coulomb, true);
  s.contact->friction_coefficient = random.log_uniform(0.03, 0.5);
  return s;
}
Scenario contensou(Random& random) {
  Scenario s = on_table(random, ContactLaw::contensou);
  s.contact->friction_coefficient = random.log_uniform(0.03, 0.5), s.contact->patch_radius_m = random.log_uniform(1e-5, 5e-4);
  return s;
}
Scenario rolling(Random& random) {
  Scenario s = on_table(random, ContactLaw::rolling);
  s.contact->start = ContactStart::rolling, s.contact->tip_velocity_m_s = {0, 0};
  return s;
}

/// Any law but that with corners, in air that takes some of the spin and of the walk.
Scenario in_air(Random& random) {
  constexpr Scenario (*kLaws[])(Random&) = {frictionless, viscous, viscous_load, smooth_coulomb, contensou, rolling};
  Scenario s = kLaws[static_cast<std::size_t>(random.uniform(0, std::size(kLaws)))](random);
  AppliedTorquesSpec& applied = s.effects.applied;
  const double moment = s.body.inertia_kg_m2[2][2], mass = s.body.mass_kg;
  if (random.coin())
    applied.viscous_N_m_s = moment * random.log_uniform(1e-4, 1);
  else
    applied.viscous_by_axis_N_m_s = {moment * random.log_uniform(1e-4, 1), moment * random.log_uniform(1e-4, 1),
                                     moment * random.log_uniform(1e-4, 1)};
  if (applied.viscous_by_axis_N_m_s && random.coin()) (*applied.viscous_by_axis_N_m_s)[1] = (*applied.viscous_by_axis_N_m_s)[0];
  if (random.coin()) applied.quadratic_N_m_s2 = moment * random.log_uniform(1e-6, 1e-2);
  if (random.coin()) applied.air_drag = AirDragSpec{random.uniform(0.01, 0.06)};
  applied.air_force = AirForceSpec{mass * random.log_uniform(1e-3, 1), random.coin() ? mass * random.log_uniform(1e-3, 1) : 0};
  return s;
}

constexpr Stratum kTableStrata[] = {
    {"frictionless", frictionless, true},
    {"viscous", viscous, true},
    {"viscous_load", viscous_load, true},
    {"coulomb, regularised", smooth_coulomb, true},
    {"coulomb, exact", exact_coulomb, true},
    {"contensou", contensou, true},
    {"rolling", rolling, true},
    {"in air", in_air, true},
};

/// Whether a scenario is one that a run takes.
bool is_valid(const Scenario& s) { return !examine_scenario({"random", canonical_json(s), false}).error_count; }

}  // namespace

std::span<const Stratum> table_strata() { return kTableStrata; }

Scenario random_scene_on_table(const Stratum& stratum, std::uint64_t index, double longest_s, double largest_phase) {
  const auto number = static_cast<std::uint64_t>(&stratum - kTableStrata);
  for (std::uint64_t attempt = 0; attempt < 100; ++attempt) {
    Random random((number + 1) * 1'000'003 + index * 1009 + attempt * 7'777'777);
    Scenario s = stratum.make(random);
    s.name = "on-table-" + std::to_string(number) + "-" + std::to_string(index);
    s.duration_s = 1;
    const double seconds = random.log_uniform(0.3, longest_s);
    const double shortest = random.uniform(0.3, 1);
    s.output_step_s = s.duration_s / 12;
    if (!is_valid(s)) continue;
    const Pace pace = Scene(s).pace();
    const bool exact = s.contact->law == ContactLaw::coulomb && s.contact->regularisation_m_s == 0;
    const double rate = std::max({pace.reduced_turning_rad, exact ? 1.0 : pace.reduced_damping, 1.0}) / s.duration_s;
    s.duration_s = std::min(seconds, shortest * largest_phase / rate);
    s.output_step_s = s.duration_s / 12;
    if (is_valid(s)) return s;
  }
  throw std::logic_error("no valid scene");
}

}  // namespace earthtop::testing
