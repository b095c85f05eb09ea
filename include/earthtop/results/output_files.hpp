// SPDX-License-Identifier: GPL-3.0-or-later
/// The files that a command writes by name: which may be written, and how they are put in place together.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop {

/// What a file is for. An older one for the same purpose is known by its content.
enum class OutputKind {
  plan_picture,
  comparison_picture,
  measurement_picture,
  page_picture,
  page,
  verdicts,
  simulated_data,
  scenario,
  document,
  manual_page,
  gallery_page,
  gallery_picture
};

struct OutputFile {
  OutputKind kind;
  std::string path;         ///< empty: it is not asked for
  std::string option = "";  ///< that names it, for messages
};

/// Files that change together: either all of them are written, or none.
///
/// A file that is there is replaced where earthtop wrote it for the same purpose and nobody has changed it since: its last line says
/// so, with a checksum. (Files of version 1.0 have no such line and are known by their beginning, but for simulated data, which a
/// person may have made a measurement of.) Any other is refused unless `force` is set. A FIFO or a character device is written to,
/// after the files are complete under temporary names; every other link, and what is no file, is refused in any case.
class OutputFiles {
 public:
  /// Checks that all of them may be written. To be called before the work, so that nothing is computed in vain.
  /// @param inputs  files and directories that are read: no output may be one of them, or be in one; "-" and "" are passed over
  /// @throws ScenarioError, ReadError, WriteError
  OutputFiles(std::vector<OutputFile> files, const std::vector<std::string>& inputs, bool force);
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Gives the content of the next of the files with a path that is equal to this; they are kept until `commit`.
  void put(std::string_view path, std::string content);
  /// Adds a file whose name only the work has shown. @throws as the constructor
  void add(OutputFile file, std::string content);
  /// Writes what was put. @throws as the constructor, because another file may be there by now; then nothing is changed
  void commit();

 private:
  struct Output;
  /// Refuses an output that is another one, or an input.
  void require_apart(const Output& output) const;
  std::vector<std::unique_ptr<Output>> outputs_;
  std::vector<std::string> inputs_;
  bool force_;
};

/// Whether something is at the path, a dangling link included. @throws WriteError where that cannot be known
bool is_something_at(const std::filesystem::path& path);

/// Checks that a directory is there and may be written to, or can be made. @param remedy  e.g. "choose another --out"
/// @throws ScenarioError, WriteError
void require_place_for_directory(const std::filesystem::path& directory, std::string_view remedy);

}  // namespace earthtop
