// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_line.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>

#include "earthtop/watch.hpp"

namespace earthtop::tool {
namespace {

std::atomic<bool> line_shown = false;

void write_to_terminal(const std::string& text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody is reading
}

}  // namespace

bool is_lively_terminal(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (no_color != nullptr && *no_color != '\0') return false;
  return ::isatty(descriptor) == 1 && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

ProgressLine::ProgressLine(bool wanted) : shown_(wanted && is_lively_terminal(STDERR_FILENO)) {}

void ProgressLine::show(const std::string& line) {
  if (!shown_) return;
  line_shown = true;
  const std::size_t width = line.size();
  write_to_terminal("\r" + line + std::string(width_ > width ? width_ - width : 0, ' '));
  width_ = width;
}

void ProgressLine::clear() {
  if (shown_ && width_ > 0) write_to_terminal("\r" + std::string(width_, ' ') + "\r");
  width_ = 0;
  line_shown = false;
}

bool is_line_shown() noexcept { return line_shown; }

std::string duration_text(double seconds) {
  if (seconds < 0.1) return "less than 0.1 s";
  if (seconds < 0.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.1f} days", seconds / 86400);
}

std::string progress_text(double share, std::string_view phase, double seconds) {
  // Before one hundredth is done, an estimate of the time left would be a guess.
  const std::string left =
      share >= 0.01 && share < 1 ? fmt::format("{} left", duration_text(seconds * (1 - share) / share)) : "";
  return fmt::format("{:3.0f}%  {}{}{}", std::floor(100 * share), phase, !phase.empty() && !left.empty() ? ", " : "", left);
}

class ProgressDisplay::DisplayThread {
 public:
  DisplayThread(bool wanted, const Progress& progress) : line_(wanted), progress_(progress) {
    try {
      if (line_.is_shown()) thread_ = std::thread([this] { refresh(); });
    } catch (const std::system_error&) {  // no thread can be had, and the work goes on without its line
    }
  }
  ~DisplayThread() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
    thread_.join();
  }
  DisplayThread(const DisplayThread&) = delete;
  DisplayThread& operator=(const DisplayThread&) = delete;

  bool is_shown() const { return line_.is_shown(); }

  void aside(const std::function<void()>& say) {
    const std::lock_guard lock(mutex_);
    line_.clear();
    say();
  }

 private:
  void show() {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (seconds >= 1) line_.show(progress_text(progress_.share(), progress_.phase(), seconds));
  }

  void refresh() {
    std::unique_lock lock(mutex_);
    while (!done_.wait_for(lock, std::chrono::milliseconds(250), [this] { return is_done_; })) show();
    show();
  }

  ProgressLine line_;
  const Progress& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread thread_;
};

ProgressDisplay::ProgressDisplay(bool wanted, const Progress& progress)
    : display_(std::make_unique<DisplayThread>(wanted, progress)) {}

ProgressDisplay::~ProgressDisplay() = default;

bool ProgressDisplay::is_shown() const { return display_->is_shown(); }

void ProgressDisplay::aside(const std::function<void()>& say) { display_->aside(say); }

}  // namespace earthtop::tool
