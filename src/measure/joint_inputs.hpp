// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers of a fit of one release or of several: those that all releases share, and each release's own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measure/estimated_inputs.hpp"

namespace earthtop::measure {

struct JointInput : EstimatedInput {
  std::size_t release = 0;  ///< whose number it is, counted from 1; 0: that of all
};

/// Whether an input of two scenarios is one number, for all that they say: no number of the release or of the instrument, and the
/// same in both.
bool is_common(const EstimatedInput& first, const EstimatedInput& other);

class JointInputs {
 public:
  /// @param releases  each release's inputs   @param fitted  the number of each that are fitted, the first ones
  /// @param shared  names of fitted inputs that have one value in all releases. The inputs behind the fitted ones are shared where
  /// they are common.
  /// @throws ScenarioError for a shared input that the scenarios do not start with the same value
  JointInputs(const std::vector<const EstimatedInputs*>& releases, const std::vector<std::size_t>& fitted,
              const std::vector<std::string>& shared);

  /// The fitted inputs, and behind them the others.
  const std::vector<JointInput>& list() const { return list_; }
  std::size_t fitted() const { return fitted_; }
  /// The places in the list of a release's inputs.
  const std::vector<std::size_t>& places(std::size_t release) const { return places_[release]; }
  /// A release's values, out of those of the list.
  std::vector<double> values_of(std::size_t release, const std::vector<double>& values) const;

 private:
  std::vector<JointInput> list_;
  std::size_t fitted_ = 0;
  std::vector<std::vector<std::size_t>> places_;
};

}  // namespace earthtop::measure
