// SPDX-License-Identifier: GPL-3.0-or-later
/// What a page's browser needs, compiled in from src/report/assets.
#pragma once

#include <string_view>

namespace earthtop::report {

std::string_view page_style();
std::string_view page_script();

}  // namespace earthtop::report
