// SPDX-License-Identifier: GPL-3.0-or-later
/// A file that lists releases of a top and their measurements, which are evaluated by one fit.
#pragma once

#include <string>
#include <vector>

#include "earthtop/measure/measurement.hpp"

namespace earthtop {

/// One release as its file names it; paths are relative to the working directory.
struct ListedRelease {
  std::string scenario;
  std::string measurement;             ///< empty where there is none yet, as for a plan
  std::vector<std::string> sets;       ///< "/json/pointer=value" pairs
  std::vector<std::string> estimates;  ///< names of numbers that are estimated for this release alone
  MeasurementFormat format = {};       ///< what is said of its measurement
};
struct ListedReleases {
  std::vector<std::string> estimates;  ///< names of numbers that are estimated for each release
  std::vector<std::string> shared;     ///< names of numbers with one value in all releases
  std::vector<ListedRelease> releases;
};

/// Reads a file of releases. Paths in it are relative to its directory.
/// @throws ScenarioError with what is wrong, where in the file, and what is allowed; ReadError
ListedReleases read_releases(const std::string& file);

/// These describe what such a file may say: as a JSON Schema (draft 7), and as a Markdown table.
std::string releases_schema();
std::string releases_reference_markdown();

}  // namespace earthtop
