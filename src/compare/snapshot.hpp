// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading of files that another process may replace meanwhile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/watch.hpp"
#include "input/file.hpp"

namespace earthtop::compare {

/// The signs that tell one version of a file from another: times are in nanoseconds, and all is 0 where there is no such file.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  std::int64_t size = 0, modified_ns = 0, changed_ns = 0;
  bool operator==(const FileIdentity&) const = default;
};
/// Links are followed. @throws ReadError where the disk does not say; ScenarioError where permissions forbid looking
FileIdentity identity_of(const std::filesystem::path& file);

/// Paths with the identities that files had there.
using FileIdentities = std::vector<std::pair<std::filesystem::path, FileIdentity>>;
/// Whether there are still the same files there.
bool are_current(const FileIdentities& identities);

/// The files of a directory at one moment. They stay readable, however they are replaced.
class Snapshot {
 public:
  struct File {
    std::filesystem::path path;
    FileIdentity identity;
    std::optional<input::Descriptor> open;  ///< none where there is no such file
  };
  /// @throws ScenarioError, ReadError as `input::open_regular_file`
  Snapshot(const std::filesystem::path& directory, std::span<const std::string_view> names);
  const std::vector<File>& files() const { return files_; }
  /// Whether the names still lead to these files, and none has been changed.
  bool is_current() const;
  FileIdentities identities() const;

 private:
  std::vector<File> files_;
};

/// @throws ScenarioError always: the results there do not stay the same for long enough to be read
[[noreturn]] void refuse_under_way(const std::filesystem::path& directory);

/// Calls `read` with a snapshot of files until they were the same before and after it. Runs that write to the directory are
/// waited for. The first call does not hold them up; further ones do.
/// @returns the identities of the files that were read
/// @throws ScenarioError if a run goes on writing there, or the files go on changing; what `read` throws about files that did
/// not change; Interrupted
FileIdentities read_settled(const std::filesystem::path& directory, std::span<const std::string_view> names, const Watch& watch,
                            const std::function<void(const Snapshot&)>& read);

}  // namespace earthtop::compare
