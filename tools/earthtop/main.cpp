// SPDX-License-Identifier: GPL-3.0-or-later
/// The earthtop program: reads the command line and calls the verb.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "command_line.hpp"
#include "earthtop/arithmetic.hpp"
#include "earthtop/error.hpp"
#include "exhaustion.hpp"
#include "help_text.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "program.hpp"
#include "screen.hpp"

namespace earthtop::tool {

static bool wants_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const char* argument) { return std::string_view(argument) == "--json"; });
}

namespace {

int usage_error(const UsageError& error, bool json) {
  const int status = report_errors("", {{0, 0, "", error.what()}}, json, kRefused);
  if (!json) message("Try: " + error.path() + " --help");
  return status;
}

int report_unexpected(const std::exception& error, bool json) {
  return report_errors("", {{0, 0, "", plain_words(error)}}, json, kNumericalFailure);
}

int parse_and_do(int argc, char** argv, bool json) {
  const auto program = describe_program();
  try {
    const Request request = read_command_line(*program, argc, argv);
    if (!request.is_for_help) return request.named.verb.action();
    print(help_text(request.named, output_screen().width));
    return kDone;
  } catch (const UsageError& error) {
    return usage_error(error, json);
  }
}

int guarded_main(int argc, char** argv) {
  const bool json = wants_json(argc, argv);
  try {
    require_ieee_arithmetic();
    return parse_and_do(argc, argv, json);
  } catch (const ScenarioError& error) {
    return report_errors(error.file(), error.diagnostics(), json, kRefused);
  } catch (const ReadError& error) {
    return report_errors(error.file(), {{0, 0, "", error.reason()}}, json, kWriteFailed);
  } catch (const WriteError& error) {
    // If standard output failed, the error is not reported there.
    const bool lost = error.file() == kStandardOutput;
    const char* remedy = lost ? "" : "; check space and permissions there, or choose another place";
    return report_errors(error.file(), {{0, 0, "", error.reason() + remedy}}, json && !lost, kWriteFailed);
  } catch (const ArithmeticError& error) {
    return report_errors("", {{0, 0, "", error.what()}}, json, kNumericalFailure);
  } catch (const ReaderGone&) {
    throw;
  } catch (const std::bad_alloc&) {
    return report_lacking(Lacking::memory);
  } catch (const std::filesystem::filesystem_error& error) {
    if (error.code() == std::errc::not_enough_memory) return report_lacking(Lacking::memory);
    return report_errors(error.path1().string(), {{0, 0, "", error.code().message()}}, json, kWriteFailed);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) return report_lacking(Lacking::threads);
    if (error.code() == std::errc::not_enough_memory) return report_lacking(Lacking::memory);
    return report_unexpected(error, json);
  } catch (const std::exception& error) {
    return report_unexpected(error, json);
  }
}

}  // namespace
}  // namespace earthtop::tool

int main(int argc, char** argv) {
  using namespace earthtop::tool;
  prepare_streams();
  try {
    const bool json = wants_json(argc, argv);
    prepare_for_exhaustion(json);
    if (!make_room_on_stack()) return kNumericalFailure;
    install_stop_handlers(json);
    return guarded_main(argc, argv);
  } catch (const ReaderGone&) {
    return end_quietly();
  } catch (const std::bad_alloc&) {  // there was no memory for another error's message, either
    return report_lacking(Lacking::memory);
  } catch (const std::exception& error) {  // even reporting an error failed
    message("earthtop: error: " + earthtop::plain_words(error));
    return kWriteFailed;
  }
}
