// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts that the engine leaves out, and why.
#pragma once

namespace earthtop::play {

inline constexpr const char* kDate = "this page has no places of the Sun and the Moon";

}  // namespace earthtop::play
