// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads whole files as text. A file that is not regular, or too large, is refused before it can block the program.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earthtop::input {

/// The kind of file to be read, as messages name it.
struct FileUse {
  std::string_view noun;           ///< e.g. "scenario file"
  bool or_standard_input = false;  ///< whether '-' may be given instead
  std::size_t most_MiB = 16;       ///< larger ones are refused
};

/// Owns an open file and closes it on destruction; the standard streams stay open.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// The kind of file that a path leads to, links followed. `other` is a FIFO, a device, or a link that leads nowhere.
enum class PathType { nothing, file, directory, other };
/// @throws ScenarioError where permissions or circular links forbid looking; ReadError where the disk does not say
PathType type_of(const std::string& path);

/// The names in a directory, sorted, without "." and "..". @throws ScenarioError, ReadError as `type_of`
std::vector<std::string> names_in(const std::string& directory);

/// Opens a file for reading from its beginning. @param name  name of the file in error messages
/// @throws ScenarioError, with one diagnostic, for a missing or unreadable file, a directory, a FIFO or a device
Descriptor open_regular_file(const std::string& path, const std::string& name, const FileUse& use);

/// Waits for up to `size` bytes. @returns the number of bytes read, 0 at the file's end   @throws ReadError where reading fails
std::size_t read_some(const Descriptor& file, const std::string& name, char* bytes, std::size_t size);

/// Reads a whole file. @param name  name of the file in error messages
/// @throws ScenarioError, with one diagnostic, for a missing, unreadable or oversized file, a directory, a FIFO
/// or a device; ReadError where reading fails
std::string read_regular_file(const std::string& path, const std::string& name, const FileUse& use);

/// The checksum of a file's bytes, which may be more than fit into memory. @throws as `read_regular_file`
std::uint64_t checksum_of_file(const std::string& path, const FileUse& use);

/// Reads standard input to its end, of any kind; errors name it "<stdin>". @throws as `read_regular_file`
std::string read_standard_input(const FileUse& use);

}  // namespace earthtop::input
