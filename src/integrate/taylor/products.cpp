// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrate/taylor/products.hpp"

// The loop is compiled for several widths of vectors, and the one for the processor at hand is chosen when the program starts.
// Without contraction into fused operations (-ffp-contract=off) all of them give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define EARTHTOP_FOR_EACH_PROCESSOR [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define EARTHTOP_FOR_EACH_PROCESSOR
#endif

namespace earthtop::taylor {
namespace {

/// Convolves some blocks of eight lanes together, since their sums do not have to wait for each other.
template <int kBlocks>
[[gnu::always_inline]] inline void convolve_blocks(const double* left, const double* right, int order, int lanes, double* sum) {
  constexpr int kLanes = 8 * kBlocks;
  double s[kLanes] = {};
  const double* a = left + lanes;
  const double* b = right + static_cast<long>(order - 1) * lanes;
  for (int j = 1; j < order; ++j, a += lanes, b -= lanes)
    for (int l = 0; l < kLanes; ++l) s[l] += a[l] * b[l];
  for (int l = 0; l < kLanes; ++l) sum[l] = s[l];
}

}  // namespace

EARTHTOP_FOR_EACH_PROCESSOR void convolve_inner(const double* left, const double* right, int order, int lanes, double* sum) {
  int begin = 0;
  for (; lanes - begin >= 24; begin += 24) convolve_blocks<3>(left + begin, right + begin, order, lanes, sum + begin);
  if (lanes - begin == 16) return convolve_blocks<2>(left + begin, right + begin, order, lanes, sum + begin);
  if (lanes - begin == 8) convolve_blocks<1>(left + begin, right + begin, order, lanes, sum + begin);
}

}  // namespace earthtop::taylor
