#include "interrupt.hpp"

#include <unistd.h>

#include <csignal>

#include "earthtop/results/results.hpp"
#include "earthtop/run.hpp"

namespace earthtop::tool {
namespace {

volatile std::sig_atomic_t g_signal = 0;

extern "C" void stop_running(int signal) {
  if (g_signal != 0 && discard_temporaries()) ::_exit(128 + signal);
  g_signal = signal;
  request_interrupt();
}

}  // namespace

void install_stop_handlers() {
  struct sigaction action {};
  action.sa_handler = stop_running;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    // A shell's background job has SIGINT ignored, and nohup's SIGHUP: it stays so.
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

int interrupted_status() { return 128 + (g_signal != 0 ? g_signal : SIGINT); }

}  // namespace earthtop::tool
