// SPDX-License-Identifier: GPL-3.0-or-later
/// The scripts and styles of a page for the browser, compiled in from src/report/assets.
#pragma once

#include <string_view>

namespace earthtop::report {

std::string_view page_style();
std::string_view page_script();

}  // namespace earthtop::report
