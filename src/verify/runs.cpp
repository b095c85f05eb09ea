#include "verify/runs.hpp"

#include <fmt/format.h>

namespace earthtop::verify_detail {

Scenario Runs::scenario(const Changes& changes) const {
  std::vector<std::pair<std::string, std::string>> overrides;
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    overrides.emplace_back(change.substr(0, equals), change.substr(equals + 1));
  }
  return parse_scenario(source_, overrides);
}

const RunResult& Runs::run(const Changes& changes) {
  const auto found = done_.find(changes);
  return found != done_.end() ? found->second : done_.emplace(changes, completed_run(scenario(changes))).first->second;
}

RunResult completed_run(const Scenario& scenario) {
  RunResult result = earthtop::run(scenario);
  if (result.status == RunStatus::completed) return result;
  throw NotJudged(fmt::format("the run ended at t = {} s: {}", result.reached_s, to_string(result.status)));
}

}  // namespace earthtop::verify_detail
