// SPDX-License-Identifier: GPL-3.0-or-later
/// One self-contained HTML page of a run, a study, a comparison or a bench: for eyes, offline, and for paper.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace earthtop {

struct Report {
  std::string html;
  std::vector<std::pair<std::string, std::string>> pictures;  ///< the page's figures by themselves: name, SVG
};

/// @param what  results of a run, a study (its directory or store), or a document that `compare --json` or `bench --json` wrote
/// @throws ScenarioError for what is none of these, or is damaged; ReadError
Report make_report(const std::filesystem::path& what);

/// Where a report is put unless said otherwise: report.html in a directory, else the document's name with .html.
std::filesystem::path report_file(const std::filesystem::path& what);

}  // namespace earthtop
