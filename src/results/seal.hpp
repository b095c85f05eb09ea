// SPDX-License-Identifier: GPL-3.0-or-later
/// Checksums of result files: a JSON document ends with its own, and summary.json lists those of the files beside it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earthtop {

/// The names of files with their checksums.
using FileChecksums = std::vector<std::pair<std::string, std::string>>;

/// Adds a last member "checksum" to a JSON document: that of the document's bytes with zeros for the checksum's digits.
/// @param document  an object; an empty one stays as it is
std::string sealed(std::string_view document);
/// Adds a member "files" with the checksums of files, and then the document's own.
std::string sealed(std::string_view document, const FileChecksums& files);

/// A document as `--json` prints it, to be read back: indented, without invisible characters, with its checksum.
/// @param document  an object that is not empty
std::string sealed_document(const nlohmann::ordered_json& document);

/// A document as it was before `sealed`; itself if it has no checksum. Nothing is checked.
std::string unsealed(std::string_view document);

enum class Seal {
  fits,
  absent,  ///< a document from before there were checksums
  broken   ///< the document is not what was written
};
Seal seal_of(std::string_view document);
/// The same of a document that is read: one that is not what was written is refused.
/// @param remedy  what to do then   @returns whether it has a checksum   @throws ScenarioError
bool check_seal(std::string_view document, const std::filesystem::path& file, std::string_view remedy);
/// A sentence on a file or directory that has no checksums, for all who read it.
std::string unverified(const std::filesystem::path& path);

/// The checksums of files that a summary states; none of a summary without.
/// @param file  of the summary, for messages   @throws ScenarioError where it is not a document, or has other names than of files
FileChecksums checksums_in(std::string_view summary, const std::filesystem::path& file);

/// @throws ScenarioError always: the file is not what was written
[[noreturn]] void refuse_damaged(const std::filesystem::path& file);

/// Whether a file is what a document with its checksum states. @returns also true for a document without checksums, which is old
bool is_as_stated(const std::filesystem::path& directory, std::string_view name, std::string_view document);

/// Holds the files of a results directory against the checksums that its summary states.
/// @param summary  the text of summary.json
/// @returns whether there are checksums   @throws ScenarioError that names the damaged file; ReadError
bool check_result_files(const std::filesystem::path& directory, std::string_view summary);

/// timing.json with the checksum of the summary to which it belongs, and its own.
std::string sealed_timing(std::string_view timing, std::string_view summary);
/// Holds timing.json against its checksum, and against the summary that it states. The timing of an older earthtop states none; a
/// summary without checksums may have been edited since.
/// @param directory  of both, for messages   @returns whether it has a checksum   @throws ScenarioError
bool check_timing(const std::filesystem::path& directory, std::string_view timing, std::string_view summary);

}  // namespace earthtop
