// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/packed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace earthtop::report {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
/// A path fills a picture of 500 px: zoomed in a thousand times, a step of the axes is half a pixel.
constexpr int kAxisBits = 20;

void append(std::string& text, std::int64_t number) {
  auto rest = static_cast<std::uint64_t>(number < 0 ? -2 * number - 1 : 2 * number);
  for (; rest >= 32; rest >>= 5U) text += kAlphabet[32 + rest % 32];
  text += kAlphabet[rest];
}

std::vector<double> component(std::span<const double> vectors, std::size_t which) {
  std::vector<double> list;
  list.reserve(vectors.size() / 3);
  for (std::size_t i = which; i < vectors.size(); i += 3) list.push_back(vectors[i]);
  return list;
}

}  // namespace

Json packed(std::span<const double> list, int bits) {
  if (list.empty()) return {{"from", 0}, {"unit", 0}, {"text", ""}};
  const auto [low, high] = std::ranges::minmax(list);
  const double unit = (high - low) / static_cast<double>(std::int64_t{1} << bits);
  std::string text;
  std::int64_t last = 0, before = 0;
  for (const double number : list) {
    const std::int64_t step = unit > 0 ? std::llround((number - low) / unit) : 0;
    append(text, step - 2 * last + before);
    before = last, last = step;
  }
  return {{"from", low}, {"unit", unit}, {"text", std::move(text)}};
}

Json packed_axes(std::span<const double> axis, std::span<const double> reference) {
  constexpr double kAway = 0.3;
  std::array<std::vector<double>, 3> first, apart;
  std::size_t dropped = 3;
  double farthest = kAway, sign = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    first[k] = component(reference, k), apart[k] = component(axis, k);
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto* list : {&first[k], &apart[k]})
      for (const double number : *list) least = std::min(least, number), most = std::max(most, number);
    for (std::size_t i = 0; i < apart[k].size(); ++i) apart[k][i] -= first[k][i];
    if (std::max(least, -most) > farthest) farthest = std::max(least, -most), dropped = k, sign = least > 0 ? 1 : -1;
  }
  Json json = {
      {"count", reference.size() / 3}, {"dropped", dropped}, {"sign", sign}, {"ref", Json::array()}, {"off", Json::array()}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == dropped) continue;
    json["ref"].push_back(packed(first[k], kAxisBits));
    json["off"].push_back(packed(apart[k], kAxisBits));
  }
  return json;
}

Json packed_times(std::span<const double> times_s) {
  constexpr double kEqual = 1e-9;  // of the whole
  const std::size_t count = times_s.size();
  bool even = count > 1;
  for (std::size_t i = 0; i < count && even; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1), whole = times_s.back() - times_s.front();
    even = std::abs(times_s[i] - (times_s.front() + share * whole)) <= kEqual * whole;
  }
  if (even) return {{"from", times_s.front()}, {"to", times_s.back()}, {"count", count}};
  return std::vector<double>(times_s.begin(), times_s.end());
}

}  // namespace earthtop::report
