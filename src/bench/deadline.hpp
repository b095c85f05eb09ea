// SPDX-License-Identifier: GPL-3.0-or-later
/// A flag that is set when the calling thread has used a given amount of processor time.
#pragma once

#include <pthread.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace earthtop {

/// Processor time of a thread (s), which does not count the time of other programs.
inline double clock_seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
inline double thread_seconds() { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }

class Deadline {
 public:
  explicit Deadline(double seconds) {
    clockid_t clock{};
    if (pthread_getcpuclockid(pthread_self(), &clock) != 0) return;
    const double end = clock_seconds(clock) + seconds;
    watcher_ = std::jthread([this, clock, end](const std::stop_token& ended) {
      std::unique_lock lock(mutex_);
      while (!ended.stop_requested()) {
        const double left = end - clock_seconds(clock);
        if (left <= 0) {
          passed_ = true;
          return;
        }
        sleep_.wait_for(lock, ended, std::chrono::duration<double>(left), [] { return false; });
      }
    });
  }
  const std::atomic<bool>* passed() const { return &passed_; }

 private:
  std::atomic<bool> passed_ = false;
  std::mutex mutex_;
  std::condition_variable_any sleep_;
  std::jthread watcher_;  // declared last: it is destroyed before the members that its thread uses
};

}  // namespace earthtop
