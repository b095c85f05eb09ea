// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// ERFA is not in the engine: see ephemeris.cpp.
inline const char* eraVersion() { return "none"; }
