// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes one self-contained HTML page of a run, a study, a comparison or a benchmark, to be read offline or printed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "earthtop/watch.hpp"

namespace earthtop {

struct Report {
  std::string html;
  std::vector<std::pair<std::string, std::string>> pictures;  ///< the figures of the page as separate files: name, SVG
  std::vector<std::string> notes;                             ///< on what could not be verified; the page has them, too
  std::string title;
  std::string group;    ///< the kind of thing that a run or a study is about: "On a table"; empty for other pages
  std::string finding;  ///< the page's heading, HTML; empty where that is the title
  std::string picture;  ///< a small picture, as an SVG document; empty: there is none
};

/// @param what  results of a run, a study (its directory or store), or a document written by `compare --json` or `bench --json`
/// @param watch  may stop the work
/// @param gallery  the index of a gallery, as the page links to it, where the page of a run or a study is to be one of its pages
/// @throws ScenarioError if `what` is none of these, or is damaged; ReadError; Interrupted
Report make_report(const std::filesystem::path& what, const Watch& watch = {}, const std::string& gallery = "");

/// A page of a gallery.
struct GalleryPage {
  std::string file;  ///< its name beside the index
  Report report;
};
/// The index of a gallery: for each page its small picture and its finding, group by group.
std::string gallery_index(const std::vector<GalleryPage>& pages);

/// The default file of a report: report.html in a directory, otherwise the document's name with the extension .html.
std::filesystem::path report_file(const std::filesystem::path& what);

}  // namespace earthtop
