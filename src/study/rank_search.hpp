// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds quantiles of more numbers than fit into memory.
#pragma once

#include <cstdint>
#include <vector>

namespace earthtop::study {

/// Finds the numbers at given places of the ascending order, exactly: a radix search, which counts in each pass how often the
/// next bits occur. The numbers are passed `kPasses` times, in any order; none of them is kept. -0 counts as 0.
class RankSearch {
 public:
  static constexpr int kPasses = 6;

  /// @param ranks places in the ascending order, starting at 0
  explicit RankSearch(const std::vector<std::uint64_t>& ranks);
  /// @param x is not NaN
  void include(double x);
  void end_pass();
  /// After the last pass: the number at each of the ranks. If the numbers of the passes were not the same, it is some number.
  std::vector<double> found() const;

 private:
  static constexpr int kBits = 11;  // looked at in a pass; the last one looks at the remaining 9 of 64
  struct Rank {
    std::uint64_t left;        // rank among the numbers that begin with `prefix`
    std::uint64_t prefix = 0;  // the bits known so far
    std::vector<std::uint64_t> counts;
  };
  std::vector<Rank> ranks_;
  int shift_ = 64 - kBits, width_ = kBits;
};

}  // namespace earthtop::study
