// SPDX-License-Identifier: GPL-3.0-or-later
/// What can go wrong, as types: refused input is thrown with everything that is wrong with it; numerical trouble is a
/// returned outcome with a name.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earthtop {

/// One violation: where it stands in the file (1-based; 0 where there is no file), which key (JSON pointer), what is wrong
/// and what is allowed.
struct Diagnostic {
  int line = 0;
  int column = 0;
  std::string pointer;
  std::string message;
};

/// Input that is refused, with all its violations at once.
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

/// A file that cannot be worked with, though it was asked for rightly: which one, and why.
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

/// Reading an input broke off.
class ReadError : public FileError {
  using FileError::FileError;
};

/// A result could not be written.
class WriteError : public FileError {
  using FileError::FileError;
};

/// A text as a terminal may safely show it: valid UTF-8 in which controls, line ends and marks of writing direction, and
/// bytes that are no UTF-8, stand as `\xNN` or `\uNNNN`.
std::string printable(std::string_view text);

/// `file:line:col: error: /json/pointer: what`, one line, printable. @param severity  "error" or "warning"
std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic, std::string_view severity = "error");

/// How an integration ended.
enum class RunStatus {
  completed,
  not_finite,      ///< a right-hand side or a state stopped being a finite number
  step_underflow,  ///< the step fell below what the time can resolve
  not_converged,   ///< the iteration of an implicit method did not come to rest: its step is too long
  step_limit,      ///< more steps than the limit allows, or ten times the work estimated
  interrupted,     ///< asked to stop from outside
};

std::string_view to_string(RunStatus status);

}  // namespace earthtop
