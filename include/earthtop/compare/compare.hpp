// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparison of two results: the differences between them in physical measures, each checked against a tolerance that states
/// where it comes from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

enum class Profile {
  bitwise,     ///< every digit
  regression,  ///< the same scene computed otherwise: what both error bounds and rounding leave open
  physics,     ///< another program or model: a thousandth of the Earth's effect in this scene
};
std::string_view to_string(Profile profile);

/// A difference passes up to max(absolute, relative x the quantity's largest size in the reference, bounds x the sum of both
/// results' error bounds). What is not given is 0.
struct ToleranceRule {
  std::optional<double> absolute;  ///< unit of the quantity
  std::optional<double> relative;
  std::optional<double> bounds;
};

/// A profile and what a file changes of it.
struct Tolerances {
  Profile profile = Profile::regression;
  std::map<std::string, ToleranceRule> rules;  ///< by the quantity's name
  std::optional<double> steps_ratio;           ///< most that steps and evaluations may grow by
  std::optional<double> seconds_ratio;         ///< the same of the wall time
  std::string file;                            ///< where the rules stand; empty for a profile alone
};

/// Reads a tolerance file. @throws ScenarioError with all its errors; ReadError
Tolerances read_tolerances(const std::string& file);

struct CompareOptions {
  Tolerances tolerances;
  std::string mapping;                  ///< file that says what a foreign CSV's columns are; empty for none
  std::vector<std::string> may_change;  ///< pointers of scenario keys in which the two may differ; "/" for all
  bool may_lack_rows = false;           ///< rows and results of the reference that are not in the other one
  bool with_curves = false;             ///< keep the differences over time, for a picture
  Watch watch;                          ///< sees how far it is
};

/// Whether a difference is more than the two computations' errors explain.
enum class Change {
  none,           ///< not a bit
  within_errors,  ///< at most the sum of both error bounds
  above_errors,
  unknown,  ///< no bounds are known
};
std::string_view to_string(Change change);

/// Largest differences in as many spans of time, with the tolerance there.
struct DifferenceCurve {
  std::vector<double> t_s, difference, tolerance;
};

/// One quantity of a pair of results.
struct QuantityVerdict {
  std::string name;  ///< a measure of the rows, or a dotted path of summary.json; the unit is in it
  bool passed = true;
  std::string reason;          ///< why it failed where no number says so, e.g. that it is missing; else empty
  std::uint64_t compared = 0;  ///< rows, or 1
  double largest = 0;          ///< difference
  std::string where;           ///< of the largest, e.g. "t = 3.1 s"; empty of a figure of the summary
  std::optional<double> at_s;  ///< the same as a time
  double tolerance = 0;        ///< there
  std::string origin;          ///< of that tolerance
  double share = 0;            ///< largest part of its tolerance that any difference takes; infinite beyond a tolerance of 0
  std::optional<double> first_violation_s;
  std::string first_violation;   ///< the same in words; empty where there is none
  std::uint64_t violations = 0;  ///< rows
  Change change = Change::none;
  std::optional<double> errors;               ///< sum of both error bounds where the difference is largest
  std::optional<double> interpolation_error;  ///< of the reference between its rows; counted to the tolerance
  DifferenceCurve curve;
};

/// A fault of a pair that belongs to no single quantity.
struct CompareFinding {
  std::string kind;  ///< "other scenario", "missing rows", "missing column", "not finite", ...
  std::string text;
};

/// Work and time of the new result over those of the reference.
struct CostRatio {
  std::string name;  ///< "steps", "evaluations", "seconds"
  double reference = 0, candidate = 0;
  std::optional<double> limit;  ///< where one was asked for
  bool passed() const { return !limit || candidate <= *limit * reference; }
};

/// One result held against its reference.
struct PairReport {
  std::string name;  ///< in a directory of many: the path below it
  std::string reference, candidate;
  std::string refusal;  ///< why the two cannot be compared; then nothing else is there
  std::vector<CompareFinding> findings;
  std::vector<std::string> notes;  ///< what was not compared, and what was allowed
  std::vector<std::string> hints;  ///< what a large difference looks like
  std::uint64_t rows = 0;          ///< compared
  std::optional<double> until_s;   ///< rows after it were not compared, because a verdict does not trust them
  std::vector<QuantityVerdict> quantities;
  std::vector<CostRatio> cost;
  bool passed() const;
};

struct CompareReport {
  std::string reference, candidate;
  Profile profile = Profile::regression;
  std::string tolerances_file;
  std::vector<PairReport> pairs;
  bool passed() const;
  bool refused() const;  ///< one of the pairs at least
};

/// Compares two results, two directories of results, two study stores, or a foreign CSV with any of the first.
/// @throws ScenarioError for input that is empty, truncated or not readable as what it should be, and where the times differ
/// and the reference's rows are too far apart to interpolate between them; in a directory of many that is the pair's
/// `refusal`. ReadError.
CompareReport compare_results(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                              const CompareOptions& options);

/// As JSON ("earthtop-comparison-1.json") with a final newline.
std::string comparison_json(const CompareReport& report);
/// As JUnit XML: a suite a pair, a case a quantity.
std::string comparison_junit(const CompareReport& report);
/// Differences over time with their tolerances, of the first pair that failed, or of the first.
Figure comparison_figure(const CompareReport& report);

/// Replaces `reference` by `candidate`: a results directory by its files, a study store by the store, a compact reference
/// (FILE.json, or a directory of them) by figures and eleven rows of the new results. @param reason  kept in the reference
/// @returns what was written   @throws ScenarioError for input that cannot be a reference; WriteError
std::vector<std::string> update_reference(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                                          const std::string& reason);

/// JSON Schema (draft 7) of a mapping file and of a tolerance file, and every key of them as a Markdown table.
std::string mapping_schema();
std::string mapping_reference_markdown();
std::string tolerances_schema();
std::string tolerances_reference_markdown();

}  // namespace earthtop
