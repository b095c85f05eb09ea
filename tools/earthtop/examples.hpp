/// The shipped scenarios, inside the program.
#pragma once

#include <span>
#include <string_view>

namespace earthtop::tool {

struct Example {
  std::string_view name;
  std::string_view text;  ///< the file, byte for byte
};

/// In alphabetical order.
std::span<const Example> examples();

}  // namespace earthtop::tool
