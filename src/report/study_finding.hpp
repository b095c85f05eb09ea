// SPDX-License-Identifier: GPL-3.0-or-later
/// The finding of a study, in a sentence, from its document alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/study_words.hpp"

namespace earthtop::report {

/// How the first quantity that has numbers depends on the setting that moves it most: from which value to which. Where the points were
/// drawn, how it is spread, and which setting most of that comes from.
std::string study_finding(const Json& study);

/// One value of a setting, and the mean of a quantity there over all other settings.
struct Level {
  std::string name;
  std::optional<double> place;  ///< none for words
  double mean = 0;
  double count = 0;
};

/// The quantity that the finding is about, and the setting along which its mean moves most; of settings that are changed one at a time
/// each is a level without a place, with the change of the quantity from the point where none is changed.
struct ToldMeans {
  StudyColumn quantity;
  StudyColumn setting;
  std::vector<Level> levels;  ///< in ascending order where they are numbers; at least two, not all with the same mean
};
/// None where there is no such quantity, or no setting by itself moves it.
std::optional<ToldMeans> told_means(const Json& study);
/// The quantity that the finding is about.
std::optional<StudyColumn> quantity_told(const Json& study);

/// How much of the study there is, and how sure: points computed, failed, reliable, and the largest error bound.
std::string study_certainty(const Json& study);

}  // namespace earthtop::report
