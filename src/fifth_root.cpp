// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "earthtop/elementary.hpp"

/// The fifth root. The turbulent drag of a disc needs two fifth roots for each evaluation; with `pow` they would be most of the
/// cost of a run.
///
/// With x = 2^(5 q) u and 1 <= u < 32, u^(1/5) = t (1 + e)^(1/5), where t is a nearby root from a table and e = u / t^5 - 1.
/// Since t has ten bits, t^5 is exact, and so is u - t^5. Everything that is rounded before the last sum is at most a 280th of
/// the result.
namespace earthtop::real {
namespace {

constexpr std::size_t kParts = 32;  ///< parts of each binade of u; with this many |e| is below 0.018
constexpr int kTerms = 8;           ///< the first omitted term is below 1e-2 units in the last place

struct Start {
  double root, power, inverse_power;
};

constexpr std::array<Start, 5 * kParts> kStarts = [] {
  std::array<Start, 5 * kParts> starts{};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double middle = static_cast<double>(1U << i / kParts) * (1 + (static_cast<double>(i % kParts) + 0.5) / kParts);
    double root = 2;
    for (int k = 0; k < 12; ++k) root -= (root - middle / (root * root * root * root)) / 5;  // Newton's method, from above
    root = static_cast<double>(static_cast<unsigned>(1024 * root + 1) >> 1U) / 512;
    const double power = root * root * root * root * root;
    starts[i] = {root, power, 1 / power};
  }
  return starts;
}();

/// Coefficients c_n of (1 + e)^(1/5) = 1 + e (c_0 + c_1 e + ...).
constexpr std::array<double, kTerms> kSeries = [] {
  std::array<double, kTerms> series{};
  double binomial = 1;
  for (int n = 0; n < kTerms; ++n) series[static_cast<std::size_t>(n)] = binomial = binomial * (0.2 - n) / (n + 1);
  return series;
}();

}  // namespace

double fifth_root(double x) noexcept {
  if (!(x >= std::numeric_limits<double>::min() && x <= std::numeric_limits<double>::max())) [[unlikely]] {
    if (!(x > 0)) return 0;
    return x < 1 ? 0x1p-12 * fifth_root(0x1p+60 * x) : x;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t kMore = 205;
  const std::uint64_t exponent = (bits >> 52U) + 2;  // exceeds the exponent of 2 by 5 * kMore
  const std::uint64_t fifth = exponent / 5, part = (bits >> 47U) % kParts;
  const Start& start = kStarts[kParts * (exponent - 5 * fifth) + part];
  const double u = std::bit_cast<double>(bits - ((5 * fifth - 5 * kMore) << 52U));

  const auto& c = kSeries;
  const double e = (u - start.power) * start.inverse_power, e2 = e * e;
  const double low = (c[0] + c[1] * e) + e2 * (c[2] + c[3] * e), high = (c[4] + c[5] * e) + e2 * (c[6] + c[7] * e);
  const double root = start.root + start.root * e * (low + e2 * e2 * high);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(root) + ((fifth - kMore) << 52U));
}

}  // namespace earthtop::real
