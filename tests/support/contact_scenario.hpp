// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenarios of tops on a table.
#pragma once

#include "support/contact_runs.hpp"
#include "support/scenes.hpp"

namespace earthtop::testing {

/// The scenario of a scene of the reference cases.
inline Scenario scenario_of(const ContactScene& scene) {
  Scenario s;
  s.name = "on-a-table";
  s.site = {scene.latitude_deg, 0, 0, scene.gravity_m_s2};
  s.body.mass_kg = scene.mass_kg;
  s.body.center_of_mass_m = {scene.center_across_m, 0, scene.center_m};
  set_principal(s.body, scene.I1_kg_m2, scene.I2_kg_m2 > 0 ? scene.I2_kg_m2 : scene.I1_kg_m2, scene.I3_kg_m2);
  s.body.inertia_about = InertiaAbout::center_of_mass;
  s.release.tilt_deg = scene.tilt_deg, s.release.azimuth_deg = 90;
  s.release.rates_relative_to = scene.rates;
  s.release.angular_velocity_body_rad_s = {scene.transverse_rad_s[0], scene.transverse_rad_s[1], scene.spin_rad_s};
  s.rotation_rate_rad_s = scene.earth_rate_rad_s;
  s.contact = scene.contact;
  return s;
}

}  // namespace earthtop::testing
