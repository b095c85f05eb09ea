// SPDX-License-Identifier: GPL-3.0-or-later
/// The processes beside the first as a workforce.
#pragma once

#include "earthtop/study/processes.hpp"
#include "study/workforce.hpp"

namespace earthtop::study {

/// @param processes  with at least one worker; outlives the workforce
std::unique_ptr<Workforce> make_processes(const Study& study, StudyProcesses& processes);

}  // namespace earthtop::study
