// SPDX-License-Identifier: GPL-3.0-or-later
/// The finding of a study, in a sentence, from its document alone.
#pragma once

#include <string>
#include <vector>

#include "report/study_words.hpp"

namespace earthtop::report {

/// How the first quantity that has numbers depends on the setting that moves it most: from which value to which. Where the points were
/// drawn, how it is spread, and which setting most of that comes from.
std::string study_finding(const Json& study);

/// How much of the study there is, and how sure: points computed, failed, reliable, and the largest error bound.
std::string study_certainty(const Json& study);

}  // namespace earthtop::report
