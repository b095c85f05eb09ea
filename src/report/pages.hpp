// SPDX-License-Identifier: GPL-3.0-or-later
/// The kinds of pages.
#pragma once

#include <filesystem>

#include "earthtop/watch.hpp"
#include "report/html.hpp"

namespace earthtop::report {

// @param gallery  as of make_report
Report run_page(const std::filesystem::path& directory, const Watch& watch, const std::string& gallery);
Report study_page(const std::filesystem::path& store, const Watch& watch, const std::string& gallery);
// @param notes  sentences on what could not be verified
Report comparison_page(const Json& document, const std::vector<std::string>& notes);
Report measurement_page(const Json& document, const std::vector<std::string>& notes);
Report releases_page(const Json& document, const std::vector<std::string>& notes);
Report plan_page(const Json& document, const std::vector<std::string>& notes);
Report bench_page(const Json& document, const std::vector<std::string>& notes);

}  // namespace earthtop::report
