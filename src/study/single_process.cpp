// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for MPI in a program built without it: there is only this process.
#include <fmt/core.h>

#include <stdexcept>

#include "study/process_workforce.hpp"

namespace earthtop {

bool has_mpi() { return false; }

struct StudyProcesses::Session {};

StudyProcesses::StudyProcesses() : session_(std::make_unique<Session>()) {
  if (launched_processes() > 1)
    throw ScenarioError("",
                        fmt::format("a launcher started {} processes, but this program was built without MPI; build it with "
                                    "libopenmpi-dev installed, or use --shard K/N and earthtop study merge",
                                    launched_processes()));
}
StudyProcesses::~StudyProcesses() = default;
bool StudyProcesses::is_first() const { return true; }
unsigned StudyProcesses::workers() const { return 0; }
void StudyProcesses::serve(const Watch&) {}

namespace study {

std::unique_ptr<Workforce> make_processes(const Study&, StudyProcesses&, const Watch&) {
  throw std::logic_error("built without MPI");
}

}  // namespace study
}  // namespace earthtop
