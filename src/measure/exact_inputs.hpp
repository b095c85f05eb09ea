// SPDX-License-Identifier: GPL-3.0-or-later
/// Which inputs a fit takes as exact, and the shifts of its estimates by their errors.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "earthtop/measure/exact_input.hpp"
#include "measure/joint_inputs.hpp"

namespace earthtop::measure {

/// The fitted inputs of a scene and, behind them, those that could be fitted besides them and are taken as exact: the inputs that
/// may have a standard error, the azimuth at release, and the other component of the Earth's rate.
class ExactInputs {
 public:
  static constexpr std::size_t kMost = 64;  ///< names that `inputs_of` has to take

  using InputsOf = std::function<EstimatedInputs(const std::vector<std::string>&)>;

  /// @param inputs_of  makes inputs of names, or throws a ScenarioError
  ExactInputs(const Scene& scene, const std::vector<std::string>& fitted, const InputsOf& inputs_of);

  /// Fitted inputs and exact ones; the latter begin at `fitted()`.
  const EstimatedInputs& all() const { return all_; }
  std::size_t fitted() const { return fitted_; }
  /// The standard error of an exact input as the scenario states it, and an error of it that is not unusual, in its unit.
  struct Knowledge {
    std::optional<double> stated;
    double usual = 0;
  };
  /// @param input  place in `all`
  const Knowledge& knowledge(std::size_t input) const { return knowledge_[input - fitted_]; }

 private:
  EstimatedInputs all_;
  std::size_t fitted_;
  std::vector<Knowledge> knowledge_;
};

/// The fitted inputs of all releases and, behind them, those that are taken as exact.
class JointExactInputs {
 public:
  /// @param releases  must live as long as this   @param shared  as for JointInputs
  JointExactInputs(const std::vector<ExactInputs>& releases, const std::vector<std::string>& shared);

  const JointInputs& all() const { return all_; }
  std::size_t fitted() const { return all_.fitted(); }
  std::size_t exact() const { return all_.list().size() - all_.fitted(); }
  /// Each release's inputs, fitted and exact.
  const std::vector<const EstimatedInputs*>& of_releases() const { return of_releases_; }

  /// The exact inputs whose errors shift a fitted one by its standard error where they are below the input's scale. Those come first
  /// that shift it most: by an error as stated, or else by a thousandth of the scale.
  /// @param J       derivatives of normalised residuals (rows), those of priors included, by all inputs in their scales
  /// @param fitted  place of the fitted one
  std::vector<ExactInput> shifting(const Eigen::MatrixXd& J, std::size_t fitted) const;

 private:
  std::vector<const EstimatedInputs*> of_releases_;
  JointInputs all_;
  std::vector<ExactInputs::Knowledge> knowledge_;
};

}  // namespace earthtop::measure
