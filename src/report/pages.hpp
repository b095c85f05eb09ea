// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of pages.
#pragma once

#include <filesystem>

#include "earthtop/watch.hpp"
#include "report/html.hpp"

namespace earthtop::report {

Report run_page(const std::filesystem::path& directory, const Watch& watch);
Report study_page(const std::filesystem::path& store, const Watch& watch);
Report comparison_page(const Json& document);
Report measurement_page(const Json& document);
Report plan_page(const Json& document);
Report bench_page(const Json& document);

}  // namespace earthtop::report
