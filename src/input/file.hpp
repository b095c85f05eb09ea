// SPDX-License-Identifier: GPL-3.0-or-later
/// Files as text, whole: what is no regular file, or too large, is refused before it can hold anything up.
#pragma once

#include <unistd.h>

#include <string>
#include <string_view>
#include <utility>

namespace earthtop::input {

/// The kind of file that was wanted, as messages call it.
struct FileUse {
  std::string_view noun;           ///< "scenario file"
  bool or_standard_input = false;  ///< whether '-' might be given instead
};

/// An open file, closed with its owner; the standard streams stay open.
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

/// Opens a file to be read from its beginning on. @param name  of the file, as an error shall call it
/// @throws ScenarioError, with one diagnostic, for a missing or unreadable file, a directory, a FIFO or a device
Descriptor open_regular_file(const std::string& path, const std::string& name, const FileUse& use);

/// Waits for up to `size` bytes. @returns how many there were, 0 at the file's end   @throws ReadError
std::size_t read_some(const Descriptor& file, const std::string& name, char* bytes, std::size_t size);

/// @param name  of the file, as an error shall call it
/// @throws ScenarioError, with one diagnostic, for a missing, unreadable or oversized (over 16 MiB) file, a directory, a FIFO
/// or a device; ReadError.
std::string read_regular_file(const std::string& path, const std::string& name, const FileUse& use);

/// Standard input to its end, whatever it is; named "<stdin>" in errors. @throws as read_regular_file
std::string read_standard_input(const FileUse& use);

}  // namespace earthtop::input
