// SPDX-License-Identifier: GPL-3.0-or-later
/// The runs behind a scenario's criteria: each changed scene is run only once, however many criteria need it.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop::verify_detail {

/// Thrown if a criterion cannot be judged, with the reason: e.g. a run ended early, or the formula does not apply to the scene.
class NotJudged : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Changes = std::vector<std::string>;  ///< "/json/pointer=value"

class Runs {
 public:
  explicit Runs(ScenarioSource source) : source_(std::move(source)) {}

  /// @throws ScenarioError if the changed scene is not valid
  Scene scene(const Changes& changes = {}) const;
  /// @throws NotJudged if the run does not complete; ScenarioError
  const RunResult& run(const Changes& changes = {});
  bool has_run(const Changes& changes) const { return done_.contains(changes); }

  /// Sets the watch of the following runs.
  void set_watch(const Watch& watch) { watch_ = watch, share_ = 0; }
  const Watch& watch() const { return watch_; }
  /// The watch for the next run: it gets most of the remaining part of `watch_`.
  Watch next_watch();

 private:
  ScenarioSource source_;
  std::map<Changes, RunResult> done_;
  Watch watch_;
  double share_ = 0;  // part of `watch_` that has been given away
};

/// Runs a scenario to its end.   @throws NotJudged if it does not get there
RunResult completed_run(const Scene& scene, const Watch& watch);

}  // namespace earthtop::verify_detail
