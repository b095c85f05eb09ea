// SPDX-License-Identifier: GPL-3.0-or-later
/// Tops on which more acts than gravity and the Earth's rotation, for points side by side.
#pragma once

#include <vector>

#include "earthtop/drift/drift_integration.hpp"
#include "earthtop/model/reduced_top.hpp"
#include "earthtop/scene/scene.hpp"
#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"

namespace earthtop::testing {

/// Random tops, symmetric and not, with torques, fields and platforms, whose equations are recorded.
inline std::vector<Scenario> driven_tops(std::size_t count, double radians) {
  std::vector<Scenario> scenes;
  for (std::size_t i = 0; i < count; ++i) {
    Scenario& s = scenes.emplace_back(random_scene(i, radians));
    s.numerics.method = Method::taylor;
    // A fifth of the rate is lost.
    const double lost = 0.2 * s.body.inertia_kg_m2[2][2] / s.duration_s;
    AppliedTorquesSpec& applied = s.effects.applied;
    switch (i / 2 % 8) {
      case 0: applied.viscous_N_m_s = lost; break;
      case 1: applied.quadratic_N_m_s2 = lost * s.duration_s / radians; break;
      case 2: applied.gravity_gradient = GravityGradientSpec{GradientField::given, 5}; break;
      case 3: {
        TideSpec& tide = s.effects.tide.emplace();
        tide.given = true, tide.amplitude_m_s2 = {0.3, 0.2, -0.1}, tide.frequency_hz = 0.7, tide.phase_deg = 20;
        break;
      }
      case 4:
        s.platform = PlatformSpec{PlatformMotion::harmonic, {0.2, 0.1, 1}, 0, 0, 0.3, 0.8, 30, {0.1, 0.02, 0.05}};
        applied.viscous_N_m_s = lost;  // which rubs on the platform
        break;
      case 5: s.platform = PlatformSpec{PlatformMotion::ramp, {0, 0, 1}, 0.05, 0.75, 0, 0, 0, {0.3, 0.1, 0}}; break;
      case 6: applied.air_drag.emplace().disc_radius_m = 0.02; break;
      default:  // a wheel in a gimbal, and an asymmetric one
        s = gyrocompass(s.site.latitude_deg, 10 + static_cast<double>(i), 1e-5);
        s.numerics.method = Method::taylor;
        if (i % 2 == 0) set_principal(s.body, 5e-4, 6e-4, 1e-3);
        s.duration_s = 5 * radians / s.release.spin_rad_s, s.output_step_s = s.duration_s / 100;
    }
    // A drag that brakes a rate to zero has no series.
    if (!applied.gimbal && Scene(s).method_refusal()) applied = {.viscous_N_m_s = lost};
  }
  return scenes;
}

/// The drifts of driven tops, and the options of their integration: of the symmetric ones without the spin, of wheels in a gimbal, or of
/// the others.
struct DrivenDrifts {
  std::vector<DriftProblem<double>> problems;
  IntegrationOptions options;
};
inline std::vector<DrivenDrifts> driven_drifts(std::size_t count, double tolerance) {
  const auto options = [&](ModelForm form, Observer observer) {
    IntegrationOptions made;
    made.method = Method::taylor, made.form = form, made.observer = observer, made.relative_tolerance = tolerance;
    return made;
  };
  std::vector<DrivenDrifts> all{
      {{}, options(ModelForm::reduced, Observer::laboratory)}, {{}, options(ModelForm::reduced, Observer::inertial)},
      {{}, options(ModelForm::reduced, Observer::laboratory)}, {{}, options(ModelForm::reduced, Observer::inertial)},
      {{}, options(ModelForm::general, Observer::body)},       {{}, options(ModelForm::general, Observer::inertial)}};
  for (const Scenario& scenario : driven_tops(count, 40)) {
    const Scene scene(scenario);
    const std::size_t first = is_compass(scene.problem<double>().model) ? 2 : scene.is_reducible_when_driven() ? 0 : 4;
    for (const std::size_t of : {first, first + 1}) all[of].problems.push_back(scene.problem<double>());
  }
  return all;
}

}  // namespace earthtop::testing
