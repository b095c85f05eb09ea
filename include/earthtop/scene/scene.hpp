// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scenario resolves to: body, release, model, method and cost, each computed once.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/closed_form/exact_kind.hpp"
#include "earthtop/integrate/pace.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

template <class T>
struct Body;
template <class T>
struct Release;
template <class T>
struct Model;
template <class T>
struct DriftProblem;
struct NaturalUnits;

/// The method a run takes, and why.
struct MethodChoice {
  IntegrationOptions options;  ///< with a method, and the observer whose axes it takes
  std::string reason;
};

/// How fast a platform turns, and how it accelerates the pivot, at most; 0 without a platform.
struct PlatformDemand {
  double rate_rad_s = 0;
  double acceleration_m_s2 = 0;
};

/// The friction that damps a motion most.
struct StiffFriction {
  std::string_view pointer = {};  ///< JSON pointer of the key that gives it; empty without friction
  double damping = 0;             ///< integral of its damping rate over the duration (1)
};

/// What one integration costs: its work, and its time on one core.
struct IntegrationCost {
  Work work;
  double seconds = 0;
};

/// What the phases of a run cost on one core (s), within a factor of a few; a phase that the run does not have costs nothing.
struct RunSeconds {
  double solution = 0, bound = 0, rows = 0, growth = 0, sensitivities = 0, ledger = 0;
  double all() const { return solution + bound + rows + growth + sensitivities + ledger; }
};

/// What a run will take, within a factor of a few. The choice of effects, where a scenario leaves that open, comes on top.
struct RunEstimate {
  Work solution;
  Work certificate;  ///< the second integration, from which the bounds come
  Work growth;       ///< the growth of disturbances along both motions
  RunSeconds seconds;
};

/// A resolved scenario. A scene never changes, and its copies share what they compute: each of its parts is made when it is
/// first asked for, and once, also where several threads ask. A part that needs a release throws ScenarioError where the
/// release does not exist (a steady precession without a real rate); everything else is defined for every validated scenario.
///
/// A Scenario converts to its scene wherever a scene is wanted. Who needs a scene twice should keep it.
class Scene {
 public:
  Scene();
  Scene(Scenario scenario);  // NOLINT(google-explicit-constructor): see above

  /// The scenario as it was given.
  const Scenario& scenario() const;
  /// The site with its gravity, its pole and its deflection of the vertical, all effects on them included.
  const Site& site() const;
  /// The Earth's rate (rad/s), all effects on it included.
  double rotation_rate_rad_s() const;
  /// `identity_json` of the scenario, and its SHA-256 as 64 hexadecimal digits: equal for scenarios that compute the same thing.
  const std::string& identity() const;
  const std::string& sha256() const;

  /// Whether the scene is a top under gravity on a pivot at rest in the laboratory, with all three of [F]'s torques: what
  /// closed forms, series, exact flows and the reduced form are made for.
  bool is_plain() const;
  /// The body axis about which the body is symmetric, its centre of mass on it: 0, 1 or 2; -1 without one.
  int symmetry_axis() const;
  /// Whether the scene may be integrated without its spin: it is plain and its body symmetric.
  bool is_reducible() const { return is_plain() && symmetry_axis() >= 0; }
  /// Whether both predictions are one motion, but for a turn of the laboratory.
  bool is_one_motion() const;

  /// The same scene on an Earth that does not turn, with the same attitude and the same rates of the kind that the release
  /// names.
  Scene without_rotation() const;

  /// Body, release and model (SI units); for T double, long double and float128. The given doubles are exact; everything
  /// derived from them is computed in T. @throws ScenarioError (release, and a model with an air drag, which needs the spin)
  template <class T>
  const Body<T>& body() const;
  template <class T>
  const Release<T>& release() const;
  template <class T>
  const Model<T>& model() const;
  /// The units in which rates and moments of the scene are near 1.
  const NaturalUnits& units() const;
  /// What the integrations take, in natural units.
  template <class T>
  const DriftProblem<T>& problem() const;

  /// m g l, the largest torque of gravity about the pivot (N m), l the distance of the centre of mass from it.
  /// @param pivot_acceleration_m_s2  adds to gravity
  double gravity_torque_N_m(double pivot_acceleration_m_s2 = 0) const;
  /// The same for a top whose centre of mass lies on body axis 3; negative where it lies below the pivot at tilt 0.
  double axial_gravity_torque_N_m() const;
  const PlatformDemand& platform_demand() const;
  /// Angular frequencies of the motion (rad/s): a rough upper bound on free nutation, pendulum, spin, Earth and platform.
  double fastest_rate_rad_s() const;
  const Pace& pace() const;
  const StiffFriction& stiffest_friction() const;
  double rows() const { return scenario().duration_s / scenario().output_step_s; }
  /// The closed form that the motion has, or why it has none.
  ExactKind closed_form_kind() const;

  /// Why a method does not fit the scene, and what to do; nothing where it does. A method that is made for some scenes only (a
  /// closed form, an exact flow) says so here, and nowhere else.
  const std::optional<std::string>& method_refusal(Method method) const;
  /// The same for the method that the scenario names.
  const std::optional<std::string>& method_refusal() const { return method_refusal(scenario().numerics.method); }
  /// `auto` resolved by body, effects, observer and precision to the method of least work at the error asked for; any other
  /// method as it was asked for.
  const MethodChoice& choice() const;
  /// The form of the equations that an integration with these options takes.
  ModelForm form(const IntegrationOptions& options) const;

  /// What one integration costs, within a factor of a few. @param options  with a method, as `choice` gives
  IntegrationCost cost(const IntegrationOptions& options) const;
  /// The same for the two integrations of a run: the solution with the chosen method, and the one that its bounds come from.
  const std::array<IntegrationCost, 2>& costs() const;
  /// The whole run with the chosen method.
  const RunEstimate& estimate() const;
  /// @throws ScenarioError, with the estimate, for a scene that would take days: more steps than `numerics.step_limit`, or in
  /// extended precision more than a day.
  void require_affordable() const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// The scene of a scenario.
inline Scene resolve(Scenario scenario) { return {std::move(scenario)}; }

/// "about 20 s", "less than 0.1 s"
std::string about_seconds(double seconds);

/// `--set` pairs: JSON pointer and JSON value (a value that is not JSON is taken as a string).
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// What was found in a scenario's text, sorted by position; at most 20 errors, then one that says how many more. Those of
/// an override stand first, at line 0.
struct ScenarioReport {
  std::optional<Scenario> scenario;  ///< nothing where there are errors
  std::size_t error_count = 0;       ///< all of them, also those beyond the twentieth
  std::vector<Diagnostic> errors = {};
  std::vector<Diagnostic> warnings = {};  ///< allowed, but looks like a mistake: degrees for radians, grams for kilograms ...
  std::optional<Scene> scene = {};        ///< that of `scenario`
};

/// Decodes and validates a scenario, with what its scene has to say: that there is a start, that the method fits, that the run
/// is affordable.
ScenarioReport examine_scenario(const ScenarioSource& source, const Overrides& overrides = {});

/// The same for those who want a scenario, or its scene, or nothing. @throws ScenarioError with all errors
Scenario parse_scenario(const ScenarioSource& source, const Overrides& overrides = {});
Scene parse_scene(const ScenarioSource& source, const Overrides& overrides = {});

}  // namespace earthtop
