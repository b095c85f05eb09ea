/// The earthtop program: reads the command line and hands over to a verb.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "earthtop/results/results.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {
namespace {

/// Verbs that have a name already, and nothing behind it.
constexpr std::array<std::string_view, 10> kNotAvailable = {"check",   "explain", "bench",  "verify",  "study",
                                                            "compare", "report",  "schema", "example", "completion"};

bool wants_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const char* argument) { return std::string_view(argument) == "--json"; });
}

int usage_error(const std::string& what, bool json) {
  const int status = report_errors("", {{0, 0, "", what}}, json, kRefused);
  if (!json) message("Try: earthtop --help");
  return status;
}

int parse_and_do(int argc, char** argv) {
  CLI::App app(
      "Spinning tops and gyroscopes in a laboratory that turns with the Earth: how far does the Earth's rotation make "
      "them drift?",
      "earthtop");
  app.require_subcommand(0, 1);
  bool version = false;
  bool version_json = false;
  app.add_flag("--version", version, "what was built, from what and how");
  app.add_flag("--json", version_json, "with --version: as one JSON document");

  RunArguments run_arguments;
  CLI::App* run = app.add_subcommand("run", "predict a top's motion with and without the Earth's rotation, and its drift");
  run->add_option("SCENARIO", run_arguments.scenario, "scenario file (JSON); - is standard input")->required();
  run->add_option("--out", run_arguments.out, "directory of the results; default: out/<name>")->type_name("DIR");
  run->add_flag("--force", run_arguments.force, "overwrite the results of another scenario");
  run->add_flag("--json", run_arguments.json, "print the summary as one JSON document, errors too");
  run->add_flag("--quiet", run_arguments.quiet, "print nothing but errors (and what --json asks for)");
  run->add_option("--set", run_arguments.sets, "change one value of the scenario, e.g. /site/latitude_deg=60; may be repeated")
      ->type_name("/POINTER=VALUE")
      ->allow_extra_args(false);

  bool verb_json = false;
  CLI::App* version_command = app.add_subcommand("version", "what was built, from what and how");
  version_command->add_flag("--json", verb_json, "as one JSON document");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(app.help());  // of the verb, if there is one
    return kDone;
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), wants_json(argc, argv));
  }
  if (run->parsed()) return run_verb(run_arguments);
  if (version || version_command->parsed()) return version_verb(version_json || verb_json);
  return usage_error("a verb is needed: run, version", wants_json(argc, argv));
}

int guarded_main(int argc, char** argv) {
  const bool json = wants_json(argc, argv);
  if (argc > 1 && std::find(kNotAvailable.begin(), kNotAvailable.end(), argv[1]) != kNotAvailable.end())
    return usage_error(fmt::format("{}: not available in this version", argv[1]), json);
  try {
    return parse_and_do(argc, argv);
  } catch (const ScenarioError& error) {
    return report_errors(error.file(), error.diagnostics(), json, kRefused);
  } catch (const WriteError& error) {
    // What cannot reach standard output is not tried there again.
    const bool lost = error.file() == kStandardOutput;
    return report_errors(error.file(), {{0, 0, "", error.reason()}}, json && !lost, kWriteFailed);
  } catch (const std::bad_alloc&) {
    return report_errors("", {{0, 0, "", "out of memory"}}, json, kNumericalFailure);
  } catch (const std::exception& error) {
    return report_errors("", {{0, 0, "", fmt::format("unexpected: {}", error.what())}}, json, kNumericalFailure);
  }
}

}  // namespace
}  // namespace earthtop::tool

int main(int argc, char** argv) {
  earthtop::tool::prepare_streams();
  try {
    return earthtop::tool::guarded_main(argc, argv);
  } catch (const std::exception& error) {  // reporting an error failed, too
    earthtop::tool::message(std::string("earthtop: error: ") + error.what());
    return earthtop::tool::kWriteFailed;
  }
}
