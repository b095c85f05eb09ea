// SPDX-License-Identifier: GPL-3.0-or-later
/// Judges the criteria of a scenario. Each criterion is knowledge that is independent of the run that is compared with it.
#pragma once

#include <functional>
#include <string>

#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

enum class VerificationOutcome { passed, failed, skipped };

/// The result of one criterion of one scenario.
struct VerificationRow {
  std::string name;       ///< name of the scenario
  std::string criterion;  ///< the criterion in words
  std::string why;        ///< the source of value and tolerance
  VerificationOutcome outcome = VerificationOutcome::passed;
  double error = 0;    ///< in the unit of the criterion; infinite if nothing could be judged
  double bound = 0;    ///< the largest error that passes
  double seconds = 0;  ///< processor time; a run that several rows share is counted in the first one
  std::string remark;  ///< why nothing could be judged, or why it was skipped
};

struct VerificationOptions {
  bool slow = false;  ///< judge criteria, too, that take over a minute
  Watch watch = {};   ///< may stop it, and sees how far it is
};

/// A criterion in words: kind, quantity, times and changes.
std::string criterion_text(const CriterionSpec& criterion);

/// The scenario, after a check of all scenes that its criteria make.   @throws ScenarioError if one of them is not valid (it
/// says which), or if there is no criterion
Scenario parse_verifiable(const ScenarioSource& source);

/// The approximate cost of the verification, in the seconds of `estimated_seconds`.   @throws ScenarioError as parse_verifiable
double verification_work(const ScenarioSource& source, const VerificationOptions& options);

/// Judges the criteria in their order and calls `tell` with each row as soon as it is known. After the watch has asked to stop
/// no further row is reported.
/// @throws ScenarioError as parse_verifiable
void verify(const ScenarioSource& source, const VerificationOptions& options,
            const std::function<void(const VerificationRow&)>& tell);

}  // namespace earthtop
