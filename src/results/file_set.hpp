// SPDX-License-Identifier: GPL-3.0-or-later
/// A set of files that change together: either all of them are replaced, or none.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/watch.hpp"
#include "results/directory_lock.hpp"
#include "results/durable.hpp"

namespace earthtop {

/// While it lives, `discard_temporaries` removes the file with this name.
class TemporaryName {
 public:
  /// @param name  outlives this object
  explicit TemporaryName(const char* name);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  std::atomic<const char*>* slot_;
};

/// Files and directories that `discard_temporaries` removes while this object lives, the last one first; of two objects at a time,
/// the later one does nothing.
class TemporaryNames {
 public:
  TemporaryNames() = default;
  ~TemporaryNames() { forget(); }
  TemporaryNames(const TemporaryNames&) = delete;
  TemporaryNames& operator=(const TemporaryNames&) = delete;
  /// @param name  of a file, or of a directory that is removed if it is empty
  void add(std::string name);
  void forget() noexcept;

  struct Name {
    std::string path;
    const Name* before;
  };

 private:
  std::list<Name> names_;
};

/// The next version of the files of a directory. The last of the names is the seal: where this file exists, the others are
/// complete and belong to it.
///
/// Every file is complete on disk under a temporary name (`.NAME.PID-N.tmp`) before anything is changed; all of them are waited for
/// together. Then the old seal is
/// taken away, the others are replaced, and the new seal is put in place, with the directory synced in between. After a
/// failure everything is put back as it was. A crash during these few system calls leaves a directory without its seal, with
/// the old and the new seal under temporary names; of a set of one file, either version is there at any time. Links are replaced, never followed. Temporary files that a killed run left
/// are removed by the next run.
class FileSet {
 public:
  /// Makes the directory and locks it, so that no other run writes there meanwhile (where the file system can lock).
  /// @param names  all files of the set; the seal last
  /// @param watch  may stop the work until `commit` puts the first file in place; Interrupted is then thrown
  /// @param patience  how long another writer is waited for
  /// @throws WriteError
  FileSet(std::filesystem::path dir, std::span<const std::string_view> names, const Watch& watch = {},
          std::chrono::seconds patience = DirectoryLock::kPatience);
  /// Unless the set was committed, removes its temporary files and the directories that it made.
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  using Sink = earthtop::Sink;
  /// Writes one file under a temporary name. @throws WriteError; Interrupted; all that `produce` throws
  void add(std::string_view name, const std::function<void(const Sink&)>& produce);
  void add(std::string_view name, std::string_view content);

  /// Puts the added files in place, and removes files of the set that were not added. @throws WriteError; then everything is as
  /// it was before.
  void commit();
  /// The same for several sets, each in a directory of its own, as if they were one.
  static void commit(std::span<const std::unique_ptr<FileSet>> sets);

  /// Temporary files for `name` in `dir` that a killed run left or a running one uses.
  static std::vector<std::filesystem::path> temporaries(const std::filesystem::path& dir, std::string_view name);

 private:
  struct File;
  static void commit_as_one(std::span<FileSet* const> sets);
  File& file(std::string_view name);
  void make_directory();
  void lock(std::chrono::seconds patience);
  void remove_left(std::string_view name) const;
  void sync() const;
  /// @param must_go_back  whether the old files are still needed, since another set may fail
  void replace(bool must_go_back);
  void put_back() noexcept;
  void settle();

  void stop_if_asked() const;

  std::filesystem::path dir_;
  Watch watch_;
  std::vector<std::filesystem::path> made_;   // directories that this set made, the outermost first
  std::vector<std::shared_ptr<void>> known_;  // keep the names of these directories known to `discard_temporaries`
  std::vector<std::unique_ptr<File>> files_;
  std::optional<DirectoryLock> lock_;
  bool committed_ = false;
};

/// While it lives, signals do not end the program, since files are being put in place. There is only one at a time.
class CommitMoment {
 public:
  CommitMoment();
  ~CommitMoment();
  CommitMoment(const CommitMoment&) = delete;
  CommitMoment& operator=(const CommitMoment&) = delete;
};

}  // namespace earthtop
