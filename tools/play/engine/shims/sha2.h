// SPDX-License-Identifier: GPL-3.0-or-later
/// libmd's function for SHA-256 [FIPS 180-4], which the engine defines itself (sha256.cpp).
#pragma once

#include <cstddef>
#include <cstdint>

#define SHA256_DIGEST_STRING_LENGTH 65

/// Writes the hexadecimal digits and a final 0. @returns `hex`
char* SHA256Data(const std::uint8_t* data, std::size_t size, char* hex);
