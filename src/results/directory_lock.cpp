// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/directory_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <thread>

#include "earthtop/error.hpp"
#include "earthtop/results/results.hpp"
#include "results/file_set.hpp"

namespace earthtop {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, Mode mode, const Watch& watch,
                             std::chrono::seconds patience)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const bool writes = mode == Mode::exclusive;
  if (descriptor_ < 0) {
    if (errno == EACCES) return;  // a directory that may be written to, or whose files may be read, but which cannot be listed
    if (writes) fail_to_write(directory, errno);
    if (errno == ENOENT || errno == ENOTDIR) return;
    if (errno == ENOMEM) throw std::bad_alloc();
    throw ReadError(directory.string(), std::strerror(errno));
  }
  using Clock = std::chrono::steady_clock;
  try {
    for (const auto start = Clock::now(); ::flock(descriptor_, (writes ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0;) {
      if (errno != EWOULDBLOCK && errno != EINTR) return;  // cannot lock here
      if (watch.asks_to_stop()) throw Interrupted();
      if (Clock::now() - start >= patience) {
        state_ = State::busy;
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(writes ? 20 : 5));
    }
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  state_ = State::held;
}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace earthtop
