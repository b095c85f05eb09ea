// SPDX-License-Identifier: GPL-3.0-or-later
/// The result files of a run: trajectory.csv, torques.csv if a ledger was requested, drift.svg, timing.json, summary.json.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/plot/plot.hpp"
#include "earthtop/run.hpp"
#include "earthtop/run/contact_explanation.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// The rows as CSV: one header line and one line for each row, in SI units and rad. Numbers are the shortest that read back to
/// the same bits (float128: 34 digits; times are doubles in every precision). A value that is absent or not finite is an empty
/// field.
std::string trajectory_csv(const RunResult& result);

/// The columns of the ledger in its observer's axes (N m), written like the trajectory; only the header if there is no ledger.
std::string torques_csv(const RunResult& result);

/// The main numbers of the drift (rad) with all digits of the run's precision (34 for float128).
struct DriftDigits {
  std::string axis_final_rad, axis_max_rad, attitude_final_rad, spin_final_rad;
};
/// None for a run in double precision and for a run without rows.
std::optional<DriftDigits> drift_digits(const RunResult& result);

/// Everything about a run except its rows and its wall time, as JSON with a final newline. The same result always gives the
/// same bytes, on any host and at any time; a number that is not finite is null.
std::string summary_json(const RunResult& result);

/// The effect budget of a scenario, and the effects that `run` would choose from it, as JSON with a final newline.
std::string budget_json(const Budget& budget, const Scene& scene);
/// The same of a top on a table: what `earthtop explain --json` prints of it.
std::string contact_explanation_json(const ContactExplanation& explained, const Scene& scene);

/// The matching rule in words: which quantities both predictions have in common at release.
std::string matching_rule(const Scenario& scenario);

/// The wall time (s), date (UTC) and host of a run, which differ from run to run, as JSON with a final newline.
std::string timing_json(const RunResult& result);

/// The figure of the drift over time, which is also the chart of the run's page: the angle between the two axes and its parts.
Figure drift_figure(const RunResult& result);

/// Checks whether the results of `scenario` may be written to `dir`, which need not exist. To be called before a run, so that
/// nothing is computed in vain.
/// @param force  overwrite also the results of another scenario
/// @throws ScenarioError if `dir` cannot be a directory, or holds another scenario's results, or a file with the name of a
/// result that is not known to be one; WriteError if `dir` cannot be written to
void check_output_directory(const std::filesystem::path& dir, const Scene& scene, bool force);

/// The first of `dir`, `dir`-2, `dir`-3 and so on to which the results of a scene may be written without overwriting others.
/// @throws as check_output_directory if that is none of the first thousand
std::filesystem::path free_output_directory(const std::filesystem::path& dir, const Scene& scene);

/// Thrown if the watch asked to stop before the first file was in place: no file has been changed.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Writes trajectory.csv, torques.csv if there is a ledger, drift.svg, timing.json and summary.json; creates `dir`. If these
/// results have no ledger, an older torques.csv is removed. All files are first written completely to disk under temporary
/// names: after a failure the old results are intact, and no temporary file and no empty directory is left. While files are
/// being replaced there is no summary.json; if there is one, the other files belong to it, even if the program is killed. If a
/// result is a link, the link is replaced and its target is left alone.
/// @param watch  may stop the writing until the first file is in place, and is informed of its progress
/// @returns the content of summary.json: that of `summary_json`, and checksums of the files
/// @throws as check_output_directory, which it calls; WriteError; Interrupted
std::string write_results(const RunResult& result, const std::filesystem::path& dir, bool force, const Watch& watch = {});

/// The files of a run's results as texts, by their names; without the checksums that the written files have.
using ResultTexts = std::map<std::string, std::string, std::less<>>;
/// Reads the files of a directory, and checks them against their checksums where they have some.
/// @param notes  is given a sentence on each file that has none, and on the directory where its summary has none; may be null
/// @throws ScenarioError if it holds no results, or a file that is not what was written; ReadError
ResultTexts read_result_texts(const std::filesystem::path& dir, std::vector<std::string>* notes = nullptr);
/// Writes files as the other `write_results` does. @param texts  those that `write_results` writes for `scene`
/// @throws as the other
void write_results(const ResultTexts& texts, const Scene& scene, const std::filesystem::path& dir, bool force);

/// The approximate cost of writing, in the seconds of `estimated_seconds`.
double writing_seconds(const Scene& scene);

/// What a run needs at its most, and what it writes: the process's memory, and all files together (bytes). Within a factor of 1.5.
/// A long table is taken to be made row by row, as `earthtop run` does it without --partial.
struct RunSize {
  double memory_bytes = 0, file_bytes = 0;
};
RunSize expected_size(const Scene& scene);
/// A size as a text, e.g. "2.3 GB" or "23 MB".
std::string bytes_text(double bytes);

/// A document of `compare`, `plan` or `bench --json` that was changed, with the checksum that fits it.
/// @param document  a JSON object
std::string resealed(std::string_view document);

/// Writes one file and creates its directory; an old file stays until the new one is complete.   @throws WriteError,
/// Interrupted
void write_file(const std::filesystem::path& file, std::string_view content);
/// The same. @param content  is called while no other process can write files there
void write_file(const std::filesystem::path& file, const std::function<std::string()>& content);

/// Removes the temporary files of a `write_results` in progress, for a program that is about to end; safe in a signal handler.
/// @returns false, without doing anything, at the moment when the files are put in place
bool discard_temporaries() noexcept;

}  // namespace earthtop
