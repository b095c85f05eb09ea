// SPDX-License-Identifier: GPL-3.0-or-later
// By which methods a top on a table is integrated, and at what cost. Its equations exist in laboratory and in inertial axes, without the
// spin if it is symmetric.
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

/// Names the motion that dies out too fast and what to take instead, by the key of the friction.
std::pair<std::string_view, std::string_view> stiff_motion(std::string_view pointer) {
  if (pointer == "/contact/regularisation_m_s") return {"slip", "a larger regularisation or a shorter duration"};
  if (pointer == "/contact/patch_radius_m") return {"slip", "a larger patch or a shorter duration"};
  if (pointer.starts_with("/contact/sliding_viscosity"))
    return {"slip", "a smaller coefficient, a shorter duration, or \"rolling\", its limit"};
  return {"turn", "a larger regularisation_rad_s or a shorter duration"};
}

}  // namespace

ModelForm TableLaws::form(const Scene& scene, const IntegrationOptions& options) const {
  return scene.symmetry_axis() == 2 && options.form != ModelForm::general ? ModelForm::reduced : ModelForm::general;
}

/// Its series exist without one of [F]'s torques, too: its equations weigh force and torque in every formulation.
std::optional<std::string> TableLaws::refuse(const MethodRow& row, const Scene& scene) const {
  const bool runge_kutta = scene.scenario().precision == Precision::bits53;
  const Method method = row.method;
  if (method == Method::automatic || method == Method::taylor || method == Method::extrapolation ||
      (method == Method::rkf78 && runge_kutta))
    return std::nullopt;
  return fmt::format("\"{}\" is not built for a top on a table{}; take \"auto\", \"taylor\"{} \"extrapolation\"{}", row.word,
                     method == Method::rkf78 ? " in extended precision" : "", runge_kutta ? "," : " or",
                     runge_kutta ? " or \"rkf78\"" : "");
}

MethodChoice TableLaws::choose_method(const Scene& scene) const {
  IntegrationOptions options = scene.scenario().numerics;
  options.form = scene.form(options);
  if (options.method != Method::automatic) return {options, "asked for"};
  options.method = Method::taylor;
  // The last term of a step is far below the tolerance, and at a tenfold one all that is left is rounding.
  constexpr double kLooser = 10, kLoosest = 1e-6;
  options.relative_tolerance = std::max(options.relative_tolerance, std::min(kLooser * options.relative_tolerance, kLoosest));
  return {options, options.form == ModelForm::reduced
                       ? "a symmetric top on a table, integrated without its spin: Taylor series take the fewest operations"
                       : "a body on a table: Taylor series take the fewest operations"};
}

IntegrationOptions TableLaws::second_options(const Scene& scene, const IntegrationOptions& first,
                                             IntegrationOptions second) const {
  // In inertial axes no Coriolis term appears: of all checks on a table this is the least like the laboratory's equations.
  second.observer = first.observer == Observer::inertial ? Observer::laboratory : Observer::inertial;
  second.method = Method::taylor;
  // The second of two series in unlike equations may as well be that of the larger error: the distance is then this error.
  constexpr double kLooser = 10, kFiner = 1e-2, kLoose = 5e-10;
  second.relative_tolerance = first.method == Method::taylor && first.relative_tolerance <= kLoose
                                  ? kLooser * first.relative_tolerance
                                  : std::max(kFiner * first.relative_tolerance, least_tolerance(scene.scenario().precision));
  return second;
}

double TableLaws::evaluation_seconds(const Scene& scene, const IntegrationOptions& options) const {
  const bool reduced = scene.form(options) == ModelForm::reduced;
  const double without_spin = options.method == Method::taylor ? 1.2e-6 : 5e-7, in_laboratory = reduced ? without_spin : 2e-6;
  return options.observer == Observer::inertial ? 1.5 * in_laboratory : in_laboratory;
}

std::string TableLaws::too_stiff(const Scene& scene, const std::string& work) const {
  const StiffFriction& stiffest = scene.stiffest_friction();
  const auto [what, instead] = stiff_motion(stiffest.pointer);
  return fmt::format(
      "this friction is too stiff: a {} dies out at about {:.1e} 1/s, and every step of an explicit method has "
      "to follow it: {}; at most an hour is allowed; take {}",
      what, stiffest.damping / scene.scenario().duration_s, work, instead);
}

}  // namespace earthtop
