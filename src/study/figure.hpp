// SPDX-License-Identifier: GPL-3.0-or-later
/// Draws a study of one or two axes as curves.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "earthtop/plot/plot.hpp"
#include "earthtop/study/study.hpp"

namespace earthtop::study {

/// The quantities as functions of the axis with the most numbers, one curve for each value of the other axis. Nothing is
/// returned if no axis has numbers, if the other axis has too many values, or if there are more axes or points than the
/// document lists.
/// @param document the document of `study_json`
std::optional<Figure> study_figure(const Study& study, const nlohmann::ordered_json& document);

}  // namespace earthtop::study
