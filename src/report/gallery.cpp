// SPDX-License-Identifier: GPL-3.0-or-later
/// The index of a gallery.
#include <fmt/core.h>

#include <string>
#include <string_view>
#include <vector>

#include "earthtop/report/report.hpp"
#include "report/finding.hpp"
#include "report/html.hpp"

namespace earthtop {
namespace report {
namespace {

/// The picture with ids of its own: many pictures stand on one page.
std::string with_own_ids(std::string picture, const std::string& name) {
  for (const std::string_view before : {" id=\"", "url(#", "href=\"#", "labelledby=\""})
    for (std::size_t at = picture.find(before); at != picture.npos; at = picture.find(before, at + 1))
      picture.insert(at + before.size(), name + "-");
  return picture;
}

std::string card(const GalleryPage& page) {
  const Report& of = page.report;
  const std::string name = page.file.substr(0, page.file.rfind('.'));
  return fmt::format(
      "<li><a href=\"{}\"><span class=\"small\">{}</span><span class=\"subject\">{}</span></a>\n<p>{}</p></li>\n",
      escaped(page.file), with_own_ids(without_style(of.picture), name), escaped(of.title),
      of.finding + (of.finding.ends_with('.') ? "" : "."));
}

}  // namespace
}  // namespace report

std::string gallery_index(const std::vector<GalleryPage>& pages) {
  report::Page index("gallery", "Tops and gyroscopes on an Earth that turns");
  index.headline(pages.size() == 1 ? "One page, with what was found."
                                   : fmt::format("{} pages, each with what was found.", pages.size()));
  std::size_t number = 0;
  for (const std::string_view group : report::kGroups) {
    std::string cards;
    for (const GalleryPage& page : pages)
      if (page.report.group == group) cards += report::card(page);
    if (!cards.empty()) index.section(fmt::format("group{}", ++number), group, "<ul class=\"gallery\">\n" + cards + "</ul>\n");
  }
  return index.finish().html;
}

}  // namespace earthtop
