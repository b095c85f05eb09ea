// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/whitening.hpp"

#include <fmt/core.h>

#include <cmath>
#include <map>
#include <string_view>

#include "measure/measured_motion.hpp"

namespace earthtop::measure {

Whitening::Whitening(const std::vector<MeasurementResidual>& residuals, double tau_s, const std::string& file) {
  std::map<std::string_view, std::size_t> latest;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const MeasurementResidual& residual = residuals[i];
    Link link;
    link.period = period_of(residual) / residual.standard_error;
    const auto [place, is_first] = latest.try_emplace(residual.quantity, i);
    if (!is_first) {
      const MeasurementResidual& before = residuals[place->second];
      link.before = place->second;
      link.memory = error_memory(residual.t_s - before.t_s, tau_s);
      if (!(link.memory.fresh > 0)) {
        const std::string message = fmt::format(
            "{} at {:.9g} s is on line {} too: with a correlation time, both would have the same error; keep one, or their "
            "mean",
            residual.quantity, residual.t_s, before.line);
        throw ScenarioError(std::vector<Diagnostic>{{static_cast<int>(residual.line), 1, "", message}}, file);
      }
      place->second = i;
    }
    links_.push_back(link);
  }
}

void Whitening::append(const Whitening& other) {
  const std::size_t before = links_.size();
  for (Link link : other.links_) {
    if (link.before) *link.before += before;
    links_.push_back(link);
  }
}

void Whitening::whiten(Eigen::VectorXd& normalised) const {
  if (links_.empty()) return;
  Eigen::VectorXd unfolded = normalised;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    if (!link.before) continue;
    const auto at = static_cast<Eigen::Index>(i), before = static_cast<Eigen::Index>(*link.before);
    const double expected = link.memory.rho * unfolded[before];
    double fresh = unfolded[at] - expected;
    if (link.period > 0 && std::abs(fresh) > link.period / 2) {
      fresh = std::remainder(fresh, link.period);
      unfolded[at] = expected + fresh;
    }
    normalised[at] = fresh / link.memory.fresh;
  }
}

void Whitening::whiten_derivative(Eigen::VectorXd& derivative) const {
  for (std::size_t i = links_.size(); i-- > 0;) {  // backwards: the value before it is still as it was
    const Link& link = links_[i];
    if (!link.before) continue;
    double& value = derivative[static_cast<Eigen::Index>(i)];
    value = (value - link.memory.rho * derivative[static_cast<Eigen::Index>(*link.before)]) / link.memory.fresh;
  }
}

}  // namespace earthtop::measure
