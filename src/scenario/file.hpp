/// Files as text, whole: what is no regular file, or too large, is refused before it can hold anything up.
#pragma once

#include <string>
#include <string_view>

namespace earthtop::scenario {

/// What a file should have been, for messages.
struct FileUse {
  std::string_view noun;           ///< "scenario file"
  bool or_standard_input = false;  ///< whether '-' might be given instead
};

/// @param name  of the file, as an error shall call it
/// @throws ScenarioError, with one diagnostic, for a missing, unreadable or oversized (over 16 MiB) file, a directory, a FIFO
/// or a device; ReadError.
std::string read_regular_file(const std::string& path, const std::string& name, const FileUse& use);

}  // namespace earthtop::scenario
