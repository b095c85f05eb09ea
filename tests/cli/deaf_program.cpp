// Work that never looks whether anybody asks it to stop: it computes, or it waits.
#include <unistd.h>

#include <string_view>

#include "interrupt.hpp"

int main(int argc, char** argv) {
  earthtop::tool::install_stop_handlers(false);
  const earthtop::tool::OrderlyEnd orderly;
  const bool waits = argc > 1 && std::string_view(argv[1]) == "waits";
  for (volatile unsigned turns = 0;; turns = turns + 1)
    if (waits) ::sleep(1000);
}
