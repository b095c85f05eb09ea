// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "earthtop/error.hpp"
#include "input/reader.hpp"
#include "text/checksum.hpp"

namespace earthtop::input {
namespace {

void require_regular(const struct stat& status, const std::string& name, const FileUse& use) {
  const auto* or_stdin = use.or_standard_input ? ", or '-' and redirect standard input" : "";
  if (S_ISDIR(status.st_mode)) refuse_file(name, fmt::format("is a directory; give a {} in it", use.noun));
  if (S_ISFIFO(status.st_mode)) refuse_file(name, fmt::format("is a FIFO; give a file{}", or_stdin));
  if (!S_ISREG(status.st_mode)) refuse_file(name, fmt::format("is not a regular file; give a file{}", or_stdin));
}

[[noreturn]] void refuse_size(const std::string& name, const FileUse& use) {
  refuse_file(name, fmt::format("has more than {0} MiB, the most a {1} may have; is it a {1}?", use.most_MiB, use.noun));
}

/// Refuses a file like /proc/kmsg, which calls itself regular.
[[noreturn]] void refuse_waiting(const std::string& name) {
  refuse_file(name, "has nothing to read yet, and waits for more: it is no file on a disk; give a file");
}

/// @throws always, according to the errno value `error`: what the caller can correct is refused, the rest is the disk's fault
[[noreturn]] void fail_to_look(const std::string& path, int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  for (const int mendable : {EACCES, EPERM, ELOOP, ENAMETOOLONG, ENOENT, ENOTDIR})
    if (error == mendable)
      refuse_file(path, fmt::format("cannot be examined ({}); check path and permissions", std::strerror(error)));
  throw ReadError(path, fmt::format("cannot be examined ({}); check the disk", std::strerror(error)));
}

std::string read_all(int descriptor, const std::string& name, const FileUse& use) {
  std::string text, chunk(std::size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t got = ::read(descriptor, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EISDIR) refuse_file(name, fmt::format("is a directory; give a {} in it", use.noun));
    if (got < 0 && errno == EAGAIN && descriptor != STDIN_FILENO) refuse_waiting(name);
    if (got < 0 && errno == EBADF) refuse_file(name, "is closed; give a file, or redirect standard input");
    if (got < 0) throw ReadError(name, fmt::format("reading failed ({}); check the file", std::strerror(errno)));
    if (got == 0) return text;
    text.append(chunk, 0, static_cast<std::size_t>(got));
    if (text.size() > use.most_MiB << 20U) refuse_size(name, use);
  }
}

}  // namespace

PathType type_of(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0)
    return S_ISDIR(status.st_mode) ? PathType::directory : S_ISREG(status.st_mode) ? PathType::file : PathType::other;
  if (errno != ENOENT && errno != ENOTDIR) fail_to_look(path, errno);
  if (::lstat(path.c_str(), &status) == 0) return PathType::other;
  if (errno != ENOENT && errno != ENOTDIR) fail_to_look(path, errno);
  return PathType::nothing;
}

std::vector<std::string> names_in(const std::string& directory) {
  // libstdc++'s directory_iterator ends the program where it finds no memory.
  struct Close {
    void operator()(DIR* open) const { ::closedir(open); }
  };
  const std::unique_ptr<DIR, Close> open(::opendir(directory.c_str()));
  if (!open) fail_to_look(directory, errno);
  std::vector<std::string> names;
  for (;;) {
    errno = 0;
    const dirent* entry = ::readdir(open.get());
    if (!entry && errno != 0) fail_to_look(directory, errno);
    if (!entry) break;
    if (const std::string_view name = entry->d_name; name != "." && name != "..") names.emplace_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Descriptor open_regular_file(const std::string& path, const std::string& name, const FileUse& use) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0) require_regular(status, name, use);
  // The file is opened without blocking and checked again: a FIFO put there in between would block the program for ever.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0) {
    if (errno == ENOENT)
      refuse_file(name, fmt::format("there is no such file; check the path{}",
                                    use.or_standard_input ? ", or give '-' for standard input" : ""));
    for (const int fault : {EIO, ESTALE, ENFILE, EMFILE})
      if (errno == fault) throw ReadError(name, fmt::format("cannot be opened ({}); check the disk", std::strerror(errno)));
    refuse_file(name, fmt::format("cannot be opened ({}); check path and permissions", std::strerror(errno)));
  }
  if (::fstat(file.get(), &status) != 0)
    throw ReadError(name, fmt::format("cannot be examined ({}); check the file", std::strerror(errno)));
  require_regular(status, name, use);
  return file;
}

std::size_t read_some(const Descriptor& file, const std::string& name, char* bytes, std::size_t size) {
  for (;;) {
    const ssize_t got = ::read(file.get(), bytes, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno == EAGAIN) refuse_waiting(name);
    if (errno != EINTR) throw ReadError(name, fmt::format("reading failed ({}); check the file", std::strerror(errno)));
  }
}

std::string read_regular_file(const std::string& path, const std::string& name, const FileUse& use) {
  const Descriptor file = open_regular_file(path, name, use);
  struct stat status =
      {};  // it tells a large file without reading it; the size may grow, or be 0 for a file that is made as it is read
  if (::fstat(file.get(), &status) == 0 && status.st_size > static_cast<off_t>(use.most_MiB << 20U)) refuse_size(name, use);
  return read_all(file.get(), name, use);
}

std::uint64_t checksum_of_file(const std::string& path, const FileUse& use) {
  const Descriptor file = open_regular_file(path, path, use);
  std::string block(std::size_t{1} << 18U, '\0');
  Checksum checksum;
  while (const std::size_t got = read_some(file, path, block.data(), block.size()))
    checksum.add(std::string_view(block).substr(0, got));
  return checksum.value();
}

std::string read_standard_input(const FileUse& use) { return read_all(STDIN_FILENO, "<stdin>", use); }

}  // namespace earthtop::input
