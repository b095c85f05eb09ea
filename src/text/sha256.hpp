// SPDX-License-Identifier: GPL-3.0-or-later
/// The hash by which texts and files are identified.
#pragma once

#include <string>
#include <string_view>

namespace earthtop {

/// SHA-256 as 64 lower-case hexadecimal digits [FIPS 180-4].
std::string sha256_hex(std::string_view bytes);

}  // namespace earthtop
