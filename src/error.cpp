// SPDX-License-Identifier: GPL-3.0-or-later
#include "earthtop/error.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <new>
#include <system_error>
#include <type_traits>

#include "earthtop/arithmetic.hpp"
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

std::vector<Diagnostic> all_shortened(std::vector<Diagnostic> diagnostics) {
  for (Diagnostic& diagnostic : diagnostics) diagnostic = shortened(std::move(diagnostic));
  return diagnostics;
}

/// Appends the printable form of a text's first character. @returns the character's length in the text (bytes)
std::size_t append_printable(std::string_view text, std::string& shown) {
  const auto [code, length] = first_character(text);
  if (length == 0 || (length == 1 && is_unseen(code)))
    shown += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(text[0])));
  else if (is_unseen(code))
    append_escape(code, shown);
  else
    shown += text.substr(0, length);
  return length == 0 ? 1 : length;
}

/// The length of an escape at the beginning of a text, \xNN, \uNNNN, ~0 or ~1; 0 if there is none.
std::size_t escape_length(std::string_view text) {
  if (text.starts_with("~0") || text.starts_with("~1")) return 2;
  const std::size_t length = text.starts_with("\\u") ? 6 : text.starts_with("\\x") ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  const bool has_digits = text.substr(2, length - 2).find_first_not_of("0123456789abcdef") == text.npos;
  return has_digits ? length : 0;
}

/// Appends the printable form of a text's first part: an escape, or a character. @returns the part's length in the text (bytes)
std::size_t append_part(std::string_view text, std::string& shown) {
  const std::size_t length = escape_length(text);
  if (length == 0) return append_printable(text, shown);
  shown += text.substr(0, length);
  return length;
}

constexpr std::string_view kCut = "...";

/// The end of a text whose printable form has at most `most` bytes, with "..." before it if something was cut.
std::string end_of(std::string_view text, std::size_t most) {
  std::size_t width = printable(text).size();
  if (width <= most) return std::string(text);
  for (std::string part; width + kCut.size() > most; part.clear()) {
    text.remove_prefix(append_part(text, part));
    width -= part.size();
  }
  return std::string(kCut).append(text);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) text.remove_prefix(append_printable(text, shown));
  return shown;
}

std::string shortened(std::string_view text, std::size_t most) {
  std::string shown;
  std::size_t cut = 0;  // the end of the last part that leaves room for the dots
  for (std::size_t at = 0; at < text.size();) {
    at += append_part(text.substr(at), shown);
    if (shown.size() > most) return std::string(text.substr(0, cut)).append(kCut);
    if (shown.size() + kCut.size() <= most) cut = at;
  }
  return std::string(text);
}

Diagnostic shortened(Diagnostic diagnostic) {
  diagnostic.pointer = shortened(diagnostic.pointer, kLongestPointer);
  diagnostic.message = shortened(diagnostic.message, kLongestMessage);
  return diagnostic;
}

ScenarioError::ScenarioError(std::vector<Diagnostic> diagnostics, std::string file)
    : std::runtime_error(summarize(file, diagnostics)),
      diagnostics_(all_shortened(std::move(diagnostics))),
      file_(std::move(file)) {}

std::string format_diagnostic(std::string_view file, const Diagnostic& given, std::string_view severity) {
  const Diagnostic diagnostic = shortened(given);
  std::string text;
  if (!file.empty()) {
    text += end_of(file, kLongestFileName);
    text += ':';
    if (diagnostic.line > 0) text += fmt::format("{}:{}:", diagnostic.line, diagnostic.column);
    text += ' ';
  }
  text += fmt::format("{}: ", severity);
  if (!diagnostic.pointer.empty()) text += diagnostic.pointer + ": ";
  return printable(text + diagnostic.message);
}

void refuse_file(const std::string& file, std::string why) {
  throw ScenarioError(std::vector<Diagnostic>{{0, 0, "", std::move(why)}}, file);
}

std::string plain_words(const std::exception& error) {
  const auto is_own = [&]<class... Kinds>(std::type_identity<Kinds>...) {
    return ((dynamic_cast<const Kinds*>(&error) != nullptr) || ...);
  };
  if (is_own(std::type_identity<ScenarioError>(), std::type_identity<FileError>(), std::type_identity<ArithmeticError>()))
    return error.what();
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "out of memory; ask for fewer rows, or end other programs";
  if (const auto* of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return fmt::format("{}: {}", printable(of_file->path1().string()), of_file->code().message());
  if (const auto* of_system = dynamic_cast<const std::system_error*>(&error))
    return of_system->code() == std::errc::resource_unavailable_try_again ? "no thread can be started; end other programs"
                                                                          : of_system->code().message();
  return "a defect of earthtop, and not of what it was given; please report it with the command and its files";
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
