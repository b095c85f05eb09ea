// SPDX-License-Identifier: GPL-3.0-or-later
// The engine's doors for JavaScript: a scenario's text in, the results as one JSON text out. No exception leaves it.
#include <emscripten.h>
#include <fmt/format.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/error.hpp"
#include "earthtop/results/provenance.hpp"
#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"
#include "pictures.hpp"
#include "run/playable.hpp"
#include "text/json.hpp"

namespace earthtop::play {
namespace {

std::string json_string(std::string_view text) { return written_replacing(nlohmann::ordered_json(std::string(text))); }

/// A message says first what is wrong, and after the semicolon what is allowed or what to do.
std::string error_json(const Diagnostic& error) {
  const std::size_t cut = error.message.find("; ");
  const std::string_view message = error.message;
  std::string place = error.pointer;
  if (error.line > 0) place += fmt::format("{}line {}, column {}", place.empty() ? "" : ", ", error.line, error.column);
  return fmt::format(R"({{"message":{},"place":{},"remedy":{}}})", json_string(message.substr(0, cut)), json_string(place),
                     json_string(cut == message.npos ? "" : message.substr(cut + 2)));
}
/// The first error, and the list of all.
std::string errors_json(const std::vector<Diagnostic>& errors) {
  std::string list;
  for (const Diagnostic& error : errors) list += (list.empty() ? "" : ",") + error_json(error);
  return fmt::format(R"({{"error":{},"errors":[{}]}})", error_json(errors.front()), list);
}
std::string errors_json(std::string message) { return errors_json({{0, 0, "", std::move(message)}}); }

/// The table of a CSV text column by column: numbers as they are written, an empty cell as null, a word as a string.
std::string columns_json(std::string_view csv) {
  std::vector<std::string> columns;
  bool is_header = true;
  while (!csv.empty()) {
    const std::size_t end = csv.find('\n');
    std::string_view line = csv.substr(0, end);
    csv.remove_prefix(end + 1);
    for (std::size_t i = 0;; ++i) {
      const std::size_t comma = line.find(',');
      const std::string_view cell = line.substr(0, comma);
      const bool is_number = !cell.empty() && (cell[0] == '-' || (cell[0] >= '0' && cell[0] <= '9'));
      if (is_header) {
        columns.push_back(json_string(cell) + ":[");
      } else {
        if (columns[i].back() != '[') columns[i] += ',';
        columns[i] += cell.empty() ? "null" : is_number ? cell : json_string(cell);
      }
      if (comma == line.npos) break;
      line.remove_prefix(comma + 1);
    }
    is_header = false;
  }
  std::string json = "{";
  for (const std::string& column : columns) json += (json.size() > 1 ? "," : "") + column + "]";
  return json + "}";
}

std::string run_json(std::string_view scenario) {
  const ScenarioReport report = examine_scenario({"scenario", std::string(scenario), false});
  if (!report.scene) return errors_json(report.errors);
  if (std::string reason = unplayable(*report.scene); !reason.empty()) return errors_json(std::move(reason));
  const RunResult result = run(*report.scene);
  std::string summary = summary_json(result);
  while (!summary.empty() && summary.back() == '\n') summary.pop_back();
  std::string warnings;
  for (const Diagnostic& warning : report.warnings) warnings += (warnings.empty() ? "" : ",") + error_json(warning);
  return fmt::format(R"({{"summary":{},"columns":{},{},"warnings":[{}]}})", summary, columns_json(trajectory_csv(result)),
                     pictures_json(result, summary), warnings);
}

/// Why the page does not run a scenario, as an error; empty if it does.
std::string refusal_json(std::string_view scenario) {
  const ScenarioReport report = examine_scenario({"scenario", std::string(scenario), false});
  if (!report.scene) return errors_json(report.errors);
  std::string reason = unplayable(*report.scene);
  return reason.empty() ? "" : errors_json(std::move(reason));
}

/// The answer to what the page asks for, or the error that came of it.
template <class Function>
const char* kept(Function&& answer) {
  static std::string text;
  try {
    text = answer();
  } catch (const ScenarioError& error) {
    text = errors_json(error.diagnostics());
  } catch (const std::bad_alloc&) {
    text = errors_json(
        "the page's memory is too small for this run; ask for fewer rows, or run it with the program, earthtop run");
  } catch (const std::exception& error) {
    text = errors_json(plain_words(error));
  } catch (...) {
    text = errors_json("an unknown error");
  }
  return text.c_str();
}

}  // namespace
}  // namespace earthtop::play

extern "C" {

/// Runs a scenario. @returns {"summary": ..., "columns": {...}, "chart": {...}, "motion": {...}, "warnings": [...]} or
/// {"error": ..., "errors": [...]}; valid until the next call
EMSCRIPTEN_KEEPALIVE const char* earthtop_run(const char* scenario_json) {
  return earthtop::play::kept([&] { return earthtop::play::run_json(scenario_json); });
}

/// @returns nothing if the page runs a scenario, else {"error": ..., "errors": [...]}; valid until the next call
EMSCRIPTEN_KEEPALIVE const char* earthtop_refusal(const char* scenario_json) {
  return earthtop::play::kept([&] { return earthtop::play::refusal_json(scenario_json); });
}

EMSCRIPTEN_KEEPALIVE const char* earthtop_version() {
  return earthtop::play::kept([] {
    const earthtop::BuildInfo& info = earthtop::build_info();
    return std::string(info.version) + " (" + std::string(info.commit) + ")";
  });
}
}
