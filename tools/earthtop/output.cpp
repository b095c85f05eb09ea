// SPDX-License-Identifier: GPL-3.0-or-later
#include "output.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "json_object.hpp"
#include "progress_line.hpp"

namespace earthtop::tool {

void prepare_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int descriptor : {0, 1, 2}) {
    // `open` returns the lowest free descriptor, which is the closed one. It is opened for the wrong direction, so that using
    // it fails as with a closed one.
    if (::fcntl(descriptor, F_GETFD) < 0 && ::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) < 0)
      std::_Exit(kWriteFailed);
  }
}

namespace {
std::atomic<bool> printed = false;
}

bool has_printed() noexcept { return printed; }

void print(std::string_view text) {
  static bool reader_has_gone = false;
  if (reader_has_gone) throw ReaderGone();
  printed = true;
  errno = 0;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!whole || std::ferror(stdout) != 0) {
    const int error = errno;
    if (error == EPIPE) {
      reader_has_gone = true;
      return;
    }
    throw WriteError(kStandardOutput, error != 0 ? std::strerror(error) : "writing failed");
  }
}

void write_at_once(int descriptor, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written <= 0) return;  // nobody is listening
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void message(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void print_notes(const std::vector<std::string>& notes) {
  constexpr std::size_t kMost = 8;
  for (std::size_t i = 0; i < std::min(notes.size(), kMost); ++i) message("note: " + notes[i]);
  if (notes.size() > kMost) message(fmt::format("note: and {} more notes of this kind", notes.size() - kMost));
}

int end_quietly() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
  return kReaderGone;
}

bool wants_color() { return is_lively_terminal(STDOUT_FILENO); }

void report_warnings(const std::string& file, const std::vector<Diagnostic>& warnings) {
  for (const Diagnostic& warning : warnings) message(format_diagnostic(file, warning, "warning"));
}

JsonObject diagnostic_json(const std::string& file, const Diagnostic& given) {
  const Diagnostic diagnostic = shortened(given);
  const bool placed = diagnostic.line > 0;
  JsonObject object;
  object.put("file", file);
  placed ? object.put("line", diagnostic.line) : object.put_null("line");
  placed ? object.put("column", diagnostic.column) : object.put_null("column");
  object.put("pointer", diagnostic.pointer).put("message", diagnostic.message);
  return object;
}

void print_json(const JsonObject& document) { print(document.text()); }

std::string errors_json(const std::string& file, const std::vector<Diagnostic>& errors) {
  std::vector<JsonObject> list;
  list.reserve(errors.size());
  for (const Diagnostic& error : errors) list.push_back(diagnostic_json(file, error));
  return JsonObject().put("errors", list).text();
}

std::string errors_text(const std::string& file, const std::vector<Diagnostic>& errors) {
  std::string text;
  for (const Diagnostic& error : errors) text += format_diagnostic(file.empty() ? "earthtop" : file, error) + '\n';
  return text;
}

int report_errors(const std::string& file, const std::vector<Diagnostic>& errors, bool json, int status) {
  if (json) {
    print(errors_json(file, errors));
  } else {
    const std::string text = errors_text(file, errors);
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  return status;
}

}  // namespace earthtop::tool
