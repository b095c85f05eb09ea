// SPDX-License-Identifier: GPL-3.0-or-later
/// What the program says: results on standard output, everything else on standard error.
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/error.hpp"
#include "exit_status.hpp"

namespace earthtop::tool {

class JsonObject;

/// The name of standard output in a WriteError.
inline constexpr const char* kStandardOutput = "<standard output>";

/// A writing to a closed pipe or beyond a file size limit becomes an error to report, not a signal to die of; descriptors
/// 0 to 2 are taken, so that no result file becomes "standard output".
void prepare_streams();

/// Whoever read standard output has closed it, and there is more to print.
class ReaderGone : public std::exception {};

/// Writes to standard output and makes sure that it arrived. A reader that has seen enough (`| head`) is no error: what it does
/// not take is lost, and a verb with nothing more to print ends with its own status. @throws WriteError; ReaderGone where the
/// reader had gone before this call
void print(std::string_view text);

/// Whether anything has been printed, or begun to be. Safe in a signal handler.
bool has_printed() noexcept;

/// Ends the program as a signal SIGPIPE does, without a word. @returns kReaderGone where that signal is blocked
int end_quietly();

/// Writes a line to standard error; what cannot be written there is lost.
void message(std::string_view line);

/// Whether standard output is a terminal that wants colours (NO_COLOR is honoured).
bool wants_color();

/// A line each on standard error.
void report_warnings(const std::string& file, const std::vector<Diagnostic>& warnings);

/// {file, line, column, pointer, message}; line and column are null where there are none.
JsonObject diagnostic_json(const std::string& file, const Diagnostic& diagnostic);

/// One JSON document on standard output. @throws WriteError
void print_json(const JsonObject& document);

/// Errors as a line each, and as {"errors": [...]}, with a final newline.
std::string errors_text(const std::string& file, const std::vector<Diagnostic>& errors);
std::string errors_json(const std::string& file, const std::vector<Diagnostic>& errors);

/// Reports what went wrong: a line each on standard error or, with `json`, {"errors": [...]} on standard output.
/// @returns `status`
int report_errors(const std::string& file, const std::vector<Diagnostic>& errors, bool json, int status);

}  // namespace earthtop::tool
