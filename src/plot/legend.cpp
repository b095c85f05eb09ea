// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/legend.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plot/strokes.hpp"
#include "plot/svg_text.hpp"

namespace earthtop {
namespace {

constexpr double kRow = 17, kEntryGap = 18;  // px

std::string label_of(const Line& line, const Sheet& sheet) { return shorten(line.label, sheet.legend_characters); }

double legend_width(const Line& line, const Sheet& sheet) {
  return kCharacter * static_cast<double>(character_count(label_of(line, sheet))) + 8 + 22 + kEntryGap;
}

double caption_width(const Panel& panel) {
  return 7.5 * static_cast<double>(character_count(panel.y.label) + character_count(panel.y.unit) + 3);
}

void draw_legend_entry(std::string& out, const Line& line, const Sheet& sheet, double left, double baseline) {
  if (line.style == LineStyle::filled)
    fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}h22v8h-22z\" fill=\"{}\" fill-opacity=\"0.15\"/>\n", left, baseline - 4,
                   hex(line.color));
  if (line.style == LineStyle::bars)
    fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}v-10h14v10z\" fill=\"{}\" fill-opacity=\"0.3\" stroke=\"{}\"/>\n",
                   left + 4, baseline, hex(line.color), hex(line.color));
  if (!line.error.empty()) draw_error_bar(out, line, left + 11, baseline + 1, baseline - 9);
  const double width = line.style == LineStyle::broad ? stroke_width(line.style) : 2;
  if (line.style != LineStyle::points && line.style != LineStyle::bars)
    fmt::format_to(Out(out), "<path d=\"M{:.2f} {:.2f}h22\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", left, baseline - 4,
                   hex(line.color), width, stroke_kind(line.style));
  draw_marker(out, line, left + 11, baseline - 4);
  draw_text(out, left + 30, baseline, "start", "", label_of(line, sheet));
}

}  // namespace

Legend::Legend(const Panel& panel, const Sheet& sheet) : sheet_(&sheet) {
  double width = 0, widest = 0;
  for (const Line& line : panel.lines) {
    if (line.label.empty()) continue;
    lines_.push_back(&line);
    width += legend_width(line, sheet);
    widest = std::max(widest, legend_width(line, sheet));
  }
  const double room = sheet.width - sheet.text_left - sheet.right;
  if (lines_.empty() || caption_width(panel) + width <= room) return;
  if (sheet.legend_as_text)
    place_as_text(room);
  else
    place_in_columns(room, widest);
}

void Legend::place_in_columns(double room, double widest) {
  const std::size_t columns = std::max<std::size_t>(1, static_cast<std::size_t>(room / widest));
  rows_ = (lines_.size() + columns - 1) / columns;
  for (std::size_t i = 0; i < lines_.size(); ++i)
    places_.push_back({i / columns, room / static_cast<double>(columns) * static_cast<double>(i % columns)});
}

void Legend::place_as_text(double room) {
  double right = room;  // so that the first entry begins a row
  for (const Line* line : lines_) {
    const double width = legend_width(*line, *sheet_);
    if (right + width > room + kEntryGap) {  // nothing follows the last entry of a row
      ++rows_;
      right = 0;
    }
    places_.push_back({rows_ - 1, right});
    right += width;
  }
}

double Legend::height() const { return kRow * static_cast<double>(rows_); }

void Legend::draw(std::string& out, double baseline) const {
  if (rows_ > 0) {
    const double top = baseline - height() + kRow;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      draw_legend_entry(out, *lines_[i], *sheet_, sheet_->text_left + places_[i].left,
                        top + kRow * static_cast<double>(places_[i].row));
    return;
  }
  double right = sheet_->width - sheet_->right + kEntryGap;
  for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
    right -= legend_width(**line, *sheet_);
    draw_legend_entry(out, **line, *sheet_, right, baseline);
  }
}

}  // namespace earthtop
