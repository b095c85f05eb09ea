// SPDX-License-Identifier: GPL-3.0-or-later
// Work that never checks whether it is asked to stop. It computes, or waits after the first twentieth of a second.
#include <unistd.h>

#include <ctime>
#include <string_view>

#include "interrupt.hpp"

int main(int argc, char** argv) {
  earthtop::tool::install_stop_handlers(false);
  const earthtop::tool::OrderlyEnd orderly;
  const bool waits = argc > 1 && std::string_view(argv[1]) == "waits";
  for (;;)
    if (waits && std::clock() > CLOCKS_PER_SEC / 20) ::sleep(1000);
}
