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
#include "earthtop/scenario/scenario.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

enum class Profile {
  bitwise,     ///< no tolerance: every digit must be equal
  regression,  ///< the same scene computed otherwise: as much as both error bounds and rounding allow
  physics,     ///< another program or model: up to a thousandth of the Earth's effect in this scene
};
std::string_view to_string(Profile profile);

/// A difference passes if it is at most max(absolute, relative x the quantity's largest size in the reference, bounds x the sum
/// of both results' error bounds). A part that is not given counts as 0.
struct ToleranceRule {
  std::optional<double> absolute;  ///< in the unit of the quantity
  std::optional<double> relative;
  std::optional<double> bounds;
};

/// A profile, and the changes that a tolerance file makes to it.
struct Tolerances {
  Profile profile = Profile::regression;
  std::map<std::string, ToleranceRule> rules;  ///< by the quantity's name
  std::optional<double> steps_ratio;           ///< largest allowed ratio of steps and of evaluations, new to reference
  std::optional<double> seconds_ratio;         ///< largest allowed ratio of wall times, new to reference
  std::string file;                            ///< the tolerance file; empty for a profile alone
};

/// Reads a tolerance file. @throws ScenarioError with all its errors; ReadError
Tolerances read_tolerances(const std::string& file);

struct CompareOptions {
  Tolerances tolerances;
  std::string mapping;                  ///< file that states the meaning of a foreign CSV's columns; empty for none
  std::vector<std::string> may_change;  ///< JSON pointers of scenario keys in which the two may differ; "/" for all
  bool may_lack_rows = false;           ///< whether rows and results of the reference may be missing in the candidate
  bool with_curves = false;             ///< whether to keep the differences over time, for a picture
  Watch watch;                          ///< gets the progress of the comparison, and may stop it
  /// For a CSV file: rows up to this time (s) are compared, and the file need not go on.
  std::optional<double> until_s = {};
};

/// Whether a difference is more than the two computations' errors explain.
enum class Change {
  none,           ///< equal to the last bit
  within_errors,  ///< at most the sum of both error bounds
  above_errors,
  unknown,  ///< no bounds are known
};
std::string_view to_string(Change change);

/// A difference over time: the largest difference in each of several spans of time, with the tolerance there.
struct DifferenceCurve {
  std::vector<double> t_s, difference, tolerance;
};

/// One quantity of a pair of results.
struct QuantityVerdict {
  std::string name;  ///< a measure of the rows, or a dotted path of summary.json; it ends with the unit
  bool passed = true;
  std::string reason;          ///< why it failed where no number says so, e.g. that it is missing; else empty
  std::uint64_t compared = 0;  ///< number of rows compared; 1 for a figure of the summary
  double largest = 0;          ///< largest difference
  std::string where;           ///< place of the largest difference, e.g. "t = 3.1 s"; empty for a figure of the summary
  std::optional<double> at_s;  ///< time of the largest difference
  double tolerance = 0;        ///< tolerance at the largest difference
  std::string origin;          ///< where that tolerance comes from, in words
  double share = 0;            ///< largest ratio of a difference to its tolerance; infinite for one above a tolerance of 0
  std::optional<double> first_violation_s;
  std::string first_violation;   ///< the first violation in words; empty where there is none
  std::uint64_t violations = 0;  ///< number of rows that fail
  Change change = Change::none;
  std::optional<double> errors;               ///< sum of both error bounds where the difference is largest
  std::optional<double> interpolation_error;  ///< of the reference between its rows; added to the tolerance
  DifferenceCurve curve;
};

/// A fault of a pair that belongs to no single quantity.
struct CompareFinding {
  std::string kind;  ///< "other scenario", "missing rows", "missing column", "not finite", ...
  std::string text;
};

/// One measure of cost for both results. The limit is on the ratio candidate / reference.
struct CostRatio {
  std::string name;  ///< "steps", "evaluations", "seconds"
  double reference = 0, candidate = 0;
  std::optional<double> limit;  ///< largest allowed ratio, where one was asked for
  bool passed() const { return !limit || candidate <= *limit * reference; }
};

/// The end that two runs of unlike lengths have in common: that of the shorter one.
struct CommonEnd {
  double t_s = 0, longer_t_s = 0;  ///< the ends of the shorter and of the longer run
  bool reference_goes_on = false;  ///< whether the reference is the longer one
};

/// What was compared, of what the reference has: rows of a trajectory, or points of a study.
struct ComparedSpan {
  double from_s = 0, to_s = 0;  ///< times of the first and of the last row compared
  std::uint64_t of = 0;         ///< number of the reference's rows or points
  bool are_points = false;
};

/// A figure that was not compared, because it has no common meaning for runs of unlike lengths.
struct LeftOut {
  std::string name;
  std::string_view why;
};

/// The comparison of one result with its reference.
struct PairReport {
  std::string name;  ///< in a directory of several results: the path below it
  std::string reference, candidate;
  std::string refusal;  ///< why the two cannot be compared; then all else is empty
  std::vector<CompareFinding> findings;
  std::vector<std::string> notes;       ///< what was not compared, and what was allowed
  std::vector<std::string> unverified;  ///< sentences on files without checksums
  std::vector<std::string> hints;       ///< guesses at the cause of a large difference
  std::uint64_t rows = 0;               ///< number of rows compared
  std::optional<double> until_s;        ///< later rows were not compared, because a result's verdict does not trust them
  std::optional<CommonEnd>
      common_end;  ///< where runs of unlike lengths, which was allowed, were compared up to the shorter's end
  std::vector<LeftOut> left_out;
  std::vector<QuantityVerdict> quantities;
  std::vector<CostRatio> cost;
  ComparedSpan span = {};
  bool passed() const;
};

struct CompareReport {
  std::string reference, candidate;
  Profile profile = Profile::regression;
  std::string tolerances_file;
  std::vector<PairReport> pairs;
  bool passed() const;
  bool refused() const;                         ///< whether at least one of the pairs was refused
  std::vector<std::string> unverified() const;  ///< the sentences of all pairs on files without checksums, each once
};

/// Compares two results, two directories of results, two study stores, or a foreign CSV with any of the first.
/// @throws ScenarioError for input that is empty, truncated or not readable as what it should be, and where the times differ
/// and the reference's rows are too far apart to interpolate between them; in a directory of several results such an error
/// becomes the pair's `refusal`. ReadError for a file that cannot be read. Interrupted if the watch asked to stop.
CompareReport compare_results(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                              const CompareOptions& options);

/// A fit of a scenario's numbers to another program's file. Such a file states no standard errors: all its rows weigh alike.
struct EngineFit {
  struct Number {
    std::string name, unit;
    double given = 0;                ///< the scenario's
    std::optional<double> estimate;  ///< none where the fit did not converge
  };
  std::string scenario, file;
  std::uint64_t rows = 0;
  double given_rms_rad = 0;              ///< root mean square of the differences; those of rates divided by the fastest rate
  std::optional<double> fitted_rms_rad;  ///< with the estimates; none without a fit
  std::string reason;                    ///< why there is no fit; empty where there is one, or none was asked for
  std::vector<Number> numbers;
  bool interrupted = false;
};
/// Fits these numbers of the scenario (as `MeasurementOptions::estimates`) to attitudes, axes and rates of a CSV file with a mapping.
/// @throws ScenarioError, ReadError as `compare_with_measurement`
EngineFit fit_to_engine(const ScenarioSource& source, const Overrides& overrides, const std::string& csv,
                        const std::string& mapping, const std::vector<std::string>& estimates, const Watch& watch);

/// Writes the findings in sentences, the most important one first: how many quantities failed, which one most and by how much, what
/// else is wrong, and whether both error bounds explain the changes.
std::vector<std::string> comparison_conclusion(const CompareReport& report);
/// As JSON ("earthtop-comparison-1.json") with a final newline.
std::string comparison_json(const CompareReport& report);
/// A fit as JSON ("earthtop-engine-fit-1.json") with a final newline.
std::string engine_fit_json(const EngineFit& fit);
/// As JUnit XML: one test suite for each pair, one test case for each quantity.
std::string comparison_junit(const CompareReport& report);
/// A figure of the differences over time with their tolerances, for the first pair that failed, or the first pair if none did.
Figure comparison_figure(const CompareReport& report);

/// Replaces `reference` by `candidate`: a results directory by its files, a study store by the store, a compact reference
/// (FILE.json, or a directory of them) by figures and eleven rows of the new results. All references of a directory change
/// together or not at all: what a killed update left is completed, or removed if it had changed nothing, by the next
/// one and by the next comparison with the reference. Runs that write new results meanwhile are waited for.
/// Files whose content is the same are not touched, and a reference in which nothing else would change gets no reason.
/// @param reason  kept in the references that change   @param unchanged  gets those that stay as they are
/// @returns the references that were written
/// @throws ScenarioError for input that cannot be a reference, or that goes on changing; ReadError, WriteError; Interrupted
std::vector<std::string> update_reference(const std::filesystem::path& reference, const std::filesystem::path& candidate,
                                          const std::string& reason, const Watch& watch = {},
                                          std::vector<std::string>* unchanged = nullptr);

/// JSON Schema (draft 7) of a mapping file and of a tolerance file, and every key of them as a Markdown table.
std::string mapping_schema();
std::string mapping_reference_markdown();
std::string tolerances_schema();
std::string tolerances_reference_markdown();

}  // namespace earthtop
