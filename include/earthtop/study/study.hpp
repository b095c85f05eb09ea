// SPDX-License-Identifier: GPL-3.0-or-later
/// A parameter study: a base scenario, axes along which its keys change, a design that chooses points, quantities to collect.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// What one axis does to the scenario: keys changed together, over a list of values or a range.
struct StudyAxis {
  std::string name;                   ///< of its column
  std::vector<std::string> pointers;  ///< JSON pointers into the scenario

  std::vector<std::vector<std::string>> levels;  ///< of a list: JSON values, one for each pointer
  struct Range {
    std::vector<double> from, to;  ///< one for each pointer
    std::uint64_t points = 0;      ///< 0 where none are given
    bool logarithmic = false;
  };
  std::optional<Range> range;  ///< instead

  /// How many values a grid takes of it; 0 where a range does not say.
  std::uint64_t size() const { return range ? range->points : levels.size(); }
};

enum class DesignKind { grid, random, latin_hypercube, sobol, one_at_a_time };
std::string_view to_string(DesignKind kind);

struct StudyDesign {
  DesignKind kind = DesignKind::grid;
  std::uint64_t points = 0;  ///< of a drawn design; of Sobol indices, base points
  std::uint64_t seed = 1;
  bool indices = false;  ///< Saltelli's scheme: (axes + 2) runs a base point
};

/// A number or word taken from each run.
struct StudyQuantity {
  std::string name;  ///< of its column
  std::string path;  ///< dotted path in summary.json
};

enum class FitKind { linear, sin_latitude, cos_latitude, logarithmic, power_law };
std::string_view to_string(FitKind kind);

struct StudyFit {
  FitKind kind = FitKind::linear;
  std::string axis, quantity;
};

/// A figure known from elsewhere, held against the study's results.
struct StudyFigure {
  std::string figure;  ///< JSON pointer into the results document
  double value = 0, tolerance = 0;
  std::string origin;
};

struct StudyLimits {
  std::uint64_t points = 10'000'000;
  double core_hours = 1000;
  double disk_gb = 20;
  bool stops_beyond_estimate = true;  ///< a point at ten times the work estimated of it
};

struct Study {
  // Compiled once, not in every source that holds one.
  Study();
  Study(const Study&);
  Study(Study&&) noexcept;
  Study& operator=(const Study&);
  Study& operator=(Study&&) noexcept;
  ~Study();

  std::string name = "unnamed";
  std::string title, purpose, finding;
  std::string text;  ///< the study file's
  ScenarioSource base;
  bool base_inside = false;                              ///< the base stands in the study file itself, not in a file of its own
  std::vector<std::pair<std::string, std::string>> set;  ///< JSON pointer and JSON value
  std::vector<StudyAxis> axes;
  StudyDesign design;
  std::vector<StudyQuantity> quantities;
  bool needed_rows_only = true;
  std::vector<StudyFit> fits;
  std::vector<StudyFigure> figures;
  StudyLimits limits;
};

/// Decodes and validates a study file, and reads its base.
/// @param base  instead of the file that the study names: of a study that was accepted before (a store's). Whether its pointers
/// and paths are still those of a scenario and a summary is not asked: what was computed stays readable.
/// @throws ScenarioError with all violations; for a base that cannot be read; ReadError.
Study parse_study(const ScenarioSource& source, const std::optional<ScenarioSource>& base = std::nullopt);

/// How many points a study has; counted, not built.
/// @returns nothing for more than 2^53
std::optional<std::uint64_t> point_count(const Study& study);

/// @throws ScenarioError where a study has more points than its limit allows, takes longer or needs more disk, with the
/// estimate.
void require_affordable(const Study& study);

/// What a study would take: by the cost model of its first, middle and last points.
struct StudyEstimate {
  std::uint64_t points = 0;
  double core_seconds = 0;
  double disk_bytes = 0;
};
StudyEstimate estimate(const Study& study);

/// What some of a study's points turn out to be, before any is computed.
struct StudySample {
  std::uint64_t looked_at = 0;
  std::uint64_t refused = 0;
  std::string first_refusal;            ///< of the first one refused; empty where none is
  std::optional<ScenarioError> common;  ///< what all of them are refused for, where it is the same
};
/// Resolves twenty points spread over the whole design, the first and the last among them (all of fewer): decodes and checks
/// each one's scenario, and integrates nothing. Two refusals are the same where they are for the same key.
StudySample sample_points(const Study& study);

/// The identity of a study's results: SHA-256 of design, axes, quantities, and of the base as the points see it. Comments,
/// titles, fits and limits are not part of it.
std::string study_sha256(const Study& study);

/// JSON Schema (draft 7) of a study file, and every key of it as a Markdown table.
std::string study_schema();
std::string study_reference_markdown();

}  // namespace earthtop
