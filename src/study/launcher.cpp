// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "earthtop/study/processes.hpp"

namespace earthtop {

unsigned launched_processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {  // Open MPI's; MPICH's and its relatives'
    const char* text = std::getenv(name);
    if (!text) continue;
    const std::string_view digits(text);
    unsigned count = 0;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), count).ec == std::errc() && count > 0) return count;
  }
  return 1;
}

}  // namespace earthtop
