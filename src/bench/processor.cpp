// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include <fstream>
#include <string>
#include <thread>

#include "earthtop/bench/comparison.hpp"
#include "earthtop/error.hpp"

namespace earthtop {

std::string processor_description() {
  std::string name = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    if (begin != std::string::npos) name = printable(line.substr(begin));
    break;
  }
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? fmt::format("{}, {} core{}", name, cores, cores == 1 ? "" : "s") : name;
}

}  // namespace earthtop
