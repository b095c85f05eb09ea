// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario: everything a run needs, typed, with every default resolved.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/frames/site.hpp"
#include "earthtop/frames/tide_spec.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/integrate/pace.hpp"
#include "earthtop/model/applied_torques_spec.hpp"
#include "earthtop/model/body_spec.hpp"
#include "earthtop/model/ledger_row.hpp"
#include "earthtop/model/platform_spec.hpp"
#include "earthtop/model/release_spec.hpp"
#include "earthtop/scenario/criterion.hpp"

namespace earthtop {

/// The effects that act: [F]'s three torques (one that is switched off is left out of dL'/dt in the laboratory), and what acts
/// beside gravity.
struct EffectsSpec {
  bool coriolis = true;
  bool centrifugal = true;
  bool transverse = true;
  AppliedTorquesSpec applied;
  std::optional<TideSpec> tide;
  bool automatic = false;  ///< what has no parameter of its own is chosen by the drift error asked for
  bool operator==(const EffectsSpec&) const = default;
  bool all_on() const { return coriolis && centrifugal && transverse; }
  /// Returns whether gravity and all three of [F]'s torques act, and nothing else.
  bool plain() const { return all_on() && !applied.any() && !tide; }
};

/// A figure known from elsewhere (closed form, theory, publication, extended precision) that a run is held against.
struct HeadlineSpec {
  std::string quantity;        ///< a column of trajectory.csv, or a dotted path of summary.json; its name says the unit
  std::optional<double> at_s;  ///< of a column: the time of its row (s); the duration if not given
  double value = 0;
  double tolerance = 0;  ///< largest difference, unit of the quantity
  std::string origin;
  bool operator==(const HeadlineSpec&) const = default;
};

/// The inputs by which a drift's derivatives are taken, each named by its key and unit.
inline constexpr std::array<std::string_view, 7> kInputNames{
    "latitude_deg", "gravity_m_s2", "spin_rad_s", "tilt_deg", "rotation_rate_rad_s", "inertia_ratio", "center_of_mass_m"};

struct Scenario {
  // Compiled once, not in every source that holds one.
  Scenario();
  Scenario(const Scenario&);
  Scenario(Scenario&&) noexcept;
  Scenario& operator=(const Scenario&);
  Scenario& operator=(Scenario&&) noexcept;
  ~Scenario();
  bool operator==(const Scenario&) const;

  std::string name = "unnamed";
  std::string title;
  std::string purpose;
  std::optional<HeadlineSpec> headline;
  std::vector<CriterionSpec> criteria;
  Site site;
  double rotation_rate_rad_s = kEarthRateWgs84;  ///< less what a longer day takes of it
  double nominal_rate_rad_s = kEarthRateWgs84;   ///< the rate as it was given, which a longer day takes its part of
  double excess_length_of_day_ms = 0;            ///< which is in the rotation rate already
  double gravity_anomaly_m_s2 = 0;               ///< which is in the site's gravity already
  BodySpec body;
  ReleaseSpec release;
  double duration_s = 0;
  std::optional<std::string> start_utc;  ///< ISO 8601, e.g. 2026-11-22T12:00:00Z
  double output_step_s = 0;
  std::optional<PlatformSpec> platform;
  EffectsSpec effects;
  IntegrationOptions numerics;
  Precision precision = Precision::bits53;
  std::optional<LedgerObserver> ledger;  ///< whose torques are listed in torques.csv
  std::optional<double> threshold_rad;
  std::optional<double> accuracy_rad;  ///< the error asked for of the axis drift
  bool sensitivities = false;          ///< whether the drift's derivatives by the inputs are wanted
  /// Standard errors of the inputs, in the order and units of kInputNames; 0 where not given.
  std::optional<std::array<double, kInputNames.size()>> uncertainty;
};

/// Whether a scene is a top under gravity on a pivot at rest in the laboratory, with all three of [F]'s torques: what closed
/// forms, series, exact flows and the reduced form are made for.
inline bool is_plain(const Scenario& scenario) { return !scenario.platform && scenario.effects.plain(); }

/// Output rows of a scenario: k x step, and exactly the duration at the end. A k x step within 1e-9 step of the duration is
/// that last row; a step longer than the duration gives the rows 0 and the end only.
/// @param duration_s, output_step_s  (s)   @returns times (s), ascending
/// @throws ScenarioError for a duration or step that is not above 0, or for more than 2,000,000 rows.
std::vector<double> output_times(double duration_s, double output_step_s);

/// A scenario file's text and where it came from ("<stdin>" for standard input).
struct ScenarioSource {
  std::string file;  ///< files that the text names are looked for beside it; beside nothing: in the working directory
  std::string text;
  bool may_name_files = true;  ///< false: a text that names a file is refused, and none is opened
};

/// Reads a scenario file, "-" for standard input. @throws ScenarioError for a missing, unreadable, oversized (over 16 MiB)
/// file, a directory or a FIFO; ReadError.
ScenarioSource read_scenario_source(const std::string& path);

/// The findings in a scenario's text, sorted by position: at most 20 errors, then one that says how many more there are. Those
/// about an override stand first, at line 0.
struct ScenarioReport {
  std::optional<Scenario> scenario;  ///< nothing where there are errors
  std::size_t error_count = 0;       ///< all of them, also those beyond the twentieth
  std::vector<Diagnostic> errors;
  std::vector<Diagnostic> warnings;  ///< allowed, but looks like a mistake: degrees for radians, grams for kilograms ...
};

/// Decodes and validates a scenario. @param overrides  `--set` pairs: JSON pointer and JSON value (a value that is not JSON
/// is taken as a string).
ScenarioReport examine_scenario(const ScenarioSource& source,
                                const std::vector<std::pair<std::string, std::string>>& overrides = {});

/// The same for those who want a scenario or nothing. @throws ScenarioError with all errors
Scenario parse_scenario(const ScenarioSource& source, const std::vector<std::pair<std::string, std::string>>& overrides = {});

/// Why a method does not fit a scene, and what to do; nothing where it does. A method that is made for some scenes only (a
/// closed form, an exact flow) says so here, and nowhere else.
std::optional<std::string> method_refusal(Method method, const Scenario& scenario);

/// The method a run takes, and why.
struct MethodChoice {
  IntegrationOptions options;  ///< with a method, and the observer whose axes it takes
  std::string reason;
};
/// `auto` resolved by body, effects, observer and precision to the method of least work at the error asked for; any other
/// method as it was asked for.
MethodChoice method_choice(const Scenario& scenario);

/// Angular frequencies of the motion (rad/s): a rough upper bound on free nutation, pendulum, spin, Earth and platform.
double fastest_rate_rad_s(const Scenario& scenario);

/// Work of one integration of a scenario, within a factor of a few. @param options  with a method, as `method_choice` gives
Work estimated_work(const Scenario& scenario, const IntegrationOptions& options);

/// What a run will take, within a factor of a few.
struct RunEstimate {
  Work solution;
  Work certificate;    ///< the second integration, from which the bounds come
  Work growth;         ///< of disturbances along both motions
  double seconds = 0;  ///< on one core, of all of them, and of sensitivities and rows
};
RunEstimate estimated_run(const Scenario& scenario);

/// Steps that the first integration will take.
double estimated_steps(const Scenario& scenario);

/// Time of the whole run on one core (s).
double estimated_seconds(const Scenario& scenario);

/// "about 20 s", "less than 0.1 s"
std::string about_seconds(double seconds);

/// Of one integration alone (s).
double estimated_seconds(const Scenario& scenario, const IntegrationOptions& options);

/// @throws ScenarioError, with the estimate, for a scene that would take days: more steps than `numerics.step_limit`, or in
/// extended precision more than a day.
void require_affordable(const Scenario& scenario);

/// The Earth's rate of rotation (rad/s), less what an excess length of day takes of it.
double resolved_rotation_rate_rad_s(const Scenario& scenario);
/// The site with its apparent gravity, the anomaly included.
Site resolved_site(const Scenario& scenario);

/// The scenario with every default written out, as one line of JSON with sorted keys and shortest numbers. It reads back as an
/// equal scenario; comments are not part of it.
std::string canonical_json(const Scenario& scenario);

/// The identity of a run: the canonical text without the keys that only describe the scenario (title, purpose, headline,
/// criteria), on which no result depends.
std::string identity_json(const Scenario& scenario);
/// The top-level keys that only describe a scenario.
std::vector<std::string_view> describing_keys();

}  // namespace earthtop
