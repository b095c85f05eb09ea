// SPDX-License-Identifier: GPL-3.0-or-later
/// Marks a function that is compiled for several widths of vectors, with all that it calls; the one for the processor at hand
/// is chosen when the program starts. Without contraction into fused operations (-ffp-contract=off) all of them give the same
/// bits.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define EARTHTOP_FOR_EACH_PROCESSOR [[gnu::target_clones("avx512f", "avx2", "default"), gnu::flatten]]
#else
#define EARTHTOP_FOR_EACH_PROCESSOR
#endif
