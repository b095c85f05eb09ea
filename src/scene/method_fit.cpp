// SPDX-License-Identifier: GPL-3.0-or-later
// Checks which method fits which scene.
#include <fmt/core.h>

#include <cmath>

#include "drift/given_impulse.hpp"
#include "earthtop/closed_form/exact_motion.hpp"
#include "earthtop/model/model.hpp"
#include "earthtop/model/reduced_torques.hpp"
#include "earthtop/model/release.hpp"
#include "earthtop/scenario/support.hpp"
#include "integrate/fourier/fourier_top.hpp"
#include "scene/support_laws.hpp"

namespace earthtop {
namespace {

std::string quoted(std::string_view word) { return fmt::format("\"{}\"", word); }

/// Refuses a scene without one of the torques of [F]. In inertial axes none of them appears, so that the one that is left out has
/// to be subtracted; where nothing else acts, the drift would be the round-off of this difference, and not zero.
std::optional<std::string> need_all_torques(std::string_view word, const Scene& scene) {
  if (scene.scenario().effects.all_on()) return std::nullopt;
  return quoted(word) + " is not available without one of the non-inertial torques; take \"auto\", or leave all three on";
}

/// Refuses a scene that is not plain. Closed forms, and the methods with exact flows between kicks, hold only for the three
/// torques of [F] and a pivot at rest.
std::optional<std::string> need_plain_scene(std::string_view word, const Scene& scene, bool also_with_rotor = false) {
  const std::string what = quoted(word) + ' ';
  if (scene.scenario().travel) return what + std::string(kNotOnJourney);
  if (const std::string_view reason = scene.support().no_exact_motion;
      !reason.empty() && !(also_with_rotor && scene.support().kind == SupportKind::rotor))
    return what + std::string(reason);
  if (auto reason = need_all_torques(word, scene)) return reason;
  if (!scene.scenario().effects.plain())
    return what + "works only with gravity and the Earth's rotation; take \"auto\", or leave the other effects out";
  return std::nullopt;
}

std::optional<std::string> need_closed_form(std::string_view word, const Scene& scene) {
  if (auto reason = need_plain_scene(word, scene, true)) return reason;
  switch (scene.closed_form_kind()) {
    case ExactKind::free_body:
    case ExactKind::symmetric_top:
    case ExactKind::free_gyrostat:
    case ExactKind::not_plain: break;
    case ExactKind::heavy_gyrostat:
      return "under the torque of gravity a body with a rotor has no closed form; take \"auto\", or put the centre of mass of "
             "both at the pivot, or gravity to 0";
    case ExactKind::braked_rotor:
      return "friction in the rotor's bearing leaves no closed form; take \"auto\", or leave the friction out";
    case ExactKind::moving_masses: return quoted(word) + " " + std::string(scene.support().no_exact_motion);
    case ExactKind::changing_rotor:
      return "a motor that changes the rotor's rate leaves no closed form; take \"auto\", or the drive \"constant\" or "
             "\"none\"";
    case ExactKind::skew_rotor:
      return "a body with a rotor has a closed form here only if the rotor turns about body axis 1, 2 or 3 and this axis has "
             "no "
             "products of inertia (in any other direction the rates need the roots of a general quartic); take \"auto\"";
    case ExactKind::not_symmetric:
      return "under gravity only a symmetric top with its centre of mass on the axis of symmetry has a closed form; take "
             "\"auto\", or make two moments equal";
    case ExactKind::turning_gravity:
      return "away from the poles the Earth turns the gravity that acts on this top, and its motion has no closed form; take "
             "\"auto\", or a rotation rate of 0, a latitude of 90 or -90, or a body without gravity torque";
  }
  return std::nullopt;
}

/// Refuses a scene whose motion cannot be split into free flow and kicks. The free motion of a symmetric top is a rotation
/// about its angular momentum, but that of any other body needs elliptic functions; and the splitting needs axes that do not
/// turn with the body.
std::optional<std::string> need_splittable_scene(std::string_view word, const Scene& scene) {
  if (auto reason = need_plain_scene(word, scene)) return reason;
  const std::string what = quoted(word) + ' ';
  if (scene.symmetry_axis() < 0)
    return what + "works only for symmetric tops with their centre of mass on the axis; take \"auto\"";
  if (scene.scenario().numerics.form == ModelForm::general)
    return what + "has no general model; leave /numerics/model at \"auto\"";
  if (scene.scenario().numerics.observer == Observer::body)
    return what + "has no body axes; take the observer \"laboratory\" or \"inertial\"";
  return std::nullopt;
}

/// Returns whether gravity's torque is small against the gyroscopic one: at most half of that at which a sleeping top falls.
bool spins_fast(const Scene& scene) {
  const Mat3<double>& inertia = scene.body<double>().I_BP_B;
  const double momentum = inertia(2, 2) * scene.release<double>().w_XB_B[2];
  return 2 * scene.gravity_torque_N_m() * inertia(0, 0) <= momentum * momentum;
}

/// Refuses a scene whose top is not symmetric about body axis 3, or that asks for other variables than those of such a top's closed form.
std::optional<std::string> need_own_variables(std::string_view word, const Scene& scene) {
  if (auto reason = need_plain_scene(word, scene)) return reason;
  const std::string what = quoted(word) + ' ';
  if (scene.symmetry_axis() != 2)
    return what +
           "works only for tops symmetric about body axis 3 (equal moments 1 and 2, no products of inertia, centre of mass "
           "on the axis); take \"auto\"";
  if (scene.scenario().numerics.observer != Observer::laboratory || scene.scenario().numerics.form != ModelForm::automatic)
    return what + "has its own variables, in laboratory axes; leave observer and model out, or take \"auto\"";
  return std::nullopt;
}

/// Refuses a scene that the long-horizon method cannot integrate. The method uses the variables of a symmetric top's closed
/// form in laboratory axes. It extrapolates a small drift from runs at amplified Earth rates, by a cubic in the rate; for a
/// slow top the drift is not cubic in the rate.
std::optional<std::string> need_fast_symmetric_top(std::string_view word, const Scene& scene) {
  if (auto reason = need_own_variables(word, scene)) return reason;
  if (!spins_fast(scene))
    return quoted(word) +
           " works only for fast tops, with (I3 w3)^2 of at least 2 m g l I1, whose nutation is fast and small; "
           "take \"auto\", or a faster spin";
  return std::nullopt;
}

/// Refuses a scene whose motion on the rotating Earth has no Fourier sum that can be found: only trying shows it.
std::optional<std::string> need_nutating_top(std::string_view word, const Scene& scene) {
  if (auto reason = need_own_variables(word, scene)) return reason;
  const std::string& refusal = scene.fourier_outlook().refusal;
  if (refusal.empty()) return std::nullopt;
  return fmt::format("{} finds no Fourier sums here: {}; take \"auto\"", quoted(word), refusal);
}

}  // namespace

/// Refuses a scene without one of the torques of [F], or whose friction has a corner on the way, where no series exists.
std::optional<std::string> PivotLaws::refuse(const MethodRow& row, const Scene& scene) const {
  if (row.fit != MethodFit::smooth) return std::nullopt;
  if (auto reason = need_all_torques(row.word, scene)) return reason;
  const double w3 = scene.release<double>().w_XB_B[2];
  const auto torques = make_applied_torques<double>(scene.scenario().effects.applied, scene.site(), w3, 0, 0);
  if (!torques.has_corner()) return std::nullopt;
  const double carrier_rate = scene.platform_demand().rate_rad_s + std::abs(scene.rotation_rate_rad_s());
  if (scene.symmetry_axis() == 2 && scene.is_reducible_when_driven() &&
      given_torque_keeps_spin(torques.given, scene.body<double>().I_BP_B(2, 2), w3, scene.scenario().duration_s) &&
      friction_stays_smooth(torques, scene.body<double>().I_BP_B(2, 2), w3, carrier_rate, scene.fastest_rate_rad_s(),
                            scene.scenario().duration_s))
    return std::nullopt;
  return quoted(row.word) +
         " has no series where dry friction, quadratic drag or a disc's drag brakes a rate to zero; it works for symmetric "
         "tops that keep most of their spin; take \"auto\"";
}

bool may_have_fourier_sums(const Scene& scene) { return !need_own_variables(to_string(Method::fourier), scene); }

FourierOutlook fourier_outlook_of(const Scene& scene) {
  const DriftProblem<double>& problem = scene.problem_without_rows<double>();
  const FourierTop<double> top(problem.model, problem.natural_release());
  FourierOutlook outlook;
  outlook.refusal = top.refusal();
  if (!outlook.refusal.empty()) return outlook;
  constexpr double kFixed_s = 3e-4, kAPoint_s = 7e-7;  // AMD EPYC, 28 November 2026; points of the grid in each pass
  const RotatingTorus<double>& torus = *top.torus();
  const double points = static_cast<double>(torus.nutation_points() * torus.precession_points());
  outlook.set_up_s = kFixed_s + kAPoint_s * points * static_cast<double>(torus.changes().size());
  outlook.longest_step_s = real::scale(top.longest_step(), problem.units.time_exponent);
  if (const std::optional<double> turning = top.turning_change()) {
    // The compass counts clockwise.
    outlook.has_azimuth_rate = true;
    outlook.azimuth_rate_rad_s = problem.units.rate_to_rad_s(-problem.model.epsilon * *turning);
    outlook.azimuth_rate_bound_rad_s = problem.units.rate_to_rad_s(problem.model.epsilon * top.turning_error());
  }
  return outlook;
}

ExactKind closed_form_of(const Scene& scene) {
  const bool may_be_exact =
      scene.is_plain() || (scene.support().kind == SupportKind::rotor && scene.scenario().effects.plain());
  return may_be_exact && !scene.scenario().travel ? exact_kind(scene.model<double>()) : ExactKind::not_plain;
}

std::optional<std::string> refuse_method(Method method, const Scene& scene) {
  const MethodRow& row = row_of(method);
  if (scene.scenario().effects.applied.coulomb_N_m != 0 && !row.finds_stops && row.fit != MethodFit::smooth) {
    std::string finders;
    for (const MethodRow& other : kMethodRows)
      if (other.finds_stops && other.method != Method::automatic)
        finders += (finders.empty() ? "" : " and ") + quoted(other.word);
    return fmt::format(
        "with dry friction a motion comes to rest within a step, which only {} find; take one of them, or \"auto\"", finders);
  }
  switch (row.fit) {
    case MethodFit::any:
    case MethodFit::smooth: return laws_of(scene).refuse(row, scene);
    case MethodFit::symmetric_top: return need_splittable_scene(row.word, scene);
    case MethodFit::fast_symmetric_top: return need_fast_symmetric_top(row.word, scene);
    case MethodFit::closed_form: return need_closed_form(row.word, scene);
    case MethodFit::nutating_top: return need_nutating_top(row.word, scene);
  }
  return std::nullopt;
}

}  // namespace earthtop
