// SPDX-License-Identifier: GPL-3.0-or-later
/// Compiles the expansion of a series for several widths of vectors and takes the one for the processor at hand. Without
/// contraction into fused operations (-ffp-contract=off) all of them give the same bits.
#pragma once

namespace earthtop::taylor {

template <class Series>
[[gnu::flatten]] void expand_with_pairs(Series& series, typename Series::State* x, int order) {
  series.template expand_here<2>(x, order);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define EARTHTOP_HAS_WIDTHS
template <class Series>
[[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=512"), gnu::flatten]] void expand_with_eights(
    Series& series, typename Series::State* x, int order) {
  series.template expand_here<8>(x, order);
}
template <class Series>
[[gnu::target("avx2"), gnu::flatten]] void expand_with_fours(Series& series, typename Series::State* x, int order) {
  series.template expand_here<4>(x, order);
}
inline int width_of_processor() {
  const bool has_eights =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return has_eights ? 8 : __builtin_cpu_supports("avx2") ? 4 : 2;
}
/// @param width  how many doubles a vector has: 2, 4 or 8, at most what the processor has
template <class Series>
void expand_with_width(Series& series, typename Series::State* x, int order, int width) {
  if (width == 8)
    expand_with_eights(series, x, order);
  else if (width == 4)
    expand_with_fours(series, x, order);
  else
    expand_with_pairs(series, x, order);
}
#else
inline int width_of_processor() { return 2; }
template <class Series>
void expand_with_width(Series& series, typename Series::State* x, int order, int) {
  expand_with_pairs(series, x, order);
}
#endif

template <class Series>
void expand_for_processor(Series& series, typename Series::State* x, int order) {
  expand_with_width(series, x, order, width_of_processor());
}

}  // namespace earthtop::taylor
