// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <memory>

#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ProgramArguments {
  bool version = false;
  bool json = false;
};

int without_verb(const ProgramArguments& arguments, const Verb& program) {
  if (arguments.version) return version_verb(arguments.json);
  std::string names;
  for (const Verb& verb : program.verbs) names += (names.empty() ? "" : ", ") + verb.name;
  throw UsageError("a verb is needed: " + names);
}

}  // namespace

std::unique_ptr<const Verb> describe_program() {
  auto arguments = std::make_shared<ProgramArguments>();
  auto program = std::make_unique<Verb>(
      "earthtop",
      "Spinning tops and gyroscopes in a laboratory that turns with the Earth: how far does the Earth's rotation make "
      "them drift?",
      nullptr);
  const Verb& itself = *program;
  program->action = [arguments, &itself] { return without_verb(*arguments, itself); };
  program->add("--version", &arguments->version, "what was built, from what and how");
  program->add("--json", &arguments->json, "with --version: as one JSON document");
  program->describe(
      "Predicts how a top or gyroscope of any shape moves in a laboratory that turns with the Earth, how it would move if the "
      "Earth stood still, and how far the two drift apart, with a bound on the error of that number. "
      "What is predicted stands in a scenario, a JSON file.");
  program->example("earthtop example > top.json", "begins with a scenario that explains itself");
  program->example("earthtop check top.json", "tells what is wrong with it");
  program->example("earthtop run top.json", "predicts the motion and the drift");
  program->verbs = {describe_run(),    describe_check(),  describe_explain(), describe_verify(),
                    describe_bench(),  describe_study(),  describe_compare(), describe_plan(),
                    describe_report(), describe_schema(), describe_example(), describe_completion(itself),
                    describe_version()};
  std::vector<std::string> names;
  for (const Verb& verb : program->verbs) names.push_back(verb.name);
  names.insert(names.end() - 1, "man");
  program->verbs.insert(program->verbs.end() - 1, describe_man(itself, names));
  return program;
}

}  // namespace earthtop::tool
