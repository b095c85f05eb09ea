// SPDX-License-Identifier: GPL-3.0-or-later
/// The words for the two motions of a run and for what makes them differ: the one table of them.
#pragma once

#include <string_view>

#include "earthtop/scenario/scenario.hpp"

namespace earthtop {

struct ComparedWords {
  std::string_view agent;           ///< "the Earth" turns an axis
  std::string_view cause;           ///< with and without "the Earth's rotation"
  std::string_view if_not;          ///< where the axis would be "if the Earth did not turn"
  std::string_view reference;       ///< the "non-rotating prediction"
  std::string_view former, latter;  ///< "Rotating" minus "non-rotating Earth"
};
inline constexpr ComparedWords kRotationWords{.agent = "the Earth",
                                              .cause = "the Earth's rotation",
                                              .if_not = "if the Earth did not turn",
                                              .reference = "non-rotating prediction",
                                              .former = "Rotating",
                                              .latter = "non-rotating Earth"};
inline constexpr ComparedWords kJourneyWords{.agent = "the journey",
                                             .cause = "the journey",
                                             .if_not = "if the laboratory had stayed",
                                             .reference = "prediction for the laboratory that stays at the place of release",
                                             .former = "Travelling",
                                             .latter = "resting laboratory"};

/// @param reference_stays  whether the reference is the laboratory that stays at the place of the release
constexpr const ComparedWords& compared_words(bool reference_stays) { return reference_stays ? kJourneyWords : kRotationWords; }
inline const ComparedWords& compared_words(const Scenario& scenario) {
  return compared_words(scenario.travel && scenario.travel->reference == TravelReference::at_rest);
}

}  // namespace earthtop
