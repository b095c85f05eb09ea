// SPDX-License-Identifier: GPL-3.0-or-later
/// One process at a time writes to a store.
#pragma once

#include <filesystem>
#include <string>

namespace earthtop::study {

/// @throws ScenarioError: the store is in use by the holder, e.g. "process 12 on host"
[[noreturn]] void refuse_in_use(const std::filesystem::path& store, const std::string& holder);

/// Held while it lives; the system lets go of it when the process ends, however it ends. Beside the store lies a file that
/// names the holder.
class StoreLock {
 public:
  /// @throws ScenarioError, at once and with who holds it, where another process does; WriteError
  explicit StoreLock(const std::filesystem::path& store);
  ~StoreLock();
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace earthtop::study
