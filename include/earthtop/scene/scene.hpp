// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene is a resolved scenario: its body, release, model, method and cost, each computed once.
#pragma once

#include <array>
#include <limits>
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
template <class T>
struct TableProblem;
struct NaturalUnits;
struct Support;
struct TopFigures;
class Touchdown;

/// The method that a run uses, and the reason.
struct MethodChoice {
  IntegrationOptions options;  ///< the method is never `automatic`; the observer sets the axes
  std::string reason;
};

/// The largest rate of a platform and the largest acceleration that it gives the pivot; 0 without a platform.
struct PlatformDemand {
  double rate_rad_s = 0;
  double acceleration_m_s2 = 0;
};

/// The friction that damps a motion most.
struct StiffFriction {
  std::string_view pointer = {};  ///< JSON pointer of the friction's key; empty without friction
  double damping = 0;             ///< integral of its damping rate over the duration (1)
};

/// The cost of one integration: its work, and its time on one core.
struct IntegrationCost {
  Work work;
  double seconds = 0;
};

/// Estimated times of the phases of a run on one core (s), within a factor of a few; 0 for a phase that the run does not have.
struct RunSeconds {
  double solution = 0, bound = 0, rows = 0, growth = 0, sensitivities = 0, largest = 0, ledger = 0;
  double all() const { return solution + bound + rows + growth + sensitivities + largest + ledger; }
};

/// Estimated cost of a run, within a factor of a few. The choice of effects, if the scenario leaves it open, is not included.
struct RunEstimate {
  Work solution;
  Work certificate;  ///< the second integration, which gives the error bounds
  Work growth;       ///< integration of the growth of disturbances along both motions
  RunSeconds seconds;
};

/// A constant that the results of a scene depend on.
struct Constant {
  std::string name;
  double value = 0;
  std::string unit;
  std::string source;
};

/// What the Fourier sums of a plain symmetric top's two motions are like (the method "fourier").
struct FourierOutlook {
  std::string refusal;        ///< why there are none; empty where there are
  double set_up_s = 0;        ///< estimated time of finding them (s)
  double longest_step_s = 0;  ///< the longest time between two looks at which no angle of the drift goes round unseen (s)
  bool has_azimuth_rate = false;
  double azimuth_rate_rad_s = 0,
         azimuth_rate_bound_rad_s = 0;  ///< the secular rate of the azimuth drift, and a bound on its error
};

/// A resolved scenario. A scene is immutable, and its copies share their computed parts: each part is computed once, when it
/// is first requested, also if several threads request it. A part that needs a release throws ScenarioError where the
/// release does not exist (a steady precession without a real rate); every other part is defined for every validated scenario.
///
/// A Scenario converts implicitly to its scene. Keep the scene if you need it more than once.
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
  /// Returns the Earth's rate and the apparent gravity, given or default; also the WGS 84 ellipsoid if gravity is its default.
  const std::vector<Constant>& constants() const;
  /// `identity_json` of the scenario, and its SHA-256 as 64 hexadecimal digits; equal for scenarios that compute the same.
  const std::string& identity() const;
  const std::string& sha256() const;

  /// Returns what carries the top (support.hpp).
  const Support& support() const;
  /// Returns whether the scene is a top under gravity, on a pivot at rest in the laboratory, with all three torques of [F].
  /// Closed forms, exact flows, and the reduced form of every method but `taylor` need such a scene.
  bool is_plain() const;
  /// Returns the body axis (0, 1 or 2) that is a symmetry axis and holds the centre of mass; -1 without one.
  int symmetry_axis() const;
  /// Returns whether the spin angle can be left out of the integration: the scene is plain and its body symmetric.
  bool is_reducible() const { return is_plain() && symmetry_axis() >= 0; }
  /// Returns whether the series can leave the spin angle out: the body is symmetric, and no torque depends on that angle; or it is
  /// a wheel in a gimbal in the laboratory. The models' own rules are in reduced_top.hpp.
  bool is_reducible_when_driven() const;
  /// Returns whether the two predictions are the same motion apart from a rotation of the laboratory.
  bool is_one_motion() const;
  /// Returns whether anything makes the two predictions differ: the Earth's rotation, or a journey against a laboratory at rest.
  bool has_drift() const;

  /// Returns the same scene on an Earth that does not rotate, with the same attitude and the same rates in the frame that the
  /// release names.
  Scene without_rotation() const;

  /// Body, release and model (SI units); for T double, float80 and float128. The given doubles are exact; everything
  /// derived from them is computed in T. @throws ScenarioError (release, and a model with an air drag, which needs the spin)
  template <class T>
  const Body<T>& body() const;
  template <class T>
  const Release<T>& release() const;
  template <class T>
  const Model<T>& model() const;
  /// Returns contact and start of a top on a table, in SI units, for the same scalars. The scene must have a contact.
  template <class T>
  const TableProblem<T>& table() const;
  /// Returns the release of both predictions on that table, for the checks of a scene (a header of the library's own sources).
  const Touchdown& touchdown() const;
  /// Returns mass, centre of mass and moments of the body, and the rates of precession and nutation of its motion without Earth
  /// rotation (top_figures.hpp). @throws ScenarioError where the release does not exist
  const TopFigures& top() const;
  /// Returns the natural units: in these the rates and moments of the scene are near 1.
  const NaturalUnits& units() const;
  /// Returns the input of the integrations, in natural units.
  template <class T>
  const DriftProblem<T>& problem() const;
  /// Returns the same without its rows: its times are only the release and the end. A long table is 8 bytes a row.
  template <class T>
  const DriftProblem<T>& problem_without_rows() const;

  /// Returns m g l, the largest torque of gravity about the pivot (N m); l is the distance of the centre of mass from it.
  /// @param pivot_acceleration_m_s2  is added to gravity (m/s^2)
  double gravity_torque_N_m(double pivot_acceleration_m_s2 = 0) const;
  /// The same for a top whose centre of mass lies on body axis 3; negative where it lies below the pivot at tilt 0.
  double axial_gravity_torque_N_m() const;
  const PlatformDemand& platform_demand() const;
  /// Returns a rough upper bound (rad/s) on the rates of free nutation, pendulum, spin, Earth and platform.
  double fastest_rate_rad_s() const;
  /// Returns the properties that decide the work, as a rule finds them from body, release and effects; and the same for a body in a
  /// gimbal or on a platform after stretches of its motion were integrated, by the methods of the run, to see their steps.
  const Pace& pace_by_rule() const;
  const Pace& pace() const;
  const StiffFriction& stiffest_friction() const;
  double rows() const { return scenario().duration_s / scenario().output_step_s; }
  /// Returns the closed form that the motion has, or why it has none.
  ExactKind closed_form_kind() const;

  /// Returns the Fourier sums' outlook. They are sought when it is first asked for, which takes a few milliseconds.
  const FourierOutlook& fourier_outlook() const;

  /// Returns why a method does not fit the scene, and what to do; empty where it fits. The limits of methods that fit some
  /// scenes only (closed form, exact flow) are checked here and nowhere else.
  const std::optional<std::string>& method_refusal(Method method) const;
  /// Returns the same for the method that the scenario names.
  const std::optional<std::string>& method_refusal() const { return method_refusal(scenario().numerics.method); }
  /// Checks that the method fits the scene and that its precision is built.   @throws ScenarioError
  void require_integrable() const;
  /// Returns the method of the run. `auto` is resolved by body, effects, observer and precision to the method of least work
  /// at the requested error; any other method is kept.
  const MethodChoice& choice() const;
  /// Returns the form of the equations that an integration with these options uses.
  ModelForm form(const IntegrationOptions& options) const;

  /// Returns the cost of one integration, within a factor of a few. @param options  must name a method, as `choice` does
  IntegrationCost cost(const IntegrationOptions& options) const;
  /// Returns the costs of the two integrations of a run: the solution, and the second integration that gives its bounds.
  const std::array<IntegrationCost, 2>& costs() const;
  /// Returns the estimated cost of the whole run with the chosen method.
  const RunEstimate& estimate() const;
  /// Checks that the scene can be run in an acceptable time.
  /// @throws ScenarioError, with the estimate, for a scene that would take too long: more steps than `numerics.step_limit`,
  /// or in extended precision more than a day
  void require_affordable() const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// Returns the scene of a scenario.
inline Scene resolve(Scenario scenario) { return {std::move(scenario)}; }

/// Returns a time in words, e.g. "about 20 s" or "less than 0.1 s". @param seconds  (s)
/// @param limit_s  a time that the same message gives, from which this one differs in its digits (s)
std::string about_seconds(double seconds, double limit_s = std::numeric_limits<double>::infinity());

/// The errors and warnings found in a scenario's text, sorted by position: at most 20 errors, then one that says how many more
/// there are. Errors of an override come first, at line 0.
struct ScenarioReport {
  std::optional<Scenario> scenario;  ///< empty if there are errors
  std::size_t error_count = 0;       ///< number of all errors, including those not listed
  std::vector<Diagnostic> errors = {};
  std::vector<Diagnostic> warnings = {};  ///< allowed values that look like mistakes, e.g. degrees for radians
  std::optional<Scene> scene = {};        ///< the scene of `scenario`
};

/// Decodes and validates a scenario. The checks include those of its scene: that the release exists, that the method fits and
/// that the run is affordable.
ScenarioReport examine_scenario(const ScenarioSource& source, const Overrides& overrides = {});

/// Decodes and validates a scenario and returns it. @throws ScenarioError with all errors, if there are any
Scenario parse_scenario(const ScenarioSource& source, const Overrides& overrides = {});
Scene parse_scene(const ScenarioSource& source, const Overrides& overrides = {});

}  // namespace earthtop
