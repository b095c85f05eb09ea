// SPDX-License-Identifier: GPL-3.0-or-later
/// A picture of paths in a plane, seen from above, with one scale in both directions.
#pragma once

#include <string>
#include <vector>

#include "report/drawings.hpp"

namespace earthtop::report {

/// A path through points (x, y) in metres. A point that is not finite breaks it.
struct Path {
  std::string label;
  std::vector<double> x, y;
  /// Number of points at the end that are drawn as a line; those before are a band, of swings denser than pixels. 0: all are a line.
  std::size_t last_swing = 0;
};

/// Paths in a plane: of the motion on the rotating Earth and of the prediction.
struct PathPicture {
  std::string name;  ///< prefix of the ids within the document
  std::string title, subtitle;
  std::string right, up;  ///< what the picture's directions are: East and North
  Path rotating, reference;
};

/// An SVG document: both paths, the start and the end of each marked, and a bar that shows the scale.
Drawings path_svg(const PathPicture& picture);

/// The largest of 1, 2 or 5 times a power of ten that is not above a positive number.
double round_down(double number);

/// A length with a unit from kilometres to nanometres.
std::string length_text(double m, int digits);

}  // namespace earthtop::report
