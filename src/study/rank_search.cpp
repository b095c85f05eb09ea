// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/rank_search.hpp"

#include <algorithm>
#include <bit>

namespace earthtop::study {
namespace {

constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

/// Bits of a number, changed so that they are in the order of the numbers. (The bits of negative numbers are in the opposite
/// order.)
std::uint64_t key_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

double number_of_key(std::uint64_t key) { return std::bit_cast<double>((key & kSign) != 0 ? key & ~kSign : ~key); }

}  // namespace

RankSearch::RankSearch(const std::vector<std::uint64_t>& ranks) {
  ranks_.reserve(ranks.size());
  for (const std::uint64_t rank : ranks) ranks_.push_back({rank, 0, std::vector<std::uint64_t>(std::size_t{1} << kBits)});
}

void RankSearch::include(double x) {
  const std::uint64_t key = key_of(x) >> shift_, prefix = key >> width_;
  for (Rank& rank : ranks_)
    if (rank.prefix == prefix) ++rank.counts[key & ((std::uint64_t{1} << width_) - 1)];
}

void RankSearch::end_pass() {
  for (Rank& rank : ranks_) {
    std::uint64_t digit = 0;
    const std::uint64_t last = (std::uint64_t{1} << width_) - 1;
    while (digit < last && rank.left >= rank.counts[digit]) rank.left -= rank.counts[digit++];
    rank.prefix = rank.prefix << width_ | digit;
    std::fill(rank.counts.begin(), rank.counts.end(), 0);
  }
  width_ = std::min(kBits, shift_);
  shift_ -= width_;
}

std::vector<double> RankSearch::found() const {
  std::vector<double> numbers;
  numbers.reserve(ranks_.size());
  for (const Rank& rank : ranks_) numbers.push_back(number_of_key(rank.prefix));
  return numbers;
}

}  // namespace earthtop::study
