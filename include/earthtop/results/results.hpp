// SPDX-License-Identifier: GPL-3.0-or-later
/// The result files of a run: trajectory.csv, torques.csv where a ledger was asked for, drift.svg, timing.json, summary.json.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "earthtop/plot/plot.hpp"
#include "earthtop/run.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// One header line and one line for each row; shortest numbers that read back to the same bits (of float128 34 digits; times
/// are doubles in every precision), in SI units and rad. A value that is absent or not finite is an empty field.
std::string trajectory_csv(const RunResult& result);

/// The ledger's columns in its observer's axes (N m), written like the trajectory; the header alone if there is no ledger.
std::string torques_csv(const RunResult& result);

/// The drift's main numbers (rad) with all digits of the run's precision: 34 of float128.
struct DriftDigits {
  std::string axis_final_rad, axis_max_rad, attitude_final_rad, spin_final_rad;
};
/// None for a run in double, and for one without rows.
std::optional<DriftDigits> drift_digits(const RunResult& result);

/// Everything about a run but its rows and its wall time, as JSON with a final newline. The same result gives the same
/// bytes, on any host and at any time; a number that is not finite is null.
std::string summary_json(const RunResult& result);

/// The effect budget of a scene, and what `run` would take for it, as JSON with a final newline.
std::string budget_json(const Budget& budget, const Scene& scene);

/// The matching rule in words: what is equal at release in both predictions.
std::string matching_rule(const Scenario& scenario);

/// What no two runs share: wall seconds, date (UTC) and host, as JSON with a final newline.
std::string timing_json(const RunResult& result);

/// The drift over time: the angle between the two axes with its error bound, and its azimuth and tilt parts.
Figure drift_figure(const RunResult& result);

/// Whether a scene's results may be written to `dir`, which need not exist; asked before a run, so that nothing is
/// computed in vain. @param force  overwrite the results of another scenario, too.
/// @throws ScenarioError where `dir` cannot be a directory, or holds another scenario's results or a file of the same name
/// that is not known to be a result. @throws WriteError where `dir` cannot be written to.
void check_output_directory(const std::filesystem::path& dir, const Scene& scene, bool force);

/// The watch asked to stop before the first file was in place: nothing has changed.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Writes trajectory.csv, torques.csv if there is a ledger, drift.svg, timing.json and summary.json; makes `dir`. A torques.csv
/// of older results that these do not have is removed. Every file is complete on disk under a temporary name before anything
/// changes: after a failure the old results are intact, and no temporary and no empty directory are left. While files are
/// replaced there is no summary.json: where it is, the others belong to it, even if the program is killed. Where a result is a
/// link, the link is replaced and what it leads to is left alone.
/// @param watch  may stop it until the first file is in place, and sees how far it is
/// @throws as check_output_directory, which it calls; WriteError; Interrupted.
void write_results(const RunResult& result, const std::filesystem::path& dir, bool force, const Watch& watch = {});
/// The seconds that this takes, roughly.
double writing_seconds(const Scenario& scenario);

/// Writes one file, making its directory; the old one stays until the new one is whole. @throws WriteError, Interrupted
void write_file(const std::filesystem::path& file, std::string_view content);

/// Removes the temporaries of a `write_results` that is under way, for a program about to end; safe in a signal handler.
/// @returns false, and does nothing, in the moment in which files are put in place
bool discard_temporaries() noexcept;

}  // namespace earthtop
