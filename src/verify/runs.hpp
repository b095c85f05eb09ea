// SPDX-License-Identifier: GPL-3.0-or-later
/// The runs behind a scenario's criteria: one of each scene, however many criteria ask for it.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "earthtop/run.hpp"

namespace earthtop::verify_detail {

/// Nothing can be judged, and why: a run that broke off, a scene for which the formula is not made.
class NotJudged : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Changes = std::vector<std::string>;  ///< "/json/pointer=value"

class Runs {
 public:
  explicit Runs(ScenarioSource source) : source_(std::move(source)) {}

  /// @throws ScenarioError where the changed scene is not valid
  Scene scene(const Changes& changes = {}) const;
  /// @throws NotJudged where the run does not complete; ScenarioError
  const RunResult& run(const Changes& changes = {});
  bool has_run(const Changes& changes) const { return done_.contains(changes); }

  /// Who watches what is run from now on.
  void set_watch(const Watch& watch) { watch_ = watch, share_ = 0; }
  const Watch& watch() const { return watch_; }
  /// For the next run: most of what is left of it.
  Watch next_watch();

 private:
  ScenarioSource source_;
  std::map<Changes, RunResult> done_;
  Watch watch_;
  double share_ = 0;  // of `watch_`, begun
};

/// A run to its end. @throws NotJudged
RunResult completed_run(const Scene& scene, const Watch& watch);

}  // namespace earthtop::verify_detail
