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
#include "earthtop/model/applied_torques_spec.hpp"
#include "earthtop/model/body_spec.hpp"
#include "earthtop/model/ledger_row.hpp"
#include "earthtop/model/platform_spec.hpp"
#include "earthtop/model/release_spec.hpp"
#include "earthtop/scenario/criterion.hpp"

namespace earthtop {

/// Which of [F]'s three torques act (switched off means: left out of dL'/dt in the laboratory), and what acts beside gravity.
struct EffectsSpec {
  bool coriolis = true;
  bool centrifugal = true;
  bool transverse = true;
  AppliedTorquesSpec applied;
  std::optional<TideSpec> tide;
  bool automatic = false;  ///< what has no parameter of its own is chosen by the drift error asked for
  bool all_on() const { return coriolis && centrifugal && transverse; }
  /// Whether gravity and all three of [F]'s torques act, and nothing else.
  bool plain() const { return all_on() && !applied.any() && !tide; }
};

/// A figure known from elsewhere (closed form, theory, publication, extended precision) that a run is held against.
struct HeadlineSpec {
  std::string quantity;        ///< a column of trajectory.csv, or a dotted path of summary.json; its name says the unit
  std::optional<double> at_s;  ///< of a column: the time of its row (s); the duration if not given
  double value = 0;
  double tolerance = 0;  ///< largest difference, unit of the quantity
  std::string origin;
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

  std::string name = "unnamed";
  std::string title;
  std::string purpose;
  std::optional<HeadlineSpec> headline;
  std::vector<CriterionSpec> criteria;
  Site site;
  double rotation_rate_rad_s = kEarthRateWgs84;  ///< less what a longer day takes of it
  double excess_length_of_day_s = 0;             ///< which is in the rate already
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

/// The scenario with every default written out, as one line of JSON with sorted keys and shortest numbers: the identity of
/// a run. Output location and comments are not part of it.
std::string canonical_json(const Scenario& scenario);

}  // namespace earthtop
