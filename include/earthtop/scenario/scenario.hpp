// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario: everything a run needs, typed, with every default resolved.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/frames/site.hpp"
#include "earthtop/frames/tide_spec.hpp"
#include "earthtop/frames/travel_spec.hpp"
#include "earthtop/integrate/options.hpp"
#include "earthtop/model/applied_torques_spec.hpp"
#include "earthtop/model/body_spec.hpp"
#include "earthtop/model/contact_spec.hpp"
#include "earthtop/model/gimbals_spec.hpp"
#include "earthtop/model/ledger_row.hpp"
#include "earthtop/model/moving_masses_spec.hpp"
#include "earthtop/model/platform_spec.hpp"
#include "earthtop/model/release_spec.hpp"
#include "earthtop/model/rotor_spec.hpp"
#include "earthtop/scenario/criterion.hpp"
#include "earthtop/scenario/instrument.hpp"

namespace earthtop {

/// The effects that act: the three torques of [F] (one that is switched off is left out of dL'/dt in the laboratory), and
/// all torques and accelerations besides gravity.
struct EffectsSpec {
  bool coriolis = true;
  bool centrifugal = true;
  bool transverse = true;
  AppliedTorquesSpec applied;
  std::optional<TideSpec> tide;
  bool automatic = false;  ///< effects without a parameter of their own are chosen by the requested accuracy
  bool operator==(const EffectsSpec&) const = default;
  bool all_on() const { return coriolis && centrifugal && transverse; }
  /// Returns whether gravity and all three of [F]'s torques act, and nothing else.
  bool plain() const { return all_on() && !applied.any() && !tide; }
};

/// A figure known independently (closed form, theory, publication, extended precision), with which a run is compared.
struct HeadlineSpec {
  std::string quantity;        ///< a column of trajectory.csv, or a dotted path of summary.json; its name says the unit
  std::optional<double> at_s;  ///< for a column: the time of its row (s); the duration if not given
  double value = 0;
  double tolerance = 0;  ///< largest difference allowed, in the unit of the quantity
  std::string origin;
  bool operator==(const HeadlineSpec&) const = default;
};

/// The number of inputs with respect to which a drift is differentiated; inputs.hpp lists them.
inline constexpr std::size_t kInputCount = 61;

struct Scenario {
  // The special members are defined in one source file, to save compile time in the others.
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
  // The next three numbers and the site's gravity are as given, or defaults; `resolved_rotation_rate_rad_s` and
  // `resolved_site` combine them.
  double rotation_rate_rad_s = kEarthRateWgs84;
  double excess_length_of_day_ms = 0;
  double gravity_anomaly_m_s2 = 0;
  BodySpec body;                              ///< without the rotor and the moving masses
  std::optional<RotorSpec> rotor;             ///< that turns in the body; none: a rigid body
  std::vector<MovingMassSpec> moving_masses;  ///< that the body or the outer gimbal carries, and does not contain
  std::optional<GimbalsSpec> gimbals;         ///< that hold the body, which is the inner one; none: a fixed pivot
  ReleaseSpec release;
  double duration_s = 0;
  std::optional<std::string> start_utc;  ///< ISO 8601, e.g. 2026-11-22T12:00:00Z
  double output_step_s = 0;
  std::optional<PlatformSpec> platform;
  std::optional<Instrument> instrument;  ///< none: an ideal one
  std::optional<ContactSpec> contact;    ///< the tip on a table; none: a fixed pivot
  EffectsSpec effects;
  IntegrationOptions numerics;
  Precision precision = Precision::bits53;
  std::optional<LedgerObserver> ledger;  ///< the observer whose torques are listed in torques.csv
  std::optional<double> threshold_rad;
  std::optional<double> reported_spin_rad_s, reported_tilt_deg;  ///< of which the first time is reported
  std::optional<double> accuracy_rad;                            ///< requested error of the axis drift (rad)
  bool sensitivities = false;  ///< whether derivatives of the drift by the inputs are requested
  /// Standard errors of the inputs, in the order and units of the table in inputs.hpp; 0 where not given.
  std::optional<std::array<double, kInputCount>> uncertainty;
  std::optional<TravelSpec> travel;  ///< the laboratory's journey; none: it stays at the site
};

/// The times of a scenario's output rows: k x step, and exactly the duration at the end. A k x step within 1e-9 step of the
/// duration becomes that last row; a step longer than the duration gives only the rows at 0 and at the end.
class OutputTimes {
 public:
  /// @param duration_s, output_step_s  (s)
  /// @throws ScenarioError for a duration or step that is not above 0, or for more than 2,000,000 rows.
  OutputTimes(double duration_s, double output_step_s);
  std::size_t size() const { return size_; }
  /// The time of a row (s).
  double at(std::size_t row) const { return row + 1 == size_ ? duration_s_ : static_cast<double>(row) * step_s_; }

 private:
  double duration_s_, step_s_;
  std::size_t size_;
};

/// Returns all of them. @returns times (s), ascending, of shape (rows)   @throws as OutputTimes
std::vector<double> output_times(double duration_s, double output_step_s);

/// Returns the tables that a scenario has from files, one for each file.
std::vector<const FiledTable*> tables_of(const Scenario& scenario);

/// A scenario file's text and where it came from ("<stdin>" for standard input).
struct ScenarioSource {
  std::string file;  ///< path; files named in the text are searched in its directory, or in the working directory
  std::string text;
  bool may_name_files = true;  ///< if false, a text that names a file is refused and no file is opened
};

/// Reads a scenario file, or standard input if the path is "-".
/// @throws ScenarioError for a missing, unreadable or oversized (over 16 MiB) file, a directory or a FIFO; ReadError where
/// reading fails
ScenarioSource read_scenario_source(const std::string& path);

/// Returns the Earth's rotation rate (rad/s), reduced by the excess length of day.
double resolved_rotation_rate_rad_s(const Scenario& scenario);
/// Returns the site with the gravity anomaly added to its apparent gravity (m/s^2).
Site resolved_site(const Scenario& scenario);

/// The changes given by `--set`: pairs of a JSON pointer and a JSON value (a value that is not JSON is taken as a string).
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// Returns a scenario's text with these changes in it; everything else stays as it is, comments and layout included.
/// @param text  that of a valid scenario   @throws ScenarioError where a pointer leads to no place
std::string changed_text(std::string text, const Overrides& overrides);

/// Returns the scenario with every default written out, as one line of JSON with sorted keys and the shortest numbers that
/// read back exactly. Decoding it gives an equal scenario; comments are not part of it.
std::string canonical_json(const Scenario& scenario);

/// Returns the identity of a run: the canonical text without the keys that only describe the scenario (title, purpose,
/// headline, criteria); no result depends on those keys.
std::string identity_json(const Scenario& scenario);
/// Returns the top-level keys that only describe a scenario.
std::vector<std::string_view> describing_keys();

}  // namespace earthtop
