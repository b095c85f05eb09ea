// SPDX-License-Identifier: GPL-3.0-or-later
/// The small picture of a study whose page draws its points in the browser.
#pragma once

#include <string>

#include "report/html.hpp"

namespace earthtop::report {

/// What the study's finding tells, drawn for a phone: the means of its quantity over the setting that moves it most, as points where the
/// setting has numbers, else as bars; where no setting does by itself, a bar for each point. An SVG document; empty where there is
/// nothing to draw.
std::string study_picture(const Json& study);

}  // namespace earthtop::report
