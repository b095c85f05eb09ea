// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "plot/strokes.hpp"
#include "plot/svg_text.hpp"

namespace earthtop {
namespace {

constexpr double kRow = 17, kEntryGap = 18;  // px

double caption_width(const Panel& panel) {
  return 7.5 * static_cast<double>(character_count(panel.y.label) + character_count(panel.y.unit) + 3);
}

}  // namespace

Legend::Legend(const Panel& panel, const std::vector<Trace>& traces, const Sheet& sheet) : sheet_(&sheet) {
  double width = 0, widest = 0;
  for (std::size_t i = 0; i < panel.lines.size(); ++i) {
    const Line& line = panel.lines[i];
    if (line.label.empty()) continue;
    const bool is_band = traces[i].shows_band();
    std::string label = shorten(line.label + std::string(is_band ? kBandWords : ""), sheet.legend_characters);
    const double needed = kCharacter * static_cast<double>(character_count(label)) + 8 + 22 + kEntryGap;
    entries_.push_back({&line, std::move(label), is_band, needed});
    width += needed;
    widest = std::max(widest, needed);
  }
  const double room = sheet.width - sheet.text_left - sheet.right;
  if (entries_.empty() || caption_width(panel) + width <= room) return;
  if (sheet.legend_as_text)
    place_as_text(room);
  else
    place_in_columns(room, widest);
}

void Legend::draw_entry(std::string& out, const Entry& entry, double left, double baseline) {
  const Line& line = *entry.line;
  if (line.style == LineStyle::filled || entry.is_band)
    fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}h22v8h-22z\" fill=\"{}\" fill-opacity=\"{}\"/>\n", left,
                   baseline - (entry.is_band ? 8 : 4), hex(line.color), entry.is_band ? kBandOpacity : 0.15);
  if (line.style == LineStyle::bars)
    fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}v-10h14v10z\" fill=\"{}\" fill-opacity=\"0.3\" stroke=\"{}\"/>\n",
                   left + 4, baseline, hex(line.color), hex(line.color));
  if (!line.error.empty()) draw_error_bar(out, line, left + 11, baseline + 1, baseline - 9);
  const double width = line.style == LineStyle::broad ? stroke_width(line.style) : 2;
  if (line.style != LineStyle::points && line.style != LineStyle::bars)
    fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}h22\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", left, baseline - 4,
                   hex(line.color), width, stroke_kind(line.style));
  draw_marker(out, line, left + 11, baseline - 4);
  draw_text(out, left + 30, baseline, "start", "", entry.label);
}

void Legend::place_in_columns(double room, double widest) {
  const std::size_t columns = std::max<std::size_t>(1, static_cast<std::size_t>(room / widest));
  rows_ = (entries_.size() + columns - 1) / columns;
  for (std::size_t i = 0; i < entries_.size(); ++i)
    places_.push_back({i / columns, room / static_cast<double>(columns) * static_cast<double>(i % columns)});
}

void Legend::place_as_text(double room) {
  double right = room;  // so that the first entry begins a row
  for (const Entry& entry : entries_) {
    if (right + entry.width > room + kEntryGap) {  // nothing follows the last entry of a row
      ++rows_;
      right = 0;
    }
    places_.push_back({rows_ - 1, right});
    right += entry.width;
  }
}

double Legend::height() const { return kRow * static_cast<double>(rows_); }

void Legend::draw(std::string& out, double baseline) const {
  if (entries_.empty()) return;
  if (rows_ > 0) {
    const double top = baseline - height() + kRow;
    for (std::size_t i = 0; i < entries_.size(); ++i)
      draw_entry(out, entries_[i], sheet_->text_left + places_[i].left, top + kRow * static_cast<double>(places_[i].row));
    return;
  }
  double right = sheet_->width - sheet_->right + kEntryGap;
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    right -= entry->width;
    draw_entry(out, *entry, right, baseline);
  }
}

}  // namespace earthtop
