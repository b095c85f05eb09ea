// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's side of the doors. The environment chooses: FUZZ_DOOR is the door's name; if FUZZ_SEEDS is set, its seeds are
// written to that directory instead; if FUZZ_LIST is set, the names of all doors are printed.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>

#include "fuzz/door.hpp"
#include "fuzz/properties.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace earthtop::fuzz {
namespace {

const Door* chosen = nullptr;

void write_seeds(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  int number = 0;
  for (const std::string& seed : chosen->seeds())
    std::ofstream(directory / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
}

int initialize() {
  if (std::getenv("FUZZ_LIST")) {
    for (const Door& known : doors()) std::printf("%.*s\n", static_cast<int>(known.name.size()), known.name.data());
    std::exit(0);
  }
  const char* name = std::getenv("FUZZ_DOOR");
  if (!name) {
    std::fprintf(stderr, "FUZZ_DOOR is not set; FUZZ_LIST=1 prints the doors\n");
    std::exit(2);
  }
  chosen = &door(name);
  if (const char* directory = std::getenv("FUZZ_SEEDS")) {
    write_seeds(directory);
    std::exit(0);
  }
  chosen->enter(chosen->seeds().front());  // makes what the door needs: not a part of any input's time
  return 0;
}

}  // namespace
}  // namespace earthtop::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  using namespace earthtop::fuzz;
  try {
    return initialize();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(2);
  }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace earthtop::fuzz;
  try {
    chosen->enter({reinterpret_cast<const char*>(data), size});
  } catch (const Broken& broken) {
    std::fprintf(stderr, "BROKEN: %s\n", broken.what());
    std::abort();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "BROKEN: an exception that is not documented: %s\n", error.what());
    std::abort();
  }
  return 0;
}

/// Half of the changes keep the kind of the input.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  using namespace earthtop::fuzz;
  const bool of_its_kind = (seed & 1U) != 0;
  if (!of_its_kind) return LLVMFuzzerMutate(data, size, most);
  const std::string changed = chosen->mutated({reinterpret_cast<const char*>(data), size}, seed >> 1U);
  if (changed.empty() || changed.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, changed.data(), changed.size());
  return changed.size();
}
