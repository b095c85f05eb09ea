// SPDX-License-Identifier: GPL-3.0-or-later
/// A lock that lets only one process at a time write to a store.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "results/file_set.hpp"

namespace earthtop::study {

/// Reports that the store is in use by `holder`, e.g. "process 12 on host". @throws ScenarioError always
[[noreturn]] void refuse_in_use(const std::filesystem::path& store, const std::string& holder);

/// The lock is held as long as the object lives, and the system releases it when the process ends, however it ends. A file
/// beside the store names the holder.
class StoreLock {
 public:
  /// @throws ScenarioError, naming the holder, if another process holds the lock; WriteError
  explicit StoreLock(const std::filesystem::path& store);
  ~StoreLock();
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
  std::optional<TemporaryName> held_;  // removes the file where the process ends immediately
};

}  // namespace earthtop::study
