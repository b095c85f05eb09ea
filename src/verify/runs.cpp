// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/runs.hpp"

#include <fmt/core.h>

#include "text/number_words.hpp"

namespace earthtop::verify_detail {

Scene Runs::scene(const Changes& changes) const {
  std::vector<std::pair<std::string, std::string>> overrides;
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    overrides.emplace_back(change.substr(0, equals), change.substr(equals + 1));
  }
  return parse_scene(source_, overrides);
}

const RunResult& Runs::run(const Changes& changes) {
  const auto found = done_.find(changes);
  return found != done_.end() ? found->second
                              : done_.emplace(changes, completed_run(scene(changes), next_watch())).first->second;
}

Watch Runs::next_watch() {
  constexpr double kShareOfTheRest = 0.7;
  const double begun = share_;
  share_ += kShareOfTheRest * (1 - share_);
  return watch_.part(begun, share_);
}

RunResult completed_run(const Scene& scene, const Watch& watch) {
  RunResult result = earthtop::run(scene, {watch, false});
  if (result.status == RunStatus::completed) return result;
  throw NotJudged(fmt::format("the run ended at t = {}: {}", time_text(result.reached_s), to_string(result.status)));
}

}  // namespace earthtop::verify_detail
