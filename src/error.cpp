// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/error.hpp"

#include <fmt/core.h>

#include "text/utf8.hpp"

namespace earthtop {
namespace {

std::string summarize(const std::string& file, const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += format_diagnostic(file, diagnostic);
  }
  return text;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto [code, length] = first_character(text);
    if (length == 0 || (length == 1 && is_unseen(code)))
      shown += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(text[0])));
    else if (is_unseen(code))
      append_escape(code, shown);
    else
      shown += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return shown;
}

ScenarioError::ScenarioError(std::vector<Diagnostic> diagnostics, std::string file)
    : std::runtime_error(summarize(file, diagnostics)), diagnostics_(std::move(diagnostics)), file_(std::move(file)) {}

std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic, std::string_view severity) {
  std::string text;
  if (!file.empty()) {
    text += file;
    text += ':';
    if (diagnostic.line > 0) text += fmt::format("{}:{}:", diagnostic.line, diagnostic.column);
    text += ' ';
  }
  text += fmt::format("{}: ", severity);
  if (!diagnostic.pointer.empty()) text += diagnostic.pointer + ": ";
  return printable(text + diagnostic.message);
}

std::string_view to_string(RunStatus status) {
  switch (status) {
    case RunStatus::completed: return "completed";
    case RunStatus::not_finite: return "not_finite";
    case RunStatus::step_underflow: return "step_underflow";
    case RunStatus::not_converged: return "not_converged";
    case RunStatus::step_limit: return "step_limit";
    case RunStatus::interrupted: return "interrupted";
  }
  return "unknown";
}

}  // namespace earthtop
