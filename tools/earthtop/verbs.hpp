/// The verbs, one file each: a verb adds itself to the command line, and says what is done when it is given.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace earthtop::tool {

/// What the command line asked for. @returns the exit status. @throws ScenarioError, WriteError
using Action = std::function<int()>;

void add_run(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);
void add_bench(CLI::App& app, Action& action);
void add_study(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_schema(CLI::App& app, Action& action);
void add_example(CLI::App& app, Action& action);
void add_completion(CLI::App& app, Action& action);
void add_version(CLI::App& app, Action& action);

/// Prints what was built, from what and how. @throws WriteError
int version_verb(bool json);

/// `--set /json/pointer=VALUE`, any number of times.
void add_set_option(CLI::App& verb, std::vector<std::string>& sets);

/// Pairs of pointer and value. @throws ScenarioError naming every one that has another form
std::vector<std::pair<std::string, std::string>> split_sets(const std::vector<std::string>& sets);

}  // namespace earthtop::tool
