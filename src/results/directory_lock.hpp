// SPDX-License-Identifier: GPL-3.0-or-later
/// The lock by which runs of the program that write to a directory, or read results there, wait for each other.
#pragma once

#include <chrono>
#include <filesystem>

#include "earthtop/watch.hpp"

namespace earthtop {

/// A lock on a directory. The system releases it when the process ends, however it ends. Where the file system cannot lock, or
/// the directory is missing or may not be read, nothing is held, and the caller goes on without.
class DirectoryLock {
 public:
  enum class Mode {
    shared,    ///< to read files that belong together
    exclusive  ///< to write
  };
  static constexpr std::chrono::seconds kPatience{10};
  /// @param patience  how long other holders are waited for
  /// @throws Interrupted if the watch asks to stop; ReadError (shared) or WriteError (exclusive) if the directory cannot be opened
  DirectoryLock(const std::filesystem::path& directory, Mode mode, const Watch& watch = {},
                std::chrono::seconds patience = kPatience);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  bool is_held() const { return state_ == State::held; }
  bool is_busy() const { return state_ == State::busy; }  ///< others held it all the time
  int descriptor() const { return descriptor_; }          ///< of the directory; negative where it could not be opened

 private:
  enum class State { held, busy, impossible };
  int descriptor_;
  State state_ = State::impossible;
};

}  // namespace earthtop
