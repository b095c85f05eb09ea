// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of a directory and of those below it that change together: either all of them are replaced, or none.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/watch.hpp"
#include "results/directory_lock.hpp"
#include "results/file_set.hpp"

namespace earthtop::compare {

/// The directory within a reference in which its next version is put together.
inline constexpr const char* kStagingName = ".earthtop-update";

/// The next version of files below a directory, the root.
///
/// All files are complete on disk below ROOT/.earthtop-update/new before anything is changed. Then a file `journal` there lists
/// them: from this moment on the new version counts. Each file is renamed to its place, and its old version is kept in `old` until
/// all are in place. A process that dies in between leaves the journal, and `finish_update` does the rest. If a file cannot be put
/// in place, the journal is renamed to `undo`, and the old versions are put back. Where the file system has hard links, a file
/// that is in both versions is missing at no moment.
class Replacement {
 public:
  /// Makes the root and locks it, completes an update that was interrupted there, and removes what a killed one left.
  /// @throws WriteError; ScenarioError, as `finish_update`; Interrupted
  explicit Replacement(std::filesystem::path root, const Watch& watch = {});
  /// Unless committed, removes all that it made.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Writes a file of the next version, and reads it back.
  /// @param name  its path below the root; a file staged before under this name is dropped
  /// @returns the path of the staged file and the checksum of its bytes   @throws WriteError; Interrupted; all of `produce`
  std::pair<std::filesystem::path, std::string> put(const std::filesystem::path& name,
                                                    const std::function<void(const FileSet::Sink&)>& produce);
  /// States that a file of the next version will be written to `staged(name)`.
  void take(const std::filesystem::path& name);
  std::filesystem::path staged(const std::filesystem::path& name) const;
  /// Whether the staged version of a file differs from the one in place, or one of the two is missing.
  bool changes(const std::filesystem::path& name) const;
  /// States that a file stays as it is: what was staged under this name is dropped.
  void keep(const std::filesystem::path& name);
  /// States that the next version has no such file.
  void remove(const std::filesystem::path& name);

  /// Puts the next version in place. Files whose content is the same are not touched. @throws WriteError; then everything is as it was before, unless the message says otherwise
  void commit();

  /// A file that changes: its place, and where its next and its last version are kept. `was_there`: there is a last version.
  struct File {
    std::filesystem::path name, place, next, last;
    bool is_put, was_there, is_done;
  };

 private:
  File& file(const std::filesystem::path& name);
  void write_journal();

  std::filesystem::path root_, stage_, journal_, undo_;
  Watch watch_;
  std::vector<std::filesystem::path> made_, staged_directories_;  // directories made: for the next version, and to stage it
  TemporaryNames temporary_names_;
  std::optional<DirectoryLock> lock_;
  std::vector<File> changes_;
  bool keeps_root_ = false, keeps_stage_ = false;
};

/// Completes an update that was interrupted in this directory, or in one that holds this directory or file. What a killed
/// update left before it changed anything is removed.
/// @throws ScenarioError if the journal is damaged or belongs to another user; ReadError, WriteError
void finish_update(const std::filesystem::path& path);
/// The same for this directory alone.
void finish_update_in(const std::filesystem::path& directory);

}  // namespace earthtop::compare
