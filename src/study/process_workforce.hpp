// SPDX-License-Identifier: GPL-3.0-or-later
/// The workforce that consists of all processes but the first.
#pragma once

#include "earthtop/study/processes.hpp"
#include "study/workforce.hpp"

namespace earthtop::study {

/// @param processes has at least one worker; must outlive the workforce
/// @param watch asks the workforce not to wait for workers any longer than a moment
std::unique_ptr<Workforce> make_processes(const Study& study, StudyProcesses& processes, const Watch& watch);

}  // namespace earthtop::study
