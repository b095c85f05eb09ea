// SPDX-License-Identifier: GPL-3.0-or-later
/// The results of a study for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace earthtop::tool {

/// Of the document that `study_json` makes: points, statistics, means along the axes, fits, indices, figures.
std::string study_text(std::string_view document);

/// How many points of a study there are to be and there are, as the same document says.
struct StudyCounts {
  std::uint64_t planned, computed, failed;
};
StudyCounts study_counts(std::string_view document);

}  // namespace earthtop::tool
