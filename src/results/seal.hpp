// SPDX-License-Identifier: GPL-3.0-or-later
/// Checksums of result files: a JSON document ends with its own, and summary.json lists those of the files beside it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earthtop {

/// The names of files with their checksums.
using FileChecksums = std::vector<std::pair<std::string, std::string>>;

/// Adds a last member "checksum" to a JSON document: that of the document's bytes with zeros for the checksum's digits.
/// @param document  an object that is not empty, written with an indent of two and a final newline
std::string sealed(std::string_view document);
/// Adds a member "files" with the checksums of files, and then the document's own.
std::string sealed(std::string_view document, const FileChecksums& files);

/// A document as it was before `sealed`; itself if it has no checksum. Nothing is checked.
std::string unsealed(std::string_view document);

enum class Seal {
  fits,
  absent,  ///< a document from before there were checksums
  broken   ///< the document is not what was written
};
Seal seal_of(std::string_view document);

/// The checksums of files that a summary states; none of a summary without.
/// @param file  of the summary, for messages   @throws ScenarioError where it is not a document, or has other names than of files
FileChecksums checksums_in(std::string_view summary, const std::filesystem::path& file);

/// @throws ScenarioError always: the file is not what was written
[[noreturn]] void refuse_damaged(const std::filesystem::path& file);

/// Holds the files of a results directory against the checksums that its summary states.
/// @param summary  the text of summary.json
/// @returns whether there are checksums   @throws ScenarioError that names the damaged file; ReadError
bool check_result_files(const std::filesystem::path& directory, std::string_view summary);

}  // namespace earthtop
