// SPDX-License-Identifier: GPL-3.0-or-later
/// The scripts and styles of a page for the browser, compiled in from src/report/assets.
#pragma once

#include <string_view>

namespace earthtop::report {

std::string_view page_style();
/// The scripts of a run's page, of a study's, and of every other.
std::string_view run_script();
std::string_view study_script();
std::string_view other_script();

}  // namespace earthtop::report
