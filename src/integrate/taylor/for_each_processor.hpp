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
template <class Series>
[[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=512"), gnu::flatten]] void expand_with_eights(
    Series& series, typename Series::State* x, int order) {
  series.template expand_here<8>(x, order);
}
template <class Series>
[[gnu::target("avx2"), gnu::flatten]] void expand_with_fours(Series& series, typename Series::State* x, int order) {
  series.template expand_here<4>(x, order);
}
template <class Series>
void expand_for_processor(Series& series, typename Series::State* x, int order) {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    expand_with_eights(series, x, order);
  else if (__builtin_cpu_supports("avx2"))
    expand_with_fours(series, x, order);
  else
    expand_with_pairs(series, x, order);
}
#else
template <class Series>
void expand_for_processor(Series& series, typename Series::State* x, int order) {
  expand_with_pairs(series, x, order);
}
#endif

}  // namespace earthtop::taylor
