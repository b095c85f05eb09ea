// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers and permutations that are pure functions of a seed and a number: nothing is stored, and they can be computed
/// in any order.
#pragma once

#include <bit>
#include <cstdint>

namespace earthtop::study {

/// Scrambles 64 bits (SplitMix64's finaliser; Steele, Lea, Flood, OOPSLA 2014).
constexpr std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// Scrambles three numbers: a seed, a stream of random numbers for that seed, and a member of the stream.
constexpr std::uint64_t mixed(std::uint64_t seed, std::uint64_t stream, std::uint64_t member) {
  return mixed(mixed(mixed(seed) ^ stream) ^ member);
}

/// A number 0 <= u < 1 from random bits, in steps of 2^-53.
constexpr double unit_number(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

/// The image of `i` under a random permutation of 0 ... size - 1. A Feistel network of four rounds permutes the numbers of the
/// next even number of bits; it is applied again until the result is below `size` (Black and Rogaway, CT-RSA 2002).
constexpr std::uint64_t permuted(std::uint64_t i, std::uint64_t size, std::uint64_t seed, std::uint64_t stream) {
  if (size < 2) return i;
  const int half = (static_cast<int>(std::bit_width(size - 1)) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << static_cast<unsigned>(half)) - 1;
  do {
    std::uint64_t left = i >> static_cast<unsigned>(half), right = i & mask;
    for (std::uint64_t round = 0; round < 4; ++round) {
      const std::uint64_t next = left ^ (mixed(seed, stream * 4 + round, right) & mask);
      left = right;
      right = next;
    }
    i = (left << static_cast<unsigned>(half)) | right;
  } while (i >= size);
  return i;
}

}  // namespace earthtop::study
