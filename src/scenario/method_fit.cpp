// Which method fits which scene.
#include "earthtop/scenario/scenario.hpp"

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
  return std::nullopt;
}

}  // namespace

std::optional<std::string> method_refusal(Method method, const Scenario& scenario) {
  switch (method) {
    case Method::automatic:
    case Method::dopri5:
    case Method::rkf78:
    case Method::bulirsch_stoer:
    case Method::extrapolation:
    case Method::abm8:
    case Method::dop853:
    case Method::gauss: break;
    case Method::taylor:
    case Method::splitting:
    case Method::long_horizon:
    case Method::closed_form: return need_plain_scene(method, scenario);
  }
  return std::nullopt;
}

}  // namespace earthtop
