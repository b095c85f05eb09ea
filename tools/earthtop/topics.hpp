// SPDX-License-Identifier: GPL-3.0-or-later
/// The tables of the manuals that `earthtop help TOPIC` prints.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace earthtop::tool {

struct Topic {
  std::string_view name;
  std::string_view table;  ///< in Markdown, with its header
};
std::span<const Topic> topics();

/// The table as a list: the first column's words on the left, the others beside them.
std::string topic_text(const Topic& topic, std::size_t width);

}  // namespace earthtop::tool
