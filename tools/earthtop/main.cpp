/// The earthtop program: reads the command line and hands over to a verb.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "earthtop/arithmetic.hpp"
#include "earthtop/results/results.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace earthtop::tool {

static bool wants_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const char* argument) { return std::string_view(argument) == "--json"; });
}

namespace {

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

  Action action;
  for (const auto& add_verb : {add_run, add_check, add_explain, add_verify, add_bench, add_study, add_compare, add_report,
                               add_schema, add_example, add_completion, add_version})
    add_verb(app, action);

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(app.help());  // of the verb, if there is one
    return kDone;
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), wants_json(argc, argv));
  }
  if (action) return action();
  if (version) return version_verb(version_json);
  std::string verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs += (verbs.empty() ? "" : ", ") + verb->get_name();
  return usage_error("a verb is needed: " + verbs, wants_json(argc, argv));
}

int guarded_main(int argc, char** argv) {
  const bool json = wants_json(argc, argv);
  try {
    require_ieee_arithmetic();
    return parse_and_do(argc, argv);
  } catch (const ScenarioError& error) {
    return report_errors(error.file(), error.diagnostics(), json, kRefused);
  } catch (const ReadError& error) {
    return report_errors(error.file(), {{0, 0, "", error.reason()}}, json, kWriteFailed);
  } catch (const WriteError& error) {
    // What cannot reach standard output is not tried there again.
    const bool lost = error.file() == kStandardOutput;
    const char* remedy = lost ? "" : "; see to space and permission there, or choose another place";
    return report_errors(error.file(), {{0, 0, "", error.reason() + remedy}}, json && !lost, kWriteFailed);
  } catch (const ArithmeticError& error) {
    return report_errors("", {{0, 0, "", error.what()}}, json, kNumericalFailure);
  } catch (const ReaderGone&) {
    throw;
  } catch (const std::bad_alloc&) {
    return report_errors("", {{0, 0, "", "out of memory; take fewer rows (a longer output_step_s, no ledger)"}}, json,
                         kNumericalFailure);
  } catch (const std::exception& error) {
    return report_errors("", {{0, 0, "", fmt::format("unexpected: {}", error.what())}}, json, kNumericalFailure);
  }
}

}  // namespace
}  // namespace earthtop::tool

int main(int argc, char** argv) {
  earthtop::tool::prepare_streams();
  try {
    earthtop::tool::install_stop_handlers(earthtop::tool::wants_json(argc, argv));
    return earthtop::tool::guarded_main(argc, argv);
  } catch (const earthtop::tool::ReaderGone&) {
    return earthtop::tool::end_quietly();
  } catch (const std::exception& error) {  // reporting an error failed, too
    earthtop::tool::message(std::string("earthtop: error: ") + error.what());
    return earthtop::tool::kWriteFailed;
  }
}
