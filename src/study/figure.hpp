// SPDX-License-Identifier: GPL-3.0-or-later
/// A study of one or two axes as curves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "earthtop/plot/plot.hpp"
#include "earthtop/study/study.hpp"

namespace earthtop::study {

/// The quantities against the axis that has the most numbers, a line for each value of the other axis; nothing where there is
/// no such axis, where the other one has too many values, or where there are more axes or more points than the document lists.
/// @param document  that of `study_json`
std::optional<Figure> study_figure(const Study& study, const nlohmann::ordered_json& document);

}  // namespace earthtop::study
