// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/snapshot.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "compare/comparand.hpp"
#include "earthtop/error.hpp"
#include "results/directory_lock.hpp"

namespace earthtop::compare {
namespace {

FileIdentity identity_in(const struct stat& status) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return {status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec * kSecond + status.st_mtim.tv_nsec,
          status.st_ctim.tv_sec * kSecond + status.st_ctim.tv_nsec};
}

}  // namespace

void refuse_under_way(const fs::path& directory) {
  refuse_file(directory, "a run is writing there; wait until it has ended, and repeat the command");
}

FileIdentity identity_of(const fs::path& file) {
  if (input::type_of(file.string()) == input::PathType::nothing) return {};
  struct stat status = {};
  if (::stat(file.c_str(), &status) == 0) return identity_in(status);
  if (errno == ENOENT || errno == ENOTDIR) return {};
  if (errno == ENOMEM) throw std::bad_alloc();
  throw ReadError(file.string(), std::strerror(errno));
}

Snapshot::Snapshot(const fs::path& directory, std::span<const std::string_view> names) {
  for (const std::string_view name : names) {
    File file{directory / name, {}, std::nullopt};
    if (is_there(file.path)) {
      file.open.emplace(input::open_regular_file(file.path.string(), file.path.string(), {"result file", false}));
      struct stat status = {};
      if (::fstat(file.open->get(), &status) != 0) throw ReadError(file.path.string(), std::strerror(errno));
      file.identity = identity_in(status);
    }
    files_.push_back(std::move(file));
  }
}

FileIdentities Snapshot::identities() const {
  FileIdentities identities;
  for (const File& file : files_) identities.emplace_back(file.path, file.identity);
  return identities;
}

bool Snapshot::is_current() const { return are_current(identities()); }

bool are_current(const FileIdentities& identities) {
  return std::all_of(identities.begin(), identities.end(),
                     [](const auto& file) { return identity_of(file.first) == file.second; });
}

FileIdentities read_settled(const fs::path& directory, std::span<const std::string_view> names, const Watch& watch,
                            const std::function<void(const Snapshot&)>& read) {
  constexpr int kAttempts = 4;
  for (int attempt = 1; attempt <= kAttempts; ++attempt) {
    std::optional<DirectoryLock> lock;
    lock.emplace(directory, DirectoryLock::Mode::shared, watch);
    if (lock->is_busy()) refuse_under_way(directory);
    const Snapshot snapshot(directory, names);
    if (attempt == 1) lock.reset();
    try {
      read(snapshot);
      if (FileIdentities identities = snapshot.identities(); are_current(identities)) return identities;
    } catch (const ScenarioError&) {
      if (snapshot.is_current()) throw;
    }
  }
  refuse_under_way(directory);
}

}  // namespace earthtop::compare
