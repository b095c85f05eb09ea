// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "earthtop/study/processes.hpp"

namespace earthtop {

namespace {

/// The positive whole number in a variable of the environment; 0 if there is none.
unsigned number_in(const char* name) {
  const char* text = std::getenv(name);
  const std::string_view digits(text ? text : "");
  unsigned number = 0;
  const std::errc error = std::from_chars(digits.data(), digits.data() + digits.size(), number).ec;
  return error == std::errc() ? number : 0;
}

}  // namespace

unsigned launched_processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})  // Open MPI's; MPICH's and its relatives'
    if (const unsigned count = number_in(name)) return count;
  // Slurm's srun --mpi=pmix. Without PMIX_RANK its processes have nothing to do with each other.
  const unsigned tasks = std::getenv("PMIX_RANK") ? number_in("SLURM_STEP_NUM_TASKS") : 0;
  return tasks > 0 ? tasks : 1;
}

}  // namespace earthtop
