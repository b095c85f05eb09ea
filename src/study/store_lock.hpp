/// One process at a time writes to a store.
#pragma once

#include <filesystem>

namespace earthtop::study {

/// Held while it lives; the system lets go of it when the process ends, however it ends. Beside the store lies a file that
/// names the holder.
class StoreLock {
 public:
  /// @throws ScenarioError, with who holds it, where another process does; WriteError
  explicit StoreLock(const std::filesystem::path& store);
  ~StoreLock();
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace earthtop::study
