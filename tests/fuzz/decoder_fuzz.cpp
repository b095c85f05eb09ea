// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds arbitrary bytes to the decoder. It must accept or refuse them with messages that can be printed, and whatever it
// accepts must be a scenario whose canonical form decodes to itself. Bytes 0x01, which occur in no JSON text, separate the text
// from --set pairs.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/frames/angle_spline.hpp"
#include "earthtop/scene/scene.hpp"
#include "scenario/angle_table.hpp"

namespace {

void demand(bool holds, const char* what, const std::string& shown) {
  if (holds) return;
  std::fprintf(stderr, "BROKEN: %s\n%s\n", what, shown.c_str());
  std::abort();
}

std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  for (;;) {
    const auto end = text.find('\x01');
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// The position is 1-based and not beyond the end of a line.
bool stands_in(std::string_view text, int line, int column) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (line < 1 || column < 1) return false;
  for (int i = 1; i < line; ++i) {
    const auto newline = text.find('\n');
    if (newline == std::string_view::npos) return false;
    text.remove_prefix(newline + 1);
  }
  return static_cast<std::size_t>(column) <= std::min(text.find('\n'), text.size()) + 1;
}

void check_refusal(const earthtop::ScenarioError& error, std::string_view text, bool with_sets) {
  demand(!error.diagnostics().empty() && error.diagnostics().size() <= 21, "1 to 21 diagnostics", error.what());
  for (const earthtop::Diagnostic& diagnostic : error.diagnostics()) {
    const std::string line = format_diagnostic(error.file(), diagnostic);
    demand(line == earthtop::printable(line) && line.find('\n') == std::string::npos, "a line that can be shown", line);
    demand(line.size() < 4000, "a line of bearable length", line);
    demand(!diagnostic.message.empty(), "a message", line);
    const bool from_set = with_sets && diagnostic.line == 0 && diagnostic.column == 0;
    demand(from_set || stands_in(text, diagnostic.line, diagnostic.column), "a place in the text", line);
  }
}

/// The same bytes as a table of angles.
void check_table(std::string_view text) {
  const auto parsed = earthtop::scenario::parse_angle_table(text, 1);
  if (const auto* fault = std::get_if<earthtop::scenario::TableFault>(&parsed)) {
    demand(fault->line > 0 && fault->message == earthtop::printable(fault->message), "a fault that can be shown",
           fault->message);
    return;
  }
  const earthtop::AngleSpline<double> spline(std::get<earthtop::AngleTable>(parsed));
  demand(std::abs(spline.angle_acceleration(0.5)) <= 1e9 * (1 + 1e-9), "an acceleration in bounds", std::string(text));
}

constexpr bool kMayNameFiles = false;  // any bytes may be the name of any file

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = parts_of({reinterpret_cast<const char*>(data), size});
  check_table(parts[0]);
  std::vector<std::pair<std::string, std::string>> sets;
  for (std::size_t i = 2; i < parts.size(); i += 2) sets.emplace_back(parts[i - 1], parts[i]);
  std::string canonical;
  try {
    canonical = canonical_json(earthtop::parse_scenario({"fuzz.json", parts[0], kMayNameFiles}, sets));
  } catch (const earthtop::ScenarioError& error) {
    check_refusal(error, parts[0], !sets.empty());
    return 0;
  }
  try {
    const std::string again = canonical_json(earthtop::parse_scenario({"canonical.json", canonical, kMayNameFiles}));
    demand(again == canonical, "a canonical form that is its own", canonical + "\n" + again);
  } catch (const earthtop::ScenarioError& error) {
    demand(false, "a canonical form that is accepted", canonical + "\n" + error.what());
  }
  return 0;
}
