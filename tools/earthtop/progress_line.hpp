// SPDX-License-Identifier: GPL-3.0-or-later
/// Progress on a terminal, shown in a line that is overwritten again and again.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace earthtop {
class Progress;
}

namespace earthtop::tool {

/// Whether a stream is a terminal on which more than plain text is wanted (NO_COLOR is honoured). @param descriptor e.g.
/// STDERR_FILENO
bool is_lively_terminal(int descriptor);

class ProgressLine {
 public:
  /// @param wanted if false, or if standard error is no lively terminal, nothing is ever shown
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void show(const std::string& line);
  void clear();
  bool is_shown() const { return shown_; }

 private:
  bool shown_;
  std::size_t width_ = 0;
};

/// Whether a progress line is on the terminal. Safe in a signal handler.
bool is_line_shown() noexcept;

/// "3.2 s", "12 min", "4.5 h", "2.1 days".
std::string duration_text(double seconds);

/// "42% error bound, 12 s left". @param seconds time since the work began (s)
std::string progress_text(double share, std::string_view phase, double seconds);

/// While it lives, shows which share of some work is done, its phase and the time left, beginning one second after the start.
class ProgressDisplay {
 public:
  /// @param progress must outlive this object
  ProgressDisplay(bool wanted, const Progress& progress);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Whether there is a terminal to show it on.
  bool is_shown() const;
  /// Clears the line, calls `say`, which may print something else, and lets the line come back.
  void aside(const std::function<void()>& say);

 private:
  class DisplayThread;  // owns a thread
  std::unique_ptr<DisplayThread> display_;
};

}  // namespace earthtop::tool
