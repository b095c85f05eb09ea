// SPDX-License-Identifier: GPL-3.0-or-later
// A strict reader of the markup that the program writes.
#include <algorithm>
#include <string>

#include "fuzz/properties.hpp"
#include "text/utf8.hpp"

namespace earthtop::fuzz {
namespace {

/// The names of elements, then of attributes, each between blanks.
constexpr std::string_view kElements =
    " a body button canvas caption circle clipPath code data dd defs desc details div dl dt figcaption figure footer g h1 h2 "
    "h3 head header "
    "html label li line link main meta nav ol p path polygon polyline pre rect script section select span strong style summary "
    "svg table tbody td text th thead title tr tspan ul use marker linearGradient stop em small sub sup input option output "
    "pattern ";
constexpr std::string_view kEmptyElements = " meta link input ";
constexpr std::string_view kAttributes =
    " aria-hidden checked patternUnits patternTransform aria-label aria-labelledby aria-describedby aria-live charset class "
    "clip-path content cx cy d data-chart "
    "data-name dominant-baseline dx dy fill fill-opacity font-family font-size font-weight for height href http-equiv id lang "
    "letter-spacing markerHeight markerWidth max min name offset opacity orient points preserveAspectRatio r refX refY rel "
    "role "
    "rx ry scope step stop-color stroke stroke-dasharray stroke-linecap stroke-linejoin stroke-opacity stroke-width "
    "tabindex text-anchor title transform type value viewBox width x x1 x2 xmlns y y1 y2 font-style hidden ";
constexpr std::string_view kEntities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};

bool is_one_of(std::string_view name, std::string_view names) {
  return !name.empty() && name.find(' ') == name.npos && names.find(" " + std::string(name) + " ") != names.npos;
}

/// "toy-top.html": a page of the same gallery.
bool is_page_beside(std::string_view link) {
  constexpr std::string_view kEnd = ".html";
  if (!link.ends_with(kEnd)) return false;
  link.remove_suffix(kEnd.size());
  return link.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == link.npos;
}

class MarkupReader {
 public:
  explicit MarkupReader(std::string_view text) : whole_(text), rest_(text) {}

  void read() {
    demand(first_invalid_utf8(whole_) == whole_.npos, "a page is UTF-8", whole_);
    if (rest_.starts_with("<!doctype html>")) rest_.remove_prefix(15);
    while (!rest_.empty()) rest_.front() == '<' ? read_tag() : read_character();
    expect(open_.empty(), "every element is closed");
    expect(scripts_ == 0 || scripts_ == 2, "a page has its data and its script");
  }

 private:
  void expect(bool holds, std::string_view what) const {
    const std::size_t at = whole_.size() - rest_.size(), before = std::min<std::size_t>(at, 300);
    if (!holds) demand(false, what, whole_.substr(at - before, before + 300));
  }

  std::string_view take(std::size_t size) {
    expect(size <= rest_.size(), "markup ends");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  void read_character() {
    const char c = rest_.front();
    if (c == '&') {
      const auto entity = std::find_if(std::begin(kEntities), std::end(kEntities),
                                       [&](std::string_view known) { return rest_.starts_with(known); });
      expect(entity != std::end(kEntities), "an ampersand begins an entity");
      take(entity->size());
      return;
    }
    const auto [code, size] = first_character(rest_);
    expect(c == '\n' || c == '\t' || c == '\r' || !is_unseen(code), "every character can be seen");
    take(size);
  }

  void read_tag() {
    const bool closes = rest_.starts_with("</");
    take(closes ? 2 : 1);
    const std::string name(take(rest_.find_first_of(" />\n")));
    expect(is_one_of(name, kElements), "an element of the program's own");
    if (closes) {
      expect(!open_.empty() && open_.back() == name && rest_.starts_with('>'), "elements are closed in their order");
      take(1);
      open_.pop_back();
      return;
    }
    std::string type;
    while (rest_.starts_with(' ') || rest_.starts_with('\n')) read_attribute(type);
    if (rest_.starts_with("/>")) {
      take(2);
      return;
    }
    expect(rest_.starts_with('>'), "a tag ends");
    take(1);
    if (name == "script" || name == "style")
      read_raw("</" + name + ">", name, type);
    else if (!is_one_of(name, kEmptyElements))
      open_.push_back(name);
  }

  void read_attribute(std::string& type) {
    take(rest_.find_first_not_of(" \n"));
    const std::string name(take(rest_.find_first_of("=/> \n")));
    if (name.empty()) return;
    expect(is_one_of(name, kAttributes), "an attribute of the program's own: " + name);
    if (!rest_.starts_with('=')) return;
    expect(rest_.starts_with("=\""), "an attribute is quoted");
    take(2);
    const std::size_t before = whole_.size() - rest_.size();
    while (!rest_.starts_with('"')) {
      expect(!rest_.empty() && rest_.front() != '<', "an attribute ends, and has no tag");
      read_character();
    }
    const std::string_view value = whole_.substr(before, whole_.size() - rest_.size() - before);
    take(1);
    if (name == "href")
      expect(value.starts_with('#') || value == "data:," || is_page_beside(value),
             "a link stays within the page or its gallery");
    if (name == "type") type = value;
  }

  void read_raw(const std::string& close, const std::string& name, const std::string& type) {
    const std::string_view content = take(rest_.find(close));
    take(close.size());
    if (name != "script") return;
    ++scripts_;
    if (type != "application/json") return;
    expect(content.find_first_of("<&") == content.npos, "the page's data have no markup");
    check_json(content);
  }

  std::string_view whole_, rest_;
  std::vector<std::string> open_;
  int scripts_ = 0;
};

}  // namespace

void check_markup(std::string_view text) { MarkupReader(text).read(); }

}  // namespace earthtop::fuzz
