#include "progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string_view>

namespace earthtop::tool {
namespace {

void write_to_terminal(const std::string& text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody looks
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
  const std::size_t width = line.size();
  write_to_terminal("\r" + line + std::string(width_ > width ? width_ - width : 0, ' '));
  width_ = width;
}

void ProgressLine::clear() {
  if (shown_ && width_ > 0) write_to_terminal("\r" + std::string(width_, ' ') + "\r");
  width_ = 0;
}

ElapsedLine::ElapsedLine(bool wanted, double expected_s) : line_(wanted) {
  if (line_.is_shown()) thread_ = std::thread([this, expected_s] { tell(expected_s); });
}

ElapsedLine::~ElapsedLine() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  done_.notify_one();
  thread_.join();
}

void ElapsedLine::tell(double expected_s) {
  using std::chrono::steady_clock;
  const auto start = steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!done_.wait_for(lock, std::chrono::milliseconds(500), [this] { return is_done_; })) {
    const double elapsed = std::chrono::duration<double>(steady_clock::now() - start).count();
    if (elapsed < 1) continue;
    const double left = expected_s - elapsed;
    line_.show(left > 0 ? fmt::format("running for {:.0f} s; by estimate {:.0f} s more", elapsed, std::max(left, 1.0))
                        : fmt::format("running for {:.0f} s; longer than the estimate of {:.1g} s", elapsed, expected_s));
  }
}

}  // namespace earthtop::tool
