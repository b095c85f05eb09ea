// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a study will have the Sobol indices that it asks for.
#pragma once

#include <string>

#include "earthtop/study/study.hpp"

namespace earthtop {

/// Why a study whose design asks for Sobol indices will have none, in words; empty where it will have them, or asks for none.
std::string indices_note(const Study& study);

}  // namespace earthtop
