// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a body in which a rotor turns or masses move, and its unit of time.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "earthtop/scenario/support.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {

void RotorLaws::check(const input::Section& root, const Scene& scene) const {
  PivotLaws::check(root, scene);
  const Scenario& scenario = scene.scenario();
  const EffectsSpec& effects = scenario.effects;
  const input::Section given = root.section("effects");
  const auto refuse = [&](const char* key, bool is_given, const char* why) {
    if (is_given)
      given.refuse_key(key,
                       fmt::format("is not available with {}: {}; leave one of the two out", scene.support().pointer, why));
  };
  const bool is_told = scene.support().kind == SupportKind::masses;  // where they were read
  refuse("air_drag", !is_told && effects.applied.air_drag.has_value(),
         "it is the drag of a disc that spins about body axis 3 itself");
  refuse("gimbal", !is_told && effects.applied.gimbal.has_value(), "it holds a rigid wheel");
  refuse("coulomb_torque_N_m", effects.applied.coulomb_N_m != 0, "dry friction at the pivot of a gyrostat is not modelled");
  const char* const kWhole = scene.support().kind == SupportKind::masses
                                 ? "the torques of what moves in the body belong to all three"
                                 : "the torques of a rotor's own motion belong to all three";
  refuse("coriolis", !effects.coriolis, kWhole);
  refuse("centrifugal", !effects.centrifugal, kWhole);
  refuse("transverse", !effects.transverse, kWhole);
}

void RotorLaws::fit_units(const Scene& scene, NaturalUnits& units) const {
  int exponent = 0;
  std::frexp(scene.fastest_rate_rad_s(), &exponent);
  units.time_exponent = std::min(units.time_exponent, -exponent);
}

void RotorLaws::add_figures(TopFigures& top, const Scene&, double) const {
  top.left_out.emplace_back("precession, nutation and critical spin: a rotor turns in the body");
}

void MassLaws::add_figures(TopFigures& top, const Scene&, double) const {
  top.left_out.emplace_back("precession, nutation and critical spin: masses move in the body");
  top.notes.emplace_back("mass, centre of mass and moments are those at release, with the moving masses where they are then");
}

/// The equations of all three observers have series.
MethodChoice RotorLaws::choose_method(const Scene& scene) const {
  IntegrationOptions options = scene.scenario().numerics;
  if (options.method == Method::taylor) return {options, "asked for"};
  if (options.method != Method::automatic || scene.scenario().precision != Precision::bits53)
    return PivotLaws::choose_method(scene);
  if (options.observer == Observer::laboratory && options.form != ModelForm::general && has_cheap_closed_form(scene)) {
    options.method = Method::closed_form;
    return {options, "the motion is known in closed form"};
  }
  options.method = Method::taylor;
  if (options.form == ModelForm::general || options.observer != Observer::laboratory)
    return {options, "Taylor series of the equations of the observer asked for"};
  options.observer = Observer::body;
  options.form = ModelForm::general;
  return {options, "Taylor series of the equations in body axes take the fewest operations"};
}

/// The equations of a gyrostat are built for the methods of any precision only.
std::optional<std::string> RotorLaws::refuse(const MethodRow& row, const Scene& scene) const {
  const Method method = row.method;
  if (method == Method::automatic || method == Method::taylor || method == Method::extrapolation || method == Method::rkf78)
    return std::nullopt;
  if (scene.support().kind == SupportKind::masses)
    return fmt::format(
        "\"{}\" is not built for masses that move in the body; take \"auto\", \"taylor\", \"extrapolation\" or \"rkf78\"",
        row.word);
  return fmt::format("\"{}\" is not built for a body with a rotor; take \"auto\", \"taylor\", \"extrapolation\" or \"rkf78\"",
                     row.word);
}

}  // namespace earthtop
