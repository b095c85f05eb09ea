// SPDX-License-Identifier: GPL-3.0-or-later
/// What every way of writing has in common by which a crash leaves whole files: sets of files (file_set.hpp), and updates of
/// references. A study's store is a database, whose own journal does this for it.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "earthtop/watch.hpp"

namespace earthtop {

/// Takes the next piece of what is written.
using Sink = std::function<void(std::string_view)>;

/// @throws WriteError always, for the file, with the system's message for the errno value `error`; std::bad_alloc if that says
/// that memory is lacking
[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error);

/// Writes all of a text. @param place  what errors call the file   @throws WriteError
void write_whole(int descriptor, const std::filesystem::path& place, std::string_view text);

/// Waits until the disk has what was written to an open file, or the changed names of an open directory. Some file systems cannot
/// do so for a directory (EINVAL); that is ignored. @param place  what errors call it   @throws WriteError
void wait_for_disk(int descriptor, const std::filesystem::path& place);
/// The same for the names in a directory. @throws WriteError
void sync_directory(const std::filesystem::path& directory);

/// An open file, or none.
class Descriptor {
 public:
  explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }
  /// @returns 0 if there was nothing to be closed, or nothing failed
  int close();

 private:
  int descriptor_;
};

/// Writes a new file, and lets the disk begin to take it over: of several files, all are then waited for together.
/// @param file  must not be there yet   @param place  what errors call it   @returns the open file, for `finish_writing`
/// @throws WriteError; Interrupted if the watch asks to stop; all that `produce` throws
Descriptor begin_writing(const std::filesystem::path& file, const std::filesystem::path& place,
                         const std::function<void(const Sink&)>& produce, const Watch& watch = {});
/// Waits until the disk has all of the file, and closes it. @param place  what errors call it   @throws WriteError
void finish_writing(Descriptor file, const std::filesystem::path& place);

/// Both of them for one file.
void write_durably(const std::filesystem::path& file, const std::filesystem::path& place,
                   const std::function<void(const Sink&)>& produce, const Watch& watch = {});

/// The directory and those that hold it, as far as they are not there, the outermost first.
std::vector<std::filesystem::path> missing_directories(const std::filesystem::path& directory);
/// Removes those of the directories that are empty. @param directories  the outermost first
void remove_empty(const std::vector<std::filesystem::path>& directories) noexcept;

}  // namespace earthtop
