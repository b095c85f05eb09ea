// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/line_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/svg_text.hpp"

namespace earthtop {
namespace {

constexpr double kHeight = 14, kGap = 5, kEndGap = 8;  // of a text, and between it and its line or its dot (px)
constexpr double kWide = 1.15;                         // on a tablet letters are larger
constexpr double kClear = 7;      // as near as this another line would seem to be the one that is named (px)
constexpr double kLevel = 60;     // a line that falls or rises by more along its label is not seen as its line (px)
constexpr double kFarthest = 60;  // from a dot to its text (px)
constexpr double kStep = 12;      // between the places that are tried (px)

struct Box {
  double left, right, top, bottom;
};

double width_of(const std::string& words) { return kWide * kCharacter * static_cast<double>(character_count(words)); }

/// For each px from the panel's left edge, the reach of a line there (px, downward).
class Silhouette {
 public:
  Silhouette(const Trace& trace, const Mapping& x)
      : left_(x.from), columns_(static_cast<std::size_t>(std::max(1.0, std::ceil(x.to - x.from) + 1))) {
    for (const Piece& piece : trace.pieces)
      for (const Stretch& stretch : piece)
        for (const std::vector<PlotPoint>* edge : {&stretch.upper, &stretch.lower}) add(*edge);
  }
  struct Reach {
    double top = std::numeric_limits<double>::infinity(), bottom = -std::numeric_limits<double>::infinity();
    void include(const Reach& other) { top = std::min(top, other.top), bottom = std::max(bottom, other.bottom); }
    bool empty() const { return top > bottom; }
  };
  /// The reach between two places; empty where the line is not.
  Reach over(double from, double to) const {
    Reach reach;
    for (std::size_t i = column(from); i <= column(to); ++i) reach.include(columns_[i]);
    return reach;
  }
  bool is_everywhere(double from, double to) const {
    for (std::size_t i = column(from); i <= column(to); ++i)
      if (columns_[i].empty()) return false;
    return true;
  }
  /// Whether the line comes nearer to a box than some px.
  bool meets(const Box& box, double clear) const {
    for (std::size_t i = column(box.left); i <= column(box.right); ++i)
      if (columns_[i].top < box.bottom + clear && columns_[i].bottom > box.top - clear) return true;
    return false;
  }

 private:
  std::size_t column(double x) const {
    const double at = std::clamp(std::floor(x - left_), 0.0, static_cast<double>(columns_.size() - 1));
    return static_cast<std::size_t>(at);
  }
  void add(const std::vector<PlotPoint>& edge) {
    for (std::size_t i = 0; i < edge.size(); ++i) {
      const PlotPoint a = edge[i], b = edge[std::min(i + 1, edge.size() - 1)];
      const std::size_t first = column(std::min(a.x, b.x)), last = column(std::max(a.x, b.x));
      for (std::size_t k = first; k <= last; ++k) {
        const auto y_at = [&](double x) {
          return b.x == a.x ? b.y : a.y + std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0) * (b.y - a.y);
        };
        const double from = y_at(left_ + static_cast<double>(k)), to = y_at(left_ + static_cast<double>(k) + 1);
        const bool is_steep = first == last;
        columns_[k].include(
            {is_steep ? std::min(a.y, b.y) : std::min(from, to), is_steep ? std::max(a.y, b.y) : std::max(from, to)});
      }
    }
  }

  double left_;
  std::vector<Reach> columns_;
};

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// The panel with what is in it.
struct Room {
  double left, right, height;
  std::vector<Silhouette> lines;
  std::vector<Box> taken;
  bool is_free(const Box& box) const {
    return box.left >= left && box.right <= right && box.top >= 0 && box.bottom <= height &&
           std::ranges::none_of(taken, [&](const Box& other) { return overlap(box, other); });
  }
};

/// A place above or below a line, the more level it is there and the farther right the better.
std::optional<Box> place_beside(const Room& room, std::size_t line, double width) {
  std::optional<Box> best;
  double least = std::numeric_limits<double>::infinity();
  for (double right = room.right - 2; right - width >= room.left; right -= kStep) {
    const double left = right - width;
    if (!room.lines[line].is_everywhere(left, right)) continue;
    const Silhouette::Reach reach = room.lines[line].over(left, right);
    // Above a band only its upper edge counts.
    const Silhouette::Reach at_left = room.lines[line].over(left, left), at_right = room.lines[line].over(right, right);
    for (const bool above : {true, false}) {
      const double bottom = above ? reach.top - kGap : reach.bottom + kGap + kHeight;
      const Box box{left, right, bottom - kHeight, bottom};
      const double slope =
          above ? std::max(at_left.top, at_right.top) - reach.top : reach.bottom - std::min(at_left.bottom, at_right.bottom);
      const double cost = slope + 0.05 * (room.right - right);
      if (slope > kLevel || cost >= least || !room.is_free(box)) continue;
      bool is_clear = true;
      for (std::size_t i = 0; i < room.lines.size(); ++i)
        is_clear = is_clear && (i == line || !room.lines[i].meets(box, kClear));
      if (is_clear) best = box, least = cost;
    }
  }
  return best;
}

/// A place for the text of a line's end: above or below its dot, as near as there is one; right above it where all are taken.
Box place_of_end(const Room& room, PlotPoint end, double width) {
  const double right = std::min(end.x + 4, room.right);
  const auto box_at = [&](double x, double bottom) { return Box{x - width, x, bottom - kHeight, bottom}; };
  for (double away = kEndGap; away < kFarthest; away += kEndGap)
    for (const double bottom : {end.y - away, end.y + away + kHeight}) {
      const Box box = box_at(right, bottom);
      if (room.is_free(box) && std::ranges::none_of(room.lines, [&](const Silhouette& line) { return line.meets(box, 1); }))
        return box;
    }
  return box_at(right, std::max(end.y - kEndGap, kHeight));
}

std::optional<PlotPoint> last_point(const Line& line, const Mapping& x, const Mapping& y) {
  for (std::size_t i = std::min(line.x.size(), line.y.size()); i-- > 0;)
    if (drawable(line.x[i], x.scale) && drawable(line.y[i], y.scale)) return PlotPoint{x(line.x[i]), y(line.y[i])};
  return std::nullopt;
}

}  // namespace

LineLabels::LineLabels(const Panel& panel, const std::vector<Trace>& traces, const Mapping& x, const Mapping& y) {
  const bool has_end = std::ranges::any_of(panel.lines, [](const Line& line) { return !line.end_label.empty(); });
  if (!has_end && !panel.labels_at_lines) return;
  Room room{x.from, x.to, y.from, {}, {}};
  for (const Trace& trace : traces) room.lines.emplace_back(trace, x);
  for (const Line& line : panel.lines) {
    if (line.end_label.empty()) continue;
    const std::optional<PlotPoint> end = last_point(line, x, y);
    if (!end) continue;
    const Box box = place_of_end(room, *end, 1.1 * width_of(line.end_label));
    room.taken.push_back(box);
    dots_.push_back({&line, end->x, end->y});
    texts_.push_back({line.end_label, box.right, box.bottom - 3, true});
  }
  if (!panel.labels_at_lines) return;
  std::vector<Text> names;
  for (std::size_t i = 0; i < panel.lines.size(); ++i) {
    if (panel.lines[i].label.empty()) continue;
    const std::string& words = panel.lines[i].label;
    const std::optional<Box> box = place_beside(room, i, width_of(words));
    if (!box) return;  // then all stand in the legend
    room.taken.push_back(*box);
    names.push_back({words, box->right, box->bottom - 3, false});
  }
  names_all_ = true;
  texts_.insert(texts_.end(), names.begin(), names.end());
}

void LineLabels::draw(std::string& out, double top) const {
  for (const Dot& dot : dots_)
    fmt::format_to(Out(out), "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4.5\" fill=\"{}\"/>\n", dot.x, top + dot.y,
                   hex(dot.line->color));
  for (const Text& text : texts_)
    draw_text(out, text.right, top + text.baseline, "end", text.is_end ? " class=\"et-b\"" : "", text.words);
}

bool has_room_for_end(double y) { return y >= kEndGap + kHeight; }

}  // namespace earthtop
