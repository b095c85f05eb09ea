// SPDX-License-Identifier: GPL-3.0-or-later
/// The program's output: results on standard output, everything else on standard error.
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/error.hpp"
#include "exit_status.hpp"

namespace earthtop::tool {

class JsonObject;

/// The file name that a WriteError gives for standard output.
inline constexpr const char* kStandardOutput = "<standard output>";

/// Prepares the standard streams. Writing to a closed pipe or beyond a file size limit becomes an error instead of a fatal
/// signal. Descriptors 0 to 2 are opened if they are closed, so that no result file becomes "standard output".
void prepare_streams();

/// Thrown if there is more to print after the reader of standard output has closed it.
class ReaderGone : public std::exception {};

/// Writes to standard output and checks that the text arrived. It is no error if the reader closes it (`| head`): the rest of
/// the text is lost, and a verb that prints nothing more ends with its own status.
/// @throws WriteError; ReaderGone if the reader had already gone before this call
void print(std::string_view text);

/// Whether `print` has been called. Safe in a signal handler.
bool has_printed() noexcept;

/// Ends the program by the signal SIGPIPE, without a message. @returns kReaderGone if that signal is blocked
int end_quietly();

/// Writes to a descriptor at once; failures are ignored. Allocates nothing, and is safe in a signal handler.
void write_at_once(int descriptor, std::string_view text) noexcept;

/// Writes a line to standard error; failures are ignored.
void message(std::string_view line);
/// Prints notes as messages; of many the first ones, and the number of the others.
void print_notes(const std::vector<std::string>& notes);

/// Whether standard output is a terminal that wants colours (NO_COLOR is honoured).
bool wants_color();

/// Writes the warnings to standard error, one line each.
void report_warnings(const std::string& file, const std::vector<Diagnostic>& warnings);

/// The object {file, line, column, pointer, message}; line and column are null if they are unknown.
JsonObject diagnostic_json(const std::string& file, const Diagnostic& diagnostic);

/// Writes one JSON document to standard output. @throws WriteError
void print_json(const JsonObject& document);

/// The errors as text: one line each, or {"errors": [...]} with a final newline.
std::string errors_text(const std::string& file, const std::vector<Diagnostic>& errors);
std::string errors_json(const std::string& file, const std::vector<Diagnostic>& errors);

/// Reports errors: one line each on standard error or, with `json`, {"errors": [...]} on standard output.
/// @returns `status`
int report_errors(const std::string& file, const std::vector<Diagnostic>& errors, bool json, int status);

}  // namespace earthtop::tool
