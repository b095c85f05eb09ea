// SPDX-License-Identifier: GPL-3.0-or-later
/// A parameter study: a base scenario, axes along which keys of it vary, a design that chooses points, and quantities to
/// collect.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

/// One axis of a study: keys of the scenario that vary together, over a list of values or over a range.
struct StudyAxis {
  std::string name;                   ///< name of the axis's column in the results
  std::vector<std::string> pointers;  ///< JSON pointers of the varied keys in the scenario

  std::vector<std::vector<std::string>> levels;  ///< for a list: JSON values, one for each pointer
  struct Range {
    std::vector<double> from, to;  ///< ends of the range, one for each pointer
    std::uint64_t points = 0;      ///< number of points on a grid; 0 if none is given
    bool logarithmic = false;
  };
  std::optional<Range> range;  ///< given instead of `levels`

  /// Number of values that the axis has on a grid; 0 for a range without a number of points.
  std::uint64_t size() const { return range ? range->points : levels.size(); }
};

enum class DesignKind { grid, random, latin_hypercube, sobol, one_at_a_time };
std::string_view to_string(DesignKind kind);
/// Whether points lie anywhere in the axes' ranges, not on the levels of a grid.
constexpr bool is_drawn(DesignKind kind) {
  return kind == DesignKind::random || kind == DesignKind::latin_hypercube || kind == DesignKind::sobol;
}

struct StudyDesign {
  DesignKind kind = DesignKind::grid;
  std::uint64_t points = 0;  ///< number of points for a drawn design; number of base points for Sobol indices
  std::uint64_t seed = 1;
  bool indices = false;  ///< Saltelli's scheme for Sobol indices: (axes + 2) runs per base point
};

/// A number or word taken from the results of each run.
struct StudyQuantity {
  std::string name;  ///< name of its column in the results
  std::string path;  ///< dotted path in summary.json
};

enum class FitKind { linear, sin_latitude, cos_latitude, logarithmic, power_law };
std::string_view to_string(FitKind kind);

struct StudyFit {
  FitKind kind = FitKind::linear;
  std::string axis, quantity;
};

/// A number known from another source, with which the study's results are compared.
struct StudyFigure {
  std::string figure;  ///< JSON pointer into the results document (study.json)
  double value = 0, tolerance = 0;
  std::string origin;
};

struct StudyLimits {
  std::uint64_t points = 10'000'000;
  double core_hours = 1000;
  double disk_gb = 20;
  bool stops_beyond_estimate = true;  ///< stop a point that needs ten times the work estimated for it
};

struct Study {
  // These are defined in one source file, so that not every file that uses a Study compiles them.
  Study();
  Study(const Study&);
  Study(Study&&) noexcept;
  Study& operator=(const Study&);
  Study& operator=(Study&&) noexcept;
  ~Study();

  std::string name = "unnamed";
  std::string title, purpose, finding;
  std::string text;  ///< text of the study file
  ScenarioSource base;
  bool base_inside = false;                              ///< the base is part of the study file, not a file of its own
  std::vector<std::pair<std::string, std::string>> set;  ///< changes of the base for all points: JSON pointer, JSON value
  std::vector<StudyAxis> axes;
  StudyDesign design;
  std::vector<StudyQuantity> quantities;
  bool needed_rows_only = true;
  std::vector<StudyFit> fits;
  std::vector<StudyFigure> figures;
  StudyLimits limits;
};

/// Decodes and validates a study file, and reads its base.
/// @param base used instead of the base that the file names. It is given for a study that was accepted before (the one in a
/// store); its pointers and paths are then not checked against today's scenario and summary, so that old results stay readable.
/// @throws ScenarioError with all violations, an unreadable base among them; ReadError if reading the base fails
Study parse_study(const ScenarioSource& source, const std::optional<ScenarioSource>& base = std::nullopt);

/// Number of points of a study; it is computed without building the points.
/// @returns nothing if there are more than 2^53
std::optional<std::uint64_t> point_count(const Study& study);

/// @throws ScenarioError, with the estimate, if a study has no points or exceeds its limits on points, computing time or disk
/// space
void require_affordable(const Study& study);

/// Expected cost of a study, from the cost model applied to up to 25 points spread over the design.
struct StudyEstimate {
  std::uint64_t points = 0;
  double core_seconds = 0;
  double disk_bytes = 0;
  double memory_bytes = 0;        ///< of the process with its store, without the motions that its threads hold
  double memory_bytes_a_job = 0;  ///< of the motions that one thread holds
};
StudyEstimate estimate(const Study& study);

/// Findings of the check of some of a study's points before any of them is computed.
struct StudySample {
  std::uint64_t looked_at = 0;
  std::uint64_t refused = 0;
  std::string first_refusal;            ///< message for the first refused point; empty if none is refused
  std::optional<ScenarioError> common;  ///< the reason for which all of them are refused, if it is the same
};
/// Decodes and checks the scenarios of twenty points spread over the whole design, the first and the last among them (of all
/// points if there are fewer). Nothing is integrated. Two refusals count as the same if they concern the same key.
StudySample sample_points(const Study& study);

/// The identity of a study's results: SHA-256 of its design, axes and quantities, and of the base scenario as the points see
/// it. Comments, titles, fits and limits are not part of it.
std::string study_sha256(const Study& study);

/// Something that a study can collect.
struct CollectablePath {
  std::string path;  ///< dotted path in summary.json; the number 0 stands for any element of a list
  std::string unit, meaning;
};
/// Everything that a study can collect.
/// @param source  a study file, or a scenario: what no run of it can have is left out   @throws ScenarioError
std::vector<CollectablePath> collectable_paths(const std::optional<ScenarioSource>& source = std::nullopt);

/// JSON Schema (draft 7) of a study file, and every key of it as a Markdown table.
std::string study_schema();
std::string study_reference_markdown();

}  // namespace earthtop
