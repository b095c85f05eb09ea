// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "earthtop/results/provenance.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

struct ProgramArguments {
  bool version = false;
  bool json = false;
};

int without_verb(const ProgramArguments& arguments) {
  if (!arguments.version) throw UsageError("a verb is needed, e.g. run; earthtop --help lists all verbs");
  if (arguments.json) return version_verb(true);
  print(fmt::format("earthtop {}\n", build_info().version));
  return kDone;
}

void add_group(Verb& program, std::string_view title, std::vector<Verb> verbs) {
  for (Verb& verb : verbs) {
    verb.group = title;
    program.verbs.push_back(std::move(verb));
  }
}

std::vector<std::string> names_of(const std::vector<Verb>& verbs) {
  std::vector<std::string> names(verbs.size());
  std::transform(verbs.begin(), verbs.end(), names.begin(), [](const Verb& verb) { return verb.name; });
  return names;
}

}  // namespace

std::unique_ptr<const Verb> describe_program() {
  auto arguments = std::make_shared<ProgramArguments>();
  auto program = std::make_unique<Verb>(
      "earthtop",
      "Spinning tops and gyroscopes in a laboratory that turns with the Earth: how far does the Earth's rotation make "
      "them drift?",
      [arguments] { return without_verb(*arguments); });
  program->add("--version", &arguments->version, "print the version").abbreviated("-V");
  program->add("--json", &arguments->json, "with --version: print what earthtop version --json prints");
  program->describe(
      "Predicts how a top or gyroscope of any shape moves in a laboratory that turns with the Earth, how it would move if the "
      "Earth stood still, and how far the two motions drift apart, with a bound on the error of that number. "
      "A scenario, which is a JSON file, says what is to be predicted.");
  program->example("earthtop example foucault-pendulum | earthtop run -", "runs a scenario that comes with the program");
  program->example("earthtop example > top.json", "writes a scenario to begin with, which explains every key");
  program->example("earthtop check top.json", "lists what is wrong with it");
  program->example("earthtop run top.json", "predicts the motion and the drift");
  for (const StatusMeaning& status : kExitStatuses) program->ends_with(status.status, status.meaning);
  add_group(*program, "Write a scenario", {describe_example(), describe_check(), describe_schema()});
  add_group(*program, "Predict a motion and its drift",
            {describe_run(), describe_explain(), describe_study(), describe_report(), describe_gallery()});
  add_group(*program, "Measure, and compare results", {describe_plan(), describe_compare()});
  add_group(*program, "Judge the program", {describe_verify(), describe_bench()});
  std::vector<std::string> names = names_of(program->verbs);
  names.insert(names.end(), {"help", "man", "completion", "version"});
  add_group(*program, "About the program",
            {describe_help(*program, names), describe_man(*program, names), describe_completion(*program), describe_version()});
  return program;
}

}  // namespace earthtop::tool
