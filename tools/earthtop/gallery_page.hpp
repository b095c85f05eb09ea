// SPDX-License-Identifier: GPL-3.0-or-later
/// The pages of the gallery: one for each scenario and each study that comes with the program.
#pragma once

#include <string>
#include <vector>

#include "earthtop/report/report.hpp"
#include "earthtop/watch.hpp"
#include "examples.hpp"

namespace earthtop::tool {

/// The parts of a page.
struct GalleryItem {
  std::string name;  ///< of the page without its extension: "toy-top", "study-latitude"
  const Example* source;
  bool is_study;
  double seconds;          ///< of one core, as estimated
  std::string unplayable;  ///< why the page to play with does not run it; empty if it does
};

/// All of them: the scenarios, then the studies.
std::vector<GalleryItem> gallery_items();

inline constexpr const char* kGalleryIndex = "index.html";

/// Runs the scenario or the study in a temporary directory, and makes its page, which links to the index.
/// @throws Interrupted; WriteError; ScenarioError where the program refuses what came with it
Report make_gallery_page(const GalleryItem& item, const Watch& watch);

}  // namespace earthtop::tool
