// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/store_lock.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <thread>

#include "earthtop/error.hpp"
#include "input/file.hpp"

namespace earthtop::study {
namespace {

std::string host_name() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return host.data();
}

std::string this_process() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return fmt::format("process {} on {}, since {}", ::getpid(), host_name(), date.data());
}

std::string holder(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t got = ::pread(descriptor, text.data(), text.size() - 1, 0);
  return got > 0 ? printable(std::string_view(text.data(), static_cast<std::size_t>(got))) : "another process";
}

/// Whether the holder named in a lock file is a process of this machine that has ended, and whose lock will therefore soon be
/// free. The file begins with "process <id> on <host>".
bool has_ended(std::string_view holder) {
  long process = 0;
  std::array<char, 256> host{};
  if (std::sscanf(std::string(holder).c_str(), "process %ld on %255[^,]", &process, host.data()) != 2) return false;
  return host_name() == host.data() && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
}

/// Refuses a file of somebody else's with the name of a lock file. @throws ScenarioError; ReadError
void require_lock_file(const std::filesystem::path& file) {
  const std::string path = file.string();
  if (input::type_of(path) == input::PathType::nothing) return;
  constexpr std::string_view kBegin = "process ";
  std::array<char, kBegin.size()> begin{};
  std::size_t size = 0;
  try {
    size = input::read_some(input::open_regular_file(path, path, {"file"}), path, begin.data(), begin.size());
  } catch (const ScenarioError&) {
    if (input::type_of(path) == input::PathType::nothing) return;  // its holder has just removed it
    throw;
  }
  if (size > 0 && std::string_view(begin.data(), size) != kBegin)
    throw ScenarioError(
        std::vector<Diagnostic>{{0, 0, "", "is in the way, and is not a lock of earthtop; remove it, or choose another --out"}},
        path);
}

}  // namespace

void refuse_in_use(const std::filesystem::path& store, const std::string& holder) {
  throw ScenarioError(
      std::vector<Diagnostic>{
          {0, 0, "", fmt::format("is in use by {}; wait until that has ended, or choose another --out", holder)}},
      store.string());
}

StoreLock::StoreLock(const std::filesystem::path& store) : file_(store.string() + ".lock"), descriptor_(-1) {
  // Wait a moment: a process that is being killed needs time to disappear, and one that has just started has not yet written
  // its name.
  constexpr auto kMoment = std::chrono::milliseconds(200), kPatienceWithTheDead = std::chrono::milliseconds(2000);
  const std::string who = this_process();
  for (const auto start = std::chrono::steady_clock::now();;) {
    require_lock_file(file_);
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | O_NOCTTY, 0666);
    if (descriptor_ < 0) throw WriteError(file_.string(), fmt::format("cannot be opened ({})", std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      const std::string other = holder(descriptor_);
      ::close(descriptor_);
      if (error == EINTR) continue;
      // Some network file systems have no locks.
      if (error != EWOULDBLOCK) throw WriteError(file_.string(), fmt::format("cannot be locked ({})", std::strerror(error)));
      const auto waited = std::chrono::steady_clock::now() - start;
      if (waited > (has_ended(other) ? kPatienceWithTheDead : kMoment)) refuse_in_use(store, other);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      continue;
    }
    // A holder that ended meanwhile may have deleted the file; the lock just taken would then be on a file that nobody else
    // sees.
    struct stat ours = {}, named = {};
    const bool has_name = ::fstat(descriptor_, &ours) == 0 && ::stat(file_.c_str(), &named) == 0;
    const int error = errno;
    if (has_name && ours.st_ino == named.st_ino) break;
    ::close(descriptor_);
    if (!has_name && error != ENOENT) throw WriteError(file_.string(), std::strerror(error));
  }
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, who.data(), who.size(), 0) < 0 ||
      (::fsync(descriptor_) != 0 && errno != EINVAL)) {  // so that other machines of a network file system can read it
    const int error = errno;
    ::unlink(file_.c_str());
    ::close(descriptor_);
    throw WriteError(file_.string(), std::strerror(error));
  }
  held_.emplace(file_.c_str());
}

StoreLock::~StoreLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace earthtop::study
