#include "earthtop/error.hpp"

#include <fmt/format.h>

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

std::string escape_control_characters(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f)
      escaped += fmt::format("\\x{:02x}", byte);
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace

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
  return escape_control_characters(text + diagnostic.message);
}

std::string_view to_string(RunStatus status) {
  switch (status) {
    case RunStatus::completed: return "completed";
    case RunStatus::not_finite: return "not_finite";
    case RunStatus::step_underflow: return "step_underflow";
    case RunStatus::step_limit: return "step_limit";
    case RunStatus::interrupted: return "interrupted";
  }
  return "unknown";
}

}  // namespace earthtop
