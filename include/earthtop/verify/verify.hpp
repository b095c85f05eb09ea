// SPDX-License-Identifier: GPL-3.0-or-later
/// A scenario's criteria, judged: each is knowledge that owes nothing to the run it is held against.
#pragma once

#include <functional>
#include <string>

#include "earthtop/run.hpp"
#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

enum class VerificationOutcome { passed, failed, skipped };

/// One criterion of one scenario.
struct VerificationRow {
  std::string name;       ///< of the scenario
  std::string criterion;  ///< in words
  std::string why;        ///< where value and tolerance come from
  VerificationOutcome outcome = VerificationOutcome::passed;
  double error = 0;    ///< unit of the criterion; infinite where nothing could be judged
  double bound = 0;    ///< the largest error that passes
  double seconds = 0;  ///< processor time; of a run that several rows use the first one has it
  std::string remark;  ///< why nothing could be judged, or it was skipped
};

struct VerificationOptions {
  bool slow = false;  ///< judge criteria, too, that take over a minute
  Watch watch = {};   ///< may stop it, and sees how far it is
};

/// A criterion in words: kind, quantity, times and changes.
std::string criterion_text(const CriterionSpec& criterion);

/// The scenario, and its criteria's scenes examined. @throws ScenarioError where one of them is not valid, or there is no
/// criterion; it says which
Scenario parse_verifiable(const ScenarioSource& source);

/// The seconds that this takes on one core, roughly. @throws ScenarioError as parse_verifiable
double verification_work(const ScenarioSource& source, const VerificationOptions& options);

/// Judges the criteria in their order, each row told as soon as it is known. After an interrupt there are no more.
/// @throws ScenarioError as parse_verifiable
void verify(const ScenarioSource& source, const VerificationOptions& options,
            const std::function<void(const VerificationRow&)>& tell);

}  // namespace earthtop
