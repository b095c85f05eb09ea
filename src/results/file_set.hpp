// SPDX-License-Identifier: GPL-3.0-or-later
/// Files that change together: all of them are replaced, or none.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/watch.hpp"

namespace earthtop {

/// @throws WriteError for the file, with what errno means by `error`
[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error);

/// The next version of the files of a directory. The last of their names is the seal: where it is, the others belong to it.
///
/// Every file is complete on disk under a temporary name (`.NAME.PID-N.tmp`) before anything is changed. Then the old seal is
/// taken away, the others are replaced, and the new seal is put in place, with the directory synced in between. A failure
/// puts everything back as it was; a crash in these few system calls leaves a directory without its seal, the old and the
/// new one under temporary names. Links are replaced, never followed. What a killed run left behind is removed by the next.
class FileSet {
 public:
  /// Makes the directory and keeps others from writing there meanwhile (where the file system can lock).
  /// @param names  the files that make up the whole; the seal last
  /// @param watch  may stop it until `commit` puts the first file in place: then Interrupted is thrown   @throws WriteError
  FileSet(std::filesystem::path dir, std::span<const std::string_view> names, const Watch& watch = {});
  /// Unless committed: no temporary is left, nor a directory made for nothing.
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  using Sink = std::function<void(std::string_view)>;
  /// Writes one file under a temporary name. @throws WriteError, Interrupted, what `produce` throws
  void add(std::string_view name, const std::function<void(const Sink&)>& produce);
  void add(std::string_view name, std::string_view content);

  /// Puts the added files in place and removes the others of the names. @throws WriteError: everything is as it was
  void commit();

  /// Temporaries for `name` in `dir`, of a killed run or a running one.
  static std::vector<std::filesystem::path> temporaries(const std::filesystem::path& dir, std::string_view name);

 private:
  struct File;
  File& file(std::string_view name);
  void make_directory();
  void lock();
  void remove_left(std::string_view name) const;
  void sync() const;
  void replace();
  void put_back() noexcept;

  void stop_if_asked() const;

  std::filesystem::path dir_;
  Watch watch_;
  std::vector<std::filesystem::path> made_;   // directories, the outermost first
  std::vector<std::shared_ptr<void>> known_;  // keeps their names known to `discard_temporaries`
  std::vector<std::unique_ptr<File>> files_;
  int directory_ = -1;
  bool locked_ = false;
  bool committed_ = false;
};

}  // namespace earthtop
