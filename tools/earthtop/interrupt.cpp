// SPDX-License-Identifier: GPL-3.0-or-later
#include "interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "earthtop/results/results.hpp"
#include "output.hpp"
#include "progress_line.hpp"

namespace earthtop::tool {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;                // ns
constexpr std::int64_t kGrace = 100 * kMillisecond;             // processor time allowed for an orderly end
constexpr std::int64_t kNoLimit = 0;                            // disarms a timer
constexpr std::int64_t kMoment = 10 * kMillisecond;             // processor time allowed for steps that must not be interrupted
constexpr std::int64_t kIdle = 2000 * kMillisecond;             // time by the clock; a process that uses less
constexpr std::int64_t kStuckProcessorTime = kMillisecond / 2;  // processor time than this meanwhile is stuck

// The state shared with the signal handlers. One thread starts the work, but any thread may receive a signal.
std::atomic<int> g_signal = 0;
std::atomic<bool> g_stop = false, g_orderly = false, g_keeps = false;
std::atomic<std::int64_t> g_used_before = 0;  // processor time at the last look
bool g_json = false;
const std::string *g_message = nullptr, *g_json_message = nullptr;  // never freed: a signal may come while the program ends
timer_t g_processor_timer, g_wall_timer;
bool g_has_timers = false;

std::int64_t processor_time() noexcept {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

void set(timer_t timer, std::int64_t delay) noexcept {
  itimerspec setting{};
  setting.it_value.tv_sec = delay / 1'000'000'000;
  setting.it_value.tv_nsec = delay % 1'000'000'000;
  if (g_has_timers) timer_settime(timer, 0, &setting, nullptr);
}

void watch_the_end(std::int64_t grace) noexcept {
  g_used_before = processor_time();
  set(g_processor_timer, grace);
  set(g_wall_timer, kIdle);
}

/// Ends the program. Runs in signal handlers, and therefore makes only calls that are safe there.
void end_at_once() noexcept {
  if (!discard_temporaries()) return watch_the_end(kMoment);
  if (is_line_shown()) write_at_once(STDERR_FILENO, "\r\033[K");
  if (!g_json)
    write_at_once(STDERR_FILENO, *g_message);
  else if (!has_printed())
    write_at_once(STDOUT_FILENO, *g_json_message);
  ::_exit(interrupted_status());
}

extern "C" void on_stop_signal(int signal) {
  const int error = errno;
  const bool is_first = g_signal.exchange(signal) == 0;
  if (is_first && g_orderly) {
    g_stop = true;
    watch_the_end(g_keeps ? kNoLimit : kGrace);
  } else {
    end_at_once();
  }
  errno = error;
}

/// Ends the program if its processor time is used up (processor timer) or if it used hardly any since the last look (wall
/// timer).
extern "C" void on_timer(int, siginfo_t* info, void*) {
  const int error = errno;
  const std::int64_t now = processor_time();
  const bool is_wall = info->si_value.sival_int == 1;
  if (!is_wall || now - g_used_before.exchange(now) < kStuckProcessorTime)
    end_at_once();
  else
    set(g_wall_timer, kIdle);
  errno = error;
}

bool make_timers() {
  struct sigaction action {};
  action.sa_sigaction = on_timer;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGRTMIN;
  if (sigaction(SIGRTMIN, &action, nullptr) != 0) return false;
  event.sigev_value.sival_int = 0;
  if (timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &g_processor_timer) != 0) return false;
  event.sigev_value.sival_int = 1;
  return timer_create(CLOCK_MONOTONIC, &event, &g_wall_timer) == 0;
}

std::vector<Diagnostic> interruption() { return {{0, 0, "", "interrupted; the same command starts again"}}; }

}  // namespace

void install_stop_handlers(bool json) {
  const std::vector<Diagnostic> errors = interruption();
  g_json = json;
  g_message = new std::string(errors_text("", errors));
  g_json_message = new std::string(errors_json("", errors));
  g_has_timers = make_timers();
  struct sigaction action {};
  action.sa_handler = on_stop_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    // A signal that is ignored stays ignored: SIGINT in a background job of a shell, SIGHUP under nohup.
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

OrderlyEnd::OrderlyEnd(bool keeps) {
  g_keeps = keeps;
  g_orderly = true;
}
OrderlyEnd::~OrderlyEnd() {
  g_orderly = false;
  set(g_processor_timer, kNoLimit);
  set(g_wall_timer, kNoLimit);
}

void lift_time_limit() {
  set(g_processor_timer, kNoLimit);
  set(g_wall_timer, kNoLimit);
  g_stop = false;
}

const std::atomic<bool>* stop_flag() noexcept { return &g_stop; }

int interrupted_status() {
  const int signal = g_signal;
  return 128 + (signal != 0 ? signal : SIGINT);
}

int report_interruption(bool json) { return report_errors("", interruption(), json, interrupted_status()); }

}  // namespace earthtop::tool
