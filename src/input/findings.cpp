// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/findings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace earthtop::input {
namespace {

struct Position {
  int line;
  int column;
};

Position position(std::size_t offset, std::string_view text) {
  const std::string_view before = text.substr(0, offset);
  const auto newline = before.rfind('\n');
  const auto line_start = newline == std::string_view::npos ? 0 : newline + 1;
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1, static_cast<int>(offset - line_start) + 1};
}

}  // namespace

void Findings::keep(Finding finding) {
  ++count_;
  if (!full()) findings_.push_back(std::move(finding));
}

void Findings::add(Place place, std::string pointer, std::string message) {
  keep({place, std::move(pointer), std::move(message), std::nullopt});
}

void Findings::add_duplicate(Place again, Place first, std::string pointer) { keep({again, std::move(pointer), "", first}); }

void Findings::warn(Place place, std::string pointer, std::string message) {
  warnings_.push_back({place, std::move(pointer), std::move(message), std::nullopt});
}

std::vector<Diagnostic> Findings::report(std::vector<Finding> sorted, std::size_t count, std::string_view kind,
                                         std::string_view text) const {
  std::stable_sort(sorted.begin(), sorted.end(), [](const Finding& a, const Finding& b) {
    if (a.place.from_set != b.place.from_set) return a.place.from_set;
    return !a.place.from_set && a.place.offset < b.place.offset;
  });
  std::vector<Diagnostic> diagnostics;
  for (Finding& finding : sorted) {
    const bool from_set = finding.place.from_set;
    const Position at = from_set ? Position{0, 0} : position(finding.place.offset, text);
    if (diagnostics.size() == kMostDiagnostics) {
      diagnostics.push_back({at.line, at.column, "", fmt::format("{} more {} are not shown", count - kMostDiagnostics, kind)});
      break;
    }
    if (finding.first) {
      const Position first = from_set ? Position{0, 0} : position(finding.first->offset, text);
      finding.message = from_set ? "duplicate key; give it once"
                                 : fmt::format("duplicate key, given already at {}:{}; give it once", first.line, first.column);
    }
    if (from_set && names_option_) finding.message += " (from --set)";
    diagnostics.push_back(shortened({at.line, at.column, std::move(finding.pointer), std::move(finding.message)}));
  }
  return diagnostics;
}

}  // namespace earthtop::input
