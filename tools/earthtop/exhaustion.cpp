// SPDX-License-Identifier: GPL-3.0-or-later
#include "exhaustion.hpp"

#include <fmt/core.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "earthtop/results/results.hpp"
#include "output.hpp"

namespace earthtop::tool {
namespace {

/// The message, and the same as it is written. Before the second is prepared, the first is written as it is.
struct LastWords {
  const char* said;
  const std::string* written = nullptr;  // never freed: it may be needed while the program ends
};
std::array<LastWords, 2> g_words = {{{"out of memory; ask for fewer rows (a longer output_step_s, no ledger)"},
                                     {"no thread can be started; use fewer --jobs, or end other programs"}}};
bool g_words_are_json = false;

/// Memory that is given up when there is no other, so that what is cleared up then finds some: the JSON library's destructors
/// allocate.
std::atomic<void*> g_reserve = nullptr;
std::atomic<bool> g_has_lacked = false;

void give_up_reserve() {
  g_has_lacked = true;
  std::free(g_reserve.exchange(nullptr));
  throw std::bad_alloc();
}

/// Where an exception leaves a function that may throw none, or where one is thrown before `main`, nothing can be cleared up
/// any more except for the temporary files.
[[noreturn]] void end_without_memory() noexcept {
  // Libraries may end the program without an exception then; before `main` an exception itself may find no memory.
  bool lacks_memory = g_has_lacked || g_words.front().written == nullptr;
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    lacks_memory = true;
  } catch (...) {
    lacks_memory = false;
  }
  if (!lacks_memory) std::abort();  // a defect of the program
  discard_temporaries();
  ::_exit(report_lacking(Lacking::memory));
}

/// Libraries allocate static objects before `main`; this handler comes before theirs.
__attribute__((constructor(101))) void install_last_handler() { std::set_terminate(end_without_memory); }

constexpr rlim_t kNeeded = 512 << 10, kOrdinary = 8 << 20;  // bytes; less than 256 KiB were seen in use

}  // namespace

void prepare_for_exhaustion(bool json) {
  for (LastWords& words : g_words) {
    const std::vector<Diagnostic> errors = {{0, 0, "", words.said}};
    words.written = new std::string(json ? errors_json("", errors) : errors_text("", errors));
  }
  g_words_are_json = json;
  constexpr std::size_t kReserve = 1 << 20;  // bytes
  g_reserve = std::malloc(kReserve);
  std::set_new_handler(give_up_reserve);
}

int report_lacking(Lacking what) noexcept {
  const LastWords& words = g_words[static_cast<std::size_t>(what)];
  if (words.written != nullptr) {
    write_at_once(g_words_are_json ? STDOUT_FILENO : STDERR_FILENO, *words.written);
  } else {
    for (const char* part : {"earthtop: error: ", words.said, "\n"}) write_at_once(STDERR_FILENO, part);
  }
  return kNumericalFailure;
}

bool make_room_on_stack() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kNeeded) return true;
  limit.rlim_cur = std::min(limit.rlim_max, kOrdinary);
  if (limit.rlim_cur < kNeeded || ::setrlimit(RLIMIT_STACK, &limit) != 0) {
    report_errors("",
                  {{0, 0, "",
                    fmt::format("the stack is limited to {} KiB, and {} KiB are needed; raise the limit with ulimit -s",
                                limit.rlim_cur >> 10, kNeeded >> 10)}},
                  g_words_are_json, kNumericalFailure);
    return false;
  }
  // The stacks of threads have the size that the limit had when the program began.
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) == 0) {
    if (pthread_attr_setstacksize(&attributes, limit.rlim_cur) == 0) pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
  }
  return true;
}

}  // namespace earthtop::tool
