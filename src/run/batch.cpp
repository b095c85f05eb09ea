#include "earthtop/run_batch.hpp"

namespace earthtop {

std::vector<BatchOutcome> run_batch(std::span<const Scenario> scenarios) {
  std::vector<BatchOutcome> outcomes(scenarios.size());
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    try {
      outcomes[i].result = run(scenarios[i]);
    } catch (const ScenarioError& refusal) {
      outcomes[i].refusal = refusal.what();
    }
  }
  return outcomes;
}

}  // namespace earthtop
