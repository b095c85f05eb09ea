// SPDX-License-Identifier: GPL-3.0-or-later
/// The checksum by which stored bytes are known to be undamaged.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace earthtop {

/// The 64-bit checksum XXH3 of bytes that come piece by piece. It finds accidents; it is not a protection against intent.
class Checksum {
 public:
  Checksum();
  void add(std::string_view bytes);
  std::uint64_t value() const;

 private:
  struct Free {
    void operator()(void* state) const;
  };
  std::unique_ptr<void, Free> state_;
};

std::uint64_t checksum_of(std::string_view bytes);

/// As files write it: 16 lower-case hexadecimal digits.
std::string checksum_text(std::uint64_t checksum);

}  // namespace earthtop
