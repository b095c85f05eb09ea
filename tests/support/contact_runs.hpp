// SPDX-License-Identifier: GPL-3.0-or-later
/// Drift integrations of tops on a table without the rest of a run: a scene, and the states at some times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drift/table/contact_general_drift.hpp"
#include "drift/table/contact_reduced_drift.hpp"
#include "integrate/extrapolation.hpp"

namespace earthtop::testing {

inline constexpr std::array kAllLaws{ContactLaw::frictionless, ContactLaw::viscous,   ContactLaw::viscous_load,
                                     ContactLaw::coulomb,      ContactLaw::contensou, ContactLaw::rolling};

/// Without the angle of spin, or for any body.
enum class Form { reduced, general };

/// A top on a table at latitude 45 degrees that leans toward the East.
struct ContactScene {
  double mass_kg, center_m, I1_kg_m2, I3_kg_m2, gravity_m_s2;  ///< moments about the centre of mass
  double spin_rad_s, tilt_deg;
  ContactSpec contact;
  double earth_rate_rad_s = kEarthRateWgs84;
  RatesRelativeTo rates = RatesRelativeTo::laboratory;
  std::array<double, 2> transverse_rad_s = {0, 0};  ///< of the body's rate at release
  double latitude_deg = 45;
  double I2_kg_m2 = 0;         ///< 0: as I1
  double center_across_m = 0;  ///< of the centre of mass along body axis 1
  bool gradient = false;       ///< a radial gravity gradient, 1e6 times as strong as the Earth's
};

/// A row in SI units.
template <class T>
struct ContactRow {
  DriftState<T> state;  ///< rates in natural units
  DriftMeasures<T> measures;
  ContactDriftState<T> contact;  ///< in natural units
  Paired<T> spin_rad_s;
  T epsilon;  ///< what differences are divided by
};

template <class T>
struct ContactProblem {
  Body<T> body;
  Release<T> release;
  NaturalUnits units;
  Model<T> model;
  Contact<T> contact;
  ContactRelease<T> start;

  explicit ContactProblem(const ContactScene& scene, const std::optional<NaturalUnits>& other_units = {}) {
    BodySpec spec;
    spec.mass_kg = scene.mass_kg;
    spec.center_of_mass_m = {scene.center_across_m, 0, scene.center_m};
    spec.inertia_kg_m2 = {
        {{scene.I1_kg_m2, 0, 0}, {0, scene.I2_kg_m2 > 0 ? scene.I2_kg_m2 : scene.I1_kg_m2, 0}, {0, 0, scene.I3_kg_m2}}};
    spec.inertia_about = InertiaAbout::center_of_mass;
    ReleaseSpec released;
    released.tilt_deg = scene.tilt_deg, released.azimuth_deg = 90;
    released.rates_relative_to = scene.rates;
    released.angular_velocity_body_rad_s = {scene.transverse_rad_s[0], scene.transverse_rad_s[1], scene.spin_rad_s};
    const Site site{scene.latitude_deg, 0, 0, scene.gravity_m_s2};
    body = make_body<T>(spec);
    release = make_release<T>(released, body, T(scene.gravity_m_s2));
    const Body<double> rough = make_body<double>(spec);
    units = natural_units(rough, make_release<double>(released, rough, scene.gravity_m_s2), scene.gravity_m_s2,
                          scene.earth_rate_rad_s, nullptr);
    if (other_units) units = *other_units;
    model = make_model<T>(body, site, scene.earth_rate_rad_s, {}, nullptr, units);
    const GravityGradientSpec strong{GradientField::given, 1.5};
    contact = make_contact<T>(scene.contact, body, site, {}, scene.gradient ? &strong : nullptr, units);
    start = make_contact_release<T>(scene.contact, units);
  }
  template <Observer O, Form F = Form::reduced>
  auto system() const {
    using System = std::conditional_t<F == Form::reduced, ContactReducedDrift<T, O>, ContactGeneralDrift<T, O>>;
    return System(model, contact, start, units.release_from_rad_s(release));
  }
};

template <class T, class System>
ContactRow<T> contact_row(const ContactProblem<T>& problem, const System& system, const typename System::State& x, T t) {
  ContactRow<T> row{system.shared_state(x, t), {}, system.contact_state(x, t), {}, problem.model.epsilon};
  row.measures = measure_drift(system.deviation_state(x, t));
  const Paired<T>& spin = row.contact.spin;
  row.spin_rad_s = {problem.units.rate_to_rad_s(spin.ref), problem.units.rate_to_rad_s(spin.rot),
                    problem.units.rate_to_rad_s(spin.diff)};
  return row;
}

/// The states at ascending times, by extrapolation.   @param tolerance  per step, relative to each group's size
template <class T, class System>
std::vector<ContactRow<T>> rows_of(const ContactProblem<T>& problem, System system, const std::vector<double>& times_s,
                                   double tolerance) {
  auto x = system.initial_state();
  GroupScales<T, typename System::Shape> scales;
  scales.include(x), scales.include(system.typical_state());
  Extrapolation<T, typename System::Shape> stepper(T(tolerance), scales);
  T t = T(0), dt = T(0.05);
  std::vector<ContactRow<T>> rows;
  for (const double t_s : times_s) {
    const T end = problem.units.time_from_s(T(t_s));
    while (t < end) {
      const bool lands = t + dt >= end;
      T step = lands ? T(end - t) : dt;
      const T tried = step;
      if (stepper.try_step(system, x, t, step) == boost::numeric::odeint::success) {
        if (lands) t = end;
        scales.include(x);
        if constexpr (requires { system.follow(x, t); }) system.follow(x, t);
        dt = tried < dt ? std::max(dt, step) : step;
      } else {
        dt = step;
      }
    }
    rows.push_back(contact_row(problem, system, x, t));
  }
  return rows;
}

template <class T, Observer O, Form F = Form::reduced>
std::vector<ContactRow<T>> contact_rows(const ContactScene& scene, const std::vector<double>& times_s, double tolerance) {
  const ContactProblem<T> problem(scene);
  return rows_of(problem, problem.template system<O, F>(), times_s, tolerance);
}

}  // namespace earthtop::testing
