// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/largest.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "drift/watch/close_in.hpp"

namespace earthtop {
namespace {

constexpr std::size_t kNodes = 14, kMostNodes = kNodes + 2;

/// The polynomial through evenly spaced values, by Newton's divided differences; its argument counts looks from the first node.
class Through {
 public:
  explicit Through(std::span<const double> values) : count_(values.size()) {
    std::copy(values.begin(), values.end(), differences_.begin());
    for (std::size_t k = 1; k < count_; ++k)
      for (std::size_t i = count_ - 1; i >= k; --i)
        differences_[i] = (differences_[i] - differences_[i - 1]) / static_cast<double>(k);
  }
  struct At {
    double value, slope;
  };
  At at(double x) const {
    At sum{0, 0};
    for (std::size_t k = count_; k-- > 0;) {
      const double apart = x - static_cast<double>(k);
      sum.slope = sum.slope * apart + sum.value;
      sum.value = sum.value * apart + differences_[k];
    }
    return sum;
  }
  /// How much larger than the values' errors that of the polynomial may be: the sum of the sizes of Lagrange's polynomials. Between
  /// the nodes in the middle it is some 2, and errors are alike there, so that it counts as 1.
  double amplification(double x) const {
    const auto last = static_cast<double>(count_ - 1);
    if (x >= last / 4 && x <= 3 * last / 4) return 1;
    double sum = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      double part = 1;
      for (std::size_t i = 0; i < count_; ++i)
        if (i != k) part *= (x - static_cast<double>(i)) / (static_cast<double>(k) - static_cast<double>(i));
      sum += std::abs(part);
    }
    return sum;
  }

 private:
  std::size_t count_;
  std::array<double, kMostNodes> differences_{};
};

/// The nodes nearest to a look, of those from `begin` to `end`: the number of the first one.
std::size_t first_node(std::size_t look, std::size_t begin, std::size_t end, std::size_t nodes) {
  const std::size_t half = nodes / 2;
  return std::clamp(look >= begin + half ? look - half : begin, begin, end - std::min(nodes, end - begin));
}

/// Numbers of the looks from which a function is defined without a gap.
struct Piece {
  std::size_t begin, end;
};
std::vector<Piece> pieces_of(std::span<const double> values) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < values.size();) {
    while (i < values.size() && std::isnan(values[i])) ++i;
    const std::size_t begin = i;
    while (i < values.size() && !std::isnan(values[i])) ++i;
    if (i > begin) pieces.push_back({begin, i});
  }
  return pieces;
}

/// Returns how far a parabola through a look and its neighbours rises above the look.
double rise(std::span<const double> values, const Piece& piece, std::size_t i) {
  if (i == piece.begin || i + 1 == piece.end) return 0;
  const double slope = (values[i + 1] - values[i - 1]) / 2, bend = 2 * values[i] - values[i + 1] - values[i - 1];
  return bend > 0 ? slope * slope / (2 * bend) : 0;
}

/// The largest value within one look of look i, where no look of the piece is larger than its neighbours.
Largest top_near(std::span<const double> times_s, std::span<const double> values, const Piece& piece, std::size_t i) {
  Largest top{times_s[i], values[i], 0, i};
  if (piece.end - piece.begin < 2) return top;
  const double step = piece.end - piece.begin > 1
                          ? (times_s[piece.end - 1] - times_s[piece.begin]) / static_cast<double>(piece.end - piece.begin - 1)
                          : 0;
  double first_value = 0;
  for (const std::size_t nodes : {kNodes, kMostNodes}) {
    const std::size_t count = std::min(nodes, piece.end - piece.begin), first = first_node(i, piece.begin, piece.end, nodes);
    const Through polynomial(values.subspan(first, count));
    const double x = static_cast<double>(i - first), from = i == piece.begin ? x : x - 1, to = i + 1 == piece.end ? x : x + 1;
    double root = x;
    const double left = polynomial.at(from).slope, right = polynomial.at(to).slope;
    if (left > 0 && right < 0)
      close_in(
          from, left, to, right,
          [&](double at) {
            root = at;
            return polynomial.at(at).slope;
          },
          [] { return false; });
    const double value = polynomial.at(root).value;
    if (nodes == kNodes) {
      first_value = value;
      continue;
    }
    if (root == x) return top;
    top.error = std::abs(value - first_value);
    if (!(value > top.value)) continue;
    top.value = value, top.t_s = times_s[i] + (root - x) * step;
    top.amplified = polynomial.amplification(root);
  }
  return top;
}

}  // namespace

std::optional<Largest> largest_of(std::span<const double> times_s, std::span<const double> values) {
  // Twelve looks a period see a swing of amplitude A at most 0.034 A below its top. The parabola leaves a tenth of that.
  constexpr double kLeftOut = 0.3;
  std::optional<Largest> largest;
  const std::vector<Piece> pieces = pieces_of(values);
  double most = -HUGE_VAL, highest_rise = 0;
  const auto each_top = [&](const auto& visit) {
    for (const Piece& piece : pieces)
      for (std::size_t i = piece.begin; i < piece.end; ++i)
        if ((i == piece.begin || values[i] >= values[i - 1]) && (i + 1 == piece.end || values[i] >= values[i + 1]))
          visit(piece, i);
  };
  each_top([&](const Piece& piece, std::size_t i) {
    const double above = rise(values, piece, i);
    most = std::max(most, values[i] + above), highest_rise = std::max(highest_rise, above);
  });
  each_top([&](const Piece& piece, std::size_t i) {
    const bool at_end = i == piece.begin || i + 1 == piece.end;  // where no parabola tells how much higher it goes
    if (!at_end && values[i] + rise(values, piece, i) < most - kLeftOut * highest_rise) return;
    const Largest top = top_near(times_s, values, piece, i);
    if (!largest || top.value > largest->value) largest = top;
  });
  return largest;
}

std::optional<double> first_passing(std::span<const double> times_s, std::span<const double> values, double level) {
  constexpr double kRises = 2;  // a parabola leaves a tenth of how much higher a swing goes than its highest look
  for (const Piece& piece : pieces_of(values))
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      double above_s = times_s[i], above = values[i];
      if (above < level) {
        const bool is_top = i > piece.begin && i + 1 < piece.end && above >= values[i - 1] && above >= values[i + 1];
        if (!is_top || above + kRises * rise(values, piece, i) < level) continue;
        const Largest top = top_near(times_s, values, piece, i);
        above_s = top.t_s, above = top.value;
        if (above < level) continue;
      }
      if (i == piece.begin) return times_s[i];
      const std::size_t count = std::min(kNodes, piece.end - piece.begin),
                        first = first_node(i, piece.begin, piece.end, kNodes);
      const Through polynomial(values.subspan(first, count));
      const double step_s = times_s[i] - times_s[i - 1], before = static_cast<double>(i - first) - 1;
      const double end = before + (above_s - times_s[i - 1]) / step_s;
      double root = end;
      close_in(
          before, values[i - 1] - level, end, above - level,
          [&](double at) {
            root = at;
            return polynomial.at(at).value - level;
          },
          [] { return false; });
      return times_s[i - 1] + (root - before) * step_s;
    }
  return std::nullopt;
}

}  // namespace earthtop
