// SPDX-License-Identifier: GPL-3.0-or-later
/// The types of failure. Input that is refused is thrown as an exception that lists all its violations; numerical trouble
/// during an integration is a returned status.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earthtop {

/// One violation: its position in the file (line and column from 1; 0 if there is no file), the key as a JSON pointer, and a
/// message that says what is wrong and what is allowed.
struct Diagnostic {
  int line = 0;
  int column = 0;
  std::string pointer;
  std::string message;
};

/// Thrown for input that is refused; holds all its violations, each of them shortened.
class ScenarioError : public std::runtime_error {
 public:
  explicit ScenarioError(std::vector<Diagnostic> diagnostics, std::string file = "");
  ScenarioError(std::string pointer, std::string message)
      : ScenarioError(std::vector<Diagnostic>{{0, 0, std::move(pointer), std::move(message)}}) {}
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  const std::string& file() const { return file_; }

 private:
  std::vector<Diagnostic> diagnostics_;
  std::string file_;
};

/// Refuses a file or directory as a whole. @throws ScenarioError always
[[noreturn]] void refuse_file(const std::string& file, std::string why);

/// Thrown for a file that cannot be read or written although the request was valid: which file, and why.
class FileError : public std::runtime_error {
 public:
  FileError(std::string file, std::string reason)
      : std::runtime_error(file + ": " + reason), file_(std::move(file)), reason_(std::move(reason)) {}
  const std::string& file() const { return file_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string file_;
  std::string reason_;
};

/// An input could not be read to its end.
class ReadError : public FileError {
  using FileError::FileError;
};

/// A result could not be written.
class WriteError : public FileError {
  using FileError::FileError;
};

/// What an exception of any kind says to a user: the text of one of the above; for others of the library or the system, their
/// kind in plain words, without the text that their makers meant for programmers.
std::string plain_words(const std::exception& error);

/// The longest pointer and message of a diagnostic, and the longest name of its file, in the form in which they are shown (bytes).
/// Together with its place a diagnostic's line has less than 2 KiB.
inline constexpr std::size_t kLongestPointer = 300, kLongestMessage = 1200, kLongestFileName = 400;

/// The beginning of a text whose printable form has at most `most` bytes, with "..." at its end if something was cut. A cut is
/// never inside a character, or inside an escape (`\xNN`, `\uNNNN`, ~0, ~1) that the text has already.
std::string shortened(std::string_view text, std::size_t most = kLongestMessage);
/// A diagnostic whose pointer and message are shortened.
Diagnostic shortened(Diagnostic diagnostic);

/// A text in a form that a terminal can safely show: valid UTF-8. Control characters, line ends, marks of writing direction and
/// bytes that are not valid UTF-8 are written as `\xNN` or `\uNNNN`.
std::string printable(std::string_view text);

/// One printable line `file:line:col: error: /json/pointer: message`, shortened to less than 2 KiB; of a long file name the end
/// is shown.   @param severity  "error" or "warning"
std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic, std::string_view severity = "error");

/// How an integration ended.
enum class RunStatus {
  completed,
  not_finite,      ///< a time derivative or a state stopped being a finite number
  step_underflow,  ///< the step fell below the resolution of the time variable
  not_converged,   ///< the iteration of an implicit method did not converge: its step is too long
  step_limit,      ///< the integration needed more steps than its limit, or than ten times the estimated work
  interrupted,     ///< stopped by request from outside
};

std::string_view to_string(RunStatus status);

}  // namespace earthtop
