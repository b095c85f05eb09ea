// SPDX-License-Identifier: GPL-3.0-or-later
/// A picture drawn twice: the page shows the one that fits the screen.
#pragma once

#include <string>

namespace earthtop::report {

/// SVG documents of the same picture; their ids differ.
struct Drawings {
  std::string wide;    ///< for a desk, for paper, and for a file of its own
  std::string narrow;  ///< for a phone; empty: the wide one is shown there, too
};

}  // namespace earthtop::report
