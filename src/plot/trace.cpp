// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace earthtop {
namespace {

/// Width of a band's columns (px). Two strokes of a line fill most of it: a swing that takes less cannot be seen as one.
constexpr double kColumn = 4;
constexpr double kLeastBand = 3 * kColumn;  // a shorter stretch is drawn as a line (px)
constexpr double kFlat = 0.15;              // what lies as near to a straight line is drawn as one (px)
constexpr double kLeastSwing = 2 * kFlat;   // smaller ones do not count (px)
constexpr double kSeenBand = 1.5;           // a band that is nowhere as high looks like a line, and is called one (px)

/// A point of a line, with its number among all points of the line.
struct Numbered {
  PlotPoint place;
  std::size_t number;
};

/// The numbers of the points at which a piece turns by more than can be overlooked.
std::vector<std::size_t> turning_points(std::span<const Numbered> piece) {
  std::vector<std::size_t> found;
  std::size_t low = 0, high = 0;
  int direction = 0;
  for (std::size_t i = 1; i < piece.size(); ++i) {
    const double y = piece[i].place.y;
    if (y < piece[low].place.y) low = i;
    if (y > piece[high].place.y) high = i;
    if (direction >= 0 && y < piece[high].place.y - kLeastSwing) {
      if (direction > 0) found.push_back(high);
      direction = -1, low = i;
    } else if (direction <= 0 && y > piece[low].place.y + kLeastSwing) {
      if (direction < 0) found.push_back(low);
      direction = 1, high = i;
    }
  }
  return found;
}

/// Points from `begin` to `end`, inclusive, of a piece.
struct Reach {
  std::size_t begin, end;
};

/// The parts of a piece in which it swings within less than a column.
std::vector<Reach> dense_parts(std::span<const Numbered> piece) {
  const std::vector<std::size_t> turning = turning_points(piece);
  const auto x = [&](std::size_t i) { return piece[i].place.x; };
  std::vector<Reach> parts;
  for (std::size_t i = 0; i + 2 < turning.size(); ++i) {
    const std::size_t begin = turning[i], end = turning[i + 2];
    if (x(end) - x(begin) >= kColumn) continue;
    if (!parts.empty() && x(begin) - x(parts.back().end) < kLeastBand)
      parts.back().end = end;  // a short stretch with smaller swings is no line of its own
    else
      parts.push_back({begin, end});
  }
  // The rests at the ends of the piece, less than a column, are part of the band.
  if (!parts.empty() && x(parts.front().begin) - x(0) < kColumn) parts.front().begin = 0;
  if (!parts.empty() && x(piece.size() - 1) - x(parts.back().end) < kColumn) parts.back().end = piece.size() - 1;
  std::erase_if(parts, [&](const Reach& part) { return x(part.end) - x(part.begin) < kLeastBand; });
  return parts;
}

/// Least and largest values (px, downward).
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(const Span& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
  bool empty() const { return low > high; }
};

/// A band between edges with the same places.
Stretch band_between(std::vector<PlotPoint> upper, std::vector<PlotPoint> lower) {
  Stretch band;
  for (std::size_t i = 0; i < upper.size(); ++i) band.height = std::max(band.height, lower[i].y - upper[i].y);
  thin_out(upper), thin_out(lower);
  band.upper = std::move(upper), band.lower = std::move(lower);
  return band;
}

/// A band over points of a piece. Its corners are half a column apart, and each stands for the columns around it, so that no point lies
/// outside of the straight edges between two of them.
Stretch band_over(std::span<const Numbered> points) {
  const double left = points.front().place.x, width = points.back().place.x - left;
  const auto halves = static_cast<std::size_t>(std::floor(width / (kColumn / 2)));
  const double half = width / static_cast<double>(halves);
  std::vector<Span> spans(halves);
  for (const auto& [place, number] : points)
    spans[std::min(static_cast<std::size_t>((place.x - left) / half), halves - 1)].include({place.y, place.y});
  std::vector<PlotPoint> upper, lower;
  for (std::size_t k = 0; k <= halves; ++k) {
    Span span = spans[std::min(k, halves - 1)];
    if (k > 0) span.include(spans[k - 1]);
    if (span.empty()) continue;
    const double x = left + half * static_cast<double>(k);
    upper.push_back({x, span.low}), lower.push_back({x, span.high});
  }
  return band_between(std::move(upper), std::move(lower));
}

/// A band with a corner for each window of points.
Stretch band_of_windows(std::span<const Numbered> points, std::size_t a_window) {
  std::vector<PlotPoint> upper, lower;
  for (std::size_t i = 0; i < points.size();) {
    const std::size_t window = points[i].number / a_window, begin = i;
    Span span;
    for (; i < points.size() && points[i].number / a_window == window; ++i)
      span.include({points[i].place.y, points[i].place.y});
    const double x = begin == 0           ? points.front().place.x
                     : i == points.size() ? points.back().place.x
                                          : (points[begin].place.x + points[i - 1].place.x) / 2;
    upper.push_back({x, span.low}), lower.push_back({x, span.high});
  }
  return band_between(std::move(upper), std::move(lower));
}

/// Points of a line. If many fall into one column of half a pixel, only the first, lowest, highest and last of them are kept, which
/// give the same picture, and of those on a straight line its ends.
Stretch line_over(std::span<const Numbered> points) {
  Stretch line;
  for (std::size_t i = 0; i < points.size();) {
    const double column = std::floor(points[i].place.x * 2);
    const PlotPoint first = points[i].place;
    PlotPoint low = first, high = first, last = first;
    for (; i < points.size() && std::floor(points[i].place.x * 2) == column; ++i) {
      last = points[i].place;
      if (last.y < low.y) low = last;
      if (last.y > high.y) high = last;
    }
    if (high.x < low.x) std::swap(low, high);
    line.upper.push_back(first);
    for (const PlotPoint& point : {low, high})
      if (point != first && point != last) line.upper.push_back(point);
    if (last != first) line.upper.push_back(last);
  }
  thin_out(line.upper);
  return line;
}

/// A motion that was looked at in windows, between which it is unknown. It swings in each, or is slower. Where it also swings from window
/// to window too fast to be followed, a dozen of them make a corner.
Stretch of_windows(std::span<const Numbered> points, std::size_t a_window) {
  constexpr std::size_t kFollowed = 8, kMany = 12;  // windows in a swing
  const std::size_t windows = points.size() / a_window;
  if (2 * turning_points(points).size() < windows || windows < 2) return line_over(points);
  std::vector<Numbered> means;
  for (std::size_t i = 0; i < points.size();) {
    const std::size_t window = points[i].number / a_window, begin = i;
    double sum = 0;
    for (; i < points.size() && points[i].number / a_window == window; ++i) sum += points[i].place.y;
    means.push_back({{points[begin].place.x, sum / static_cast<double>(i - begin)}, begin});
  }
  const bool jumps = kFollowed * turning_points(means).size() > 2 * windows;
  return band_of_windows(points, jumps ? kMany * a_window : a_window);
}

Piece piece_of(std::span<const Numbered> points, std::size_t a_column) {
  if (a_column > 0) return {of_windows(points, a_column)};
  const std::vector<Reach> dense = dense_parts(points);
  if (dense.empty()) return {line_over(points)};
  Piece piece;
  std::size_t drawn = 0;  // the last point that is drawn
  for (const Reach& part : dense) {
    if (part.begin > drawn) piece.push_back(line_over(points.subspan(drawn, part.begin - drawn + 1)));
    piece.push_back(band_over(points.subspan(part.begin, part.end - part.begin + 1)));
    drawn = part.end;
  }
  if (drawn + 1 < points.size()) piece.push_back(line_over(points.subspan(drawn)));
  return piece;
}

}  // namespace

void thin_out(std::vector<PlotPoint>& points) {
  const auto size = [](double x, double y) { return std::sqrt(x * x + y * y); };
  if (points.size() < 3) return;
  std::vector<bool> stays(points.size(), false);
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    const PlotPoint a = points[begin], b = points[end];
    const double length = size(b.x - a.x, b.y - a.y);
    double farthest = 0;
    std::size_t at = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double x = points[i].x - a.x, y = points[i].y - a.y;
      const double along = length > 0 ? (x * (b.x - a.x) + y * (b.y - a.y)) / length : 0;
      const double across = length > 0 ? std::abs(x * (b.y - a.y) - y * (b.x - a.x)) / length : size(x, y);
      const double away = std::max({across, -along, along - length});
      if (away > farthest) farthest = away, at = i;
    }
    if (farthest <= kFlat) continue;
    stays[at] = true;
    open.emplace_back(begin, at), open.emplace_back(at, end);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (stays[i]) points[kept++] = points[i];
  points.resize(kept);
}

bool Trace::shows_band() const {
  return std::ranges::any_of(pieces, [](const Piece& piece) {
    return std::ranges::any_of(piece, [](const Stretch& s) { return s.height >= kSeenBand; });
  });
}

Trace trace_of(const Line& line, const Mapping& x, const Mapping& y) {
  Trace trace;
  std::vector<Numbered> points;
  const auto end_piece = [&] {
    if (!points.empty()) trace.pieces.push_back(piece_of(points, line.a_column));
    points.clear();
  };
  const std::size_t count = std::min(line.x.size(), line.y.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (!drawable(line.x[i], x.scale) || !drawable(line.y[i], y.scale)) {
      end_piece();
      continue;
    }
    points.push_back({{x(line.x[i]), y(line.y[i])}, i});
  }
  end_piece();
  return trace;
}

}  // namespace earthtop
