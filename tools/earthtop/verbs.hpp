/// The verbs, one file each: what the command line gave them, and what they do with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace earthtop::tool {

struct RunArguments {
  std::string scenario;  ///< a file, or "-"
  std::optional<std::string> out;
  bool force = false;
  bool json = false;
  bool quiet = false;
  std::vector<std::string> sets;  ///< each POINTER=VALUE
};

/// Runs a scenario, writes its results, prints their summary. @returns the exit status
/// @throws ScenarioError, WriteError
int run_verb(const RunArguments& arguments);

/// Prints what was built, from what and how. @throws WriteError
int version_verb(bool json);

}  // namespace earthtop::tool
