// SPDX-License-Identifier: GPL-3.0-or-later
// Which method fits which scene.
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/scenario.hpp"
#include "scenario/closed_form_fit.hpp"

namespace earthtop {
namespace {

/// The methods that know the motion between the torques' kicks, or its series, know it for [F]'s three torques and a pivot at
/// rest.
std::optional<std::string> need_plain_scene(Method method, const Scenario& scenario) {
  std::string what = "\"";
  what += to_string(method);
  what += "\" ";
  if (scenario.platform) return what + "is not made for a platform; take \"auto\", or leave the platform out";
  if (!scenario.effects.all_on())
    return what + "is not made for scenes without one of the non-inertial torques; take \"auto\", or leave all three on";
  if (!is_plain(scenario))
    return what + "is made for gravity and the Earth's rotation only; take \"auto\", or leave the other effects out";
  return std::nullopt;
}

std::optional<std::string> need_closed_form(const Scenario& scenario) {
  if (auto reason = need_plain_scene(Method::closed_form, scenario)) return reason;
  switch (closed_form_kind(scenario)) {
    case ExactKind::free_body:
    case ExactKind::symmetric_top:
    case ExactKind::not_plain: break;
    case ExactKind::not_symmetric:
      return "under gravity only a symmetric top with its centre of mass on the axis of symmetry has a closed form; take "
             "\"auto\", or make two moments equal";
    case ExactKind::turning_gravity:
      return "away from the poles the Earth turns the gravity that acts on this top, and its motion has no closed form; take "
             "\"auto\", or a rotation rate of 0, a latitude of 90 or -90, or a body without gravity torque";
  }
  return std::nullopt;
}

/// The free motion of a symmetric top is a turn about its angular momentum, that of any other body takes elliptic functions;
/// and it is split in axes that do not turn with the body.
std::optional<std::string> need_splittable_scene(const Scenario& scenario) {
  if (auto reason = need_plain_scene(Method::splitting, scenario)) return reason;
  if (symmetry_axis(make_body<double>(scenario.body)) < 0)
    return "\"splitting\" is made for symmetric tops, with their centre of mass on the axis; take \"auto\"";
  if (scenario.numerics.form == ModelForm::general)
    return "\"splitting\" has no general model; leave /numerics/model at \"auto\"";
  if (scenario.numerics.observer == Observer::body)
    return "\"splitting\" has no body axes; take the observer \"laboratory\" or \"inertial\"";
  return std::nullopt;
}

/// Whether gravity's torque is small against the gyroscopic one: half of where a sleeping top falls.
bool spins_fast(const Scenario& scenario) {
  const auto body = make_body<double>(scenario.body);
  const auto release = make_release<double>(scenario.release, body, scenario.site.gravity_m_s2);
  const double momentum = body.I_BP_B(2, 2) * release.w_XB_B[2];
  const double torque = body.mass * scenario.site.gravity_m_s2 * norm(body.p_PBcm_B);
  return 2 * torque * body.I_BP_B(0, 0) <= momentum * momentum;
}

/// A symmetric top's closed form, in laboratory axes. Of a slow top the drift at amplified rates, from which a small one is
/// found, is no cubic in the rate.
std::optional<std::string> need_fast_symmetric_top(const Scenario& scenario) {
  if (auto reason = need_plain_scene(Method::long_horizon, scenario)) return reason;
  if (symmetry_axis(make_body<double>(scenario.body)) != 2)
    return "\"long_horizon\" is made for tops symmetric about body axis 3 (equal moments 1 and 2, no products of inertia, "
           "centre of mass on the axis); take \"auto\"";
  if (scenario.numerics.observer != Observer::laboratory || scenario.numerics.form != ModelForm::automatic)
    return "\"long_horizon\" has its own variables, in laboratory axes; leave observer and model out, or take \"auto\"";
  if (!spins_fast(scenario))
    return "\"long_horizon\" is made for fast tops, with (I3 w3)^2 of at least 2 m g l I1, whose nutation is fast and small; "
           "take "
           "\"auto\", or a faster spin";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> method_refusal(Method method, const Scenario& scenario) {
  if (scenario.effects.applied.coulomb_N_m != 0 && method != Method::automatic && method != Method::rkf78 &&
      method != Method::extrapolation)
    return "with dry friction a motion comes to rest within a step, which only \"rkf78\" and \"extrapolation\" find; take one "
           "of "
           "them, or \"auto\"";
  switch (method) {
    case Method::automatic:
    case Method::dopri5:
    case Method::rkf78:
    case Method::bulirsch_stoer:
    case Method::extrapolation:
    case Method::abm8:
    case Method::dop853:
    case Method::gauss: break;
    case Method::splitting: return need_splittable_scene(scenario);
    case Method::taylor: return need_plain_scene(method, scenario);
    case Method::long_horizon: return need_fast_symmetric_top(scenario);
    case Method::closed_form: return need_closed_form(scenario);
  }
  return std::nullopt;
}

}  // namespace earthtop
